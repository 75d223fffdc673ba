#include "../drive.hpp"
namespace kernel_width_converter {
#include "../kernels/width_converter.cpp"
}
using namespace kernel_width_converter;

EPILINE_DRIVER(width_converter) {
  auto& in = s.input<narrow_t>("in");
  auto& out = s.output<wide_t>("out");
  for (const int length : {1, 2, 3, 4, 5, 8, 103}) {
    std::vector<unsigned> bytes;
    for (int i = 0; i < length; ++i) {
      narrow_t beat = s.any<narrow_t>();
      beat.last = i + 1 == length;
      in.push(beat);
      bytes.push_back(beat.data.to_uint());
    }
    width_converter(in.stream, out.stream);
    std::vector<unsigned> found;
    for (const wide_t& word : out.drain()) {
      for (int lane = 0; lane < 4; ++lane) {
        if (word.keep[lane]) found.push_back(word.data.range(8 * lane + 7, 8 * lane).to_uint());
      }
    }
    s.expect_equal(found, bytes, "bytes");
  }
}
