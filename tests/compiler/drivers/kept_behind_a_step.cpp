#include <hls_task.h>

#include "../drive.hpp"
namespace regression_kept_behind_a_step {
#include "../regressions/kept_behind_a_step.cpp"
}

EPILINE_DRIVER(kept_behind_a_step) {
  auto& in = s.input<ap_uint<14>>("in");
  auto& out = s.output<ap_uint<40>>("out");
  // Tasks keep their streams for good: these outlive the session.
  static hls::stream<ap_uint<14>> given("given");
  static hls::stream<ap_uint<40>> taken("taken");
  for (int i = 0; i < 300; ++i) {
    in.push(s.any<ap_uint<14>>());
    given.write(in.stream.read());
  }
  regression_kept_behind_a_step::kept_behind_a_step(given, taken);
  while (!taken.empty()) out.stream.write(taken.read());
}
