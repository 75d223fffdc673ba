#include "../drive.hpp"
namespace regression_constant_recursion {
#include "../regressions/constant_recursion.cpp"
}

EPILINE_DRIVER(constant_recursion) {
  auto& in = s.input<ap_uint<16>>("in");
  auto& out = s.output<ap_uint<24>>("out");
  std::vector<unsigned> wanted;
  for (int i = 0; i < 200; ++i) {
    const auto value = s.any<ap_uint<16>>();
    in.push(value);
    wanted.push_back((value.to_uint() >> 6) + (34 + (value.to_uint() & 31)) * (2 + 3 + 5));
    regression_constant_recursion::constant_recursion(in.stream, out.stream);
  }
  s.expect_equal(out.drain(), wanted, "out");
}
