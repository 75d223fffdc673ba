#include "../drive.hpp"
namespace regression_initial_contents {
#include "../regressions/initial_contents.cpp"
}

EPILINE_DRIVER(initial_contents) {
  auto& in = s.input<ap_uint<6>>("in");
  auto& out = s.output<ap_int<19>>("out");
  for (int i = 0; i < 200; ++i) {
    in.push(s.any<ap_uint<6>>());
    regression_initial_contents::initial_contents(in.stream, out.stream);
  }
}
