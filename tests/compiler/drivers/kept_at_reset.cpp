#include "../drive.hpp"
namespace regression_kept_at_reset {
#include "../regressions/kept_at_reset.cpp"
}

EPILINE_DRIVER(kept_at_reset) {
  auto& in = s.input<ap_int<12>>("in");
  auto& out = s.output<ap_int<67>>("out");
  for (int call = 0; call < 6; ++call) {
    for (int i = 0; i < 8; ++i) in.push(s.any<ap_int<12>>());
    regression_kept_at_reset::kept_at_reset(in.stream, out.stream);
  }
}
