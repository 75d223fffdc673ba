#include "../drive.hpp"
namespace kernel_bit_reversal {
#include "../kernels/bit_reversal.cpp"
}
using namespace kernel_bit_reversal;

EPILINE_DRIVER(bit_reversal) {
  auto& in = s.input<ap_uint<24>>("in");
  auto& out = s.output<ap_uint<24>>("out");
  const auto reversed = [](unsigned value, unsigned width) {
    unsigned result = 0;
    for (unsigned i = 0; i < width; ++i) result |= ((value >> i) & 1) << (width - 1 - i);
    return result;
  };
  std::vector<unsigned> wanted;
  for (int call = 0; call < 4; ++call) {
    unsigned block[64];
    for (unsigned& v : block) {
      const ap_uint<24> value = s.any<ap_uint<24>>();
      v = value.to_uint();
      in.push(value);
    }
    for (unsigned i = 0; i < 64; ++i) wanted.push_back(reversed(block[reversed(i, 6)], 24));
    bit_reversal(in.stream, out.stream);
  }
  s.expect_equal(out.drain(), wanted, "out");
}
