#include "../drive.hpp"
namespace regression_returned_odd_struct {
#include "../regressions/returned_odd_struct.cpp"
}

EPILINE_DRIVER(returned_odd_struct) {
  auto& in = s.input<ap_uint<8>>("in");
  auto& out = s.output<ap_uint<65>>("out");
  std::vector<std::uint64_t> bytes(8, 0);
  std::vector<std::uint64_t> wanted;
  for (unsigned i = 0; i < 200; ++i) {
    const unsigned x = (i * 37 + 11) % 256;
    in.push(x);
    if (x > 99)
      for (std::size_t k = 0; k < 7; ++k) bytes[k] = bytes[k + 1];
    bytes[7] = x;
    std::uint64_t word = 0;
    for (std::size_t k = 8; k-- > 0;) word = word << 8 | bytes[k];
    wanted.push_back(word);
    wanted.push_back(x & 1);
    regression_returned_odd_struct::returned_odd_struct(in.stream, out.stream);
  }
  std::vector<std::uint64_t> found;
  for (const auto& word : out.drain()) {
    found.push_back(ap_uint<64>(word.range(63, 0)).to_uint64());
    found.push_back(word[64] ? 1 : 0);
  }
  s.expect_equal(found, wanted, "out");
}
