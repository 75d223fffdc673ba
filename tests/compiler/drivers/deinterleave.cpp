#include "../drive.hpp"
namespace kernel_deinterleave {
#include "../kernels/deinterleave.cpp"
}
using namespace kernel_deinterleave;

EPILINE_DRIVER(deinterleave) {
  auto& in = s.input<uint32_t>("in");
  auto& even = s.output<uint32_t>("even");
  auto& odd = s.output<uint32_t>("odd");
  for (const int records : {10, 0, 1, 25}) {
    std::vector<uint32_t> wanted[2];
    for (int r = 0; r < records; ++r) {
      const auto count = static_cast<uint32_t>(s.chance(30) ? 0 : s.number(1, 20));
      const auto kind = static_cast<uint32_t>(s.number(0, 1));
      in.push(count | kind << 8 | static_cast<uint32_t>(s.number(0, 0x7fff)) << 16);
      for (uint32_t i = 0; i < count; ++i) {
        const auto word = static_cast<uint32_t>(s.number(0, 0xffffffff));
        in.push(word);
        wanted[kind].push_back(kind == 1 ? word ^ i << 24 : word + i);
      }
    }
    s.call({{"records", static_cast<uint8_t>(records)}});
    deinterleave(in.stream, even.stream, odd.stream, static_cast<uint8_t>(records));
    s.expect_equal(even.drain(), wanted[0], "even");
    s.expect_equal(odd.drain(), wanted[1], "odd");
  }
}
