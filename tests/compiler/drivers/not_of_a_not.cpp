#include "../drive.hpp"
namespace regression_not_of_a_not {
#include "../regressions/not_of_a_not.cpp"
}

EPILINE_DRIVER(not_of_a_not) {
  auto& in = s.input<ap_uint<8>>("in");
  auto& out = s.output<ap_uint<8>>("out");
  std::vector<ap_uint<8>> wanted;
  for (int i = 0; i < 100; ++i) {
    const auto byte = s.any<ap_uint<8>>();
    in.push(byte);
    for (int times = byte[7] ? 2 : 1; times > 0; --times) wanted.push_back(byte);
  }
  for (std::size_t i = 0; i < wanted.size(); ++i) regression_not_of_a_not::not_of_a_not(in.stream, out.stream);
  s.expect_equal(out.drain(), wanted, "out");
}
