#include "../drive.hpp"
namespace kernel_leading_ones {
#include "../kernels/leading_ones.cpp"
}
using namespace kernel_leading_ones;

EPILINE_DRIVER(leading_ones) {
  auto& words = s.input<ap_uint<8>>("words");
  auto& positions = s.output<ap_uint<4>>("positions");
  std::vector<int> wanted;
  for (const int count : {20, 0, 1, 255}) {
    for (int i = 0; i < count; ++i) {
      const auto word = static_cast<unsigned>(s.chance(20) ? 0 : s.number(0, 255));
      words.push(word);
      wanted.push_back(word == 0 ? 8 : 31 - __builtin_clz(word));
    }
    s.call({{"count", static_cast<unsigned char>(count)}});
    leading_ones(words.stream, positions.stream, static_cast<unsigned char>(count));
  }
  s.expect_equal(positions.drain(), wanted, "positions");
}
