#include "../drive.hpp"
namespace kernel_histogram {
#include "../kernels/histogram.cpp"
}
using namespace kernel_histogram;

EPILINE_DRIVER(histogram) {
  auto& in = s.input<byte_t>("in");
  auto& out = s.output<count_t>("out");
  std::vector<int> wanted;
  for (const int length : {300, 1, 2, 150}) {
    std::vector<int> bins(256);
    int value = 0;
    for (int i = 0; i < length; ++i) {
      if (s.chance(70)) value = int(s.number(0, s.chance(50) ? 3 : 255));  // runs and near repetitions of one bin
      byte_t beat = s.any<byte_t>();
      beat.data = value;
      beat.last = i + 1 == length;
      in.push(beat);
      ++bins[std::size_t(value)];
    }
    wanted.insert(wanted.end(), bins.begin(), bins.end());
    histogram(in.stream, out.stream);
  }
  s.expect_equal(out.drain(), wanted, "out");
}
