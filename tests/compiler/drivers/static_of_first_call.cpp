#include "../drive.hpp"
namespace regression_static_of_first_call {
#include "../regressions/static_of_first_call.cpp"
}

EPILINE_DRIVER(static_of_first_call) {
  auto& in = s.input<ap_uint<16>>("in");
  auto& out = s.output<ap_uint<41>>("out");
  std::vector<std::uint64_t> wanted;
  unsigned count = 0;
  unsigned bins[16];
  for (unsigned i = 0; i < 16; ++i) bins[i] = 100 + i;
  for (int i = 0; i < 60; ++i) {
    const auto x = static_cast<unsigned>(s.number(0, 65535));
    in.push(x);
    count = (i == 0 ? x : count) + 3;
    const unsigned at = x % 8;
    const unsigned late = (i == 0 ? 0 : 3 * at + 1) ^ (3 * (7 - at) + 1);
    wanted.push_back(std::uint64_t{i == 0} << 40 | std::uint64_t{late} << 32 | std::uint64_t{count % 65536} << 16 |
                     ++bins[x % 16]);
    regression_static_of_first_call::static_of_first_call(in.stream, out.stream);
  }
  s.expect_equal(out.drain(), wanted, "words");
}
