#include "../drive.hpp"
namespace kernel_dataflow_decimator {
#include "../kernels/dataflow_decimator.cpp"
}
using namespace kernel_dataflow_decimator;

EPILINE_DRIVER(dataflow_decimator) {
  auto& in = s.input<word_t>("in");
  auto& out = s.output<ap_uint<17>>("out");
  for (const int words : {1, 2, 3, 50, 1, 7}) {
    std::vector<unsigned> kept;
    unsigned before = 0;
    for (int i = 0; i < words; ++i) {
      word_t word = s.any<word_t>();
      word.last = i + 1 == words;
      in.push(word);
      for (int lane = 0; lane < 4; ++lane) {
        const unsigned byte = word.data.range(8 * lane + 7, 8 * lane).to_uint();
        if ((4 * i + lane) % 3 == 0 || (word.last && lane == 3)) kept.push_back((byte + before) / 2);
        before = byte;
      }
    }
    std::vector<unsigned> wanted;
    for (std::size_t i = 0; i < kept.size(); i += 2) {
      const unsigned high = i + 1 < kept.size() ? kept[i + 1] : kept[i];
      wanted.push_back((i + 2 >= kept.size() ? 1u << 16 : 0u) | high << 8 | kept[i]);
    }
    dataflow_decimator(in.stream, out.stream);
    std::vector<unsigned> found;
    for (const ap_uint<17>& value : out.drain()) found.push_back(value.to_uint());
    s.expect_equal(found, wanted, "pairs");
  }
}
