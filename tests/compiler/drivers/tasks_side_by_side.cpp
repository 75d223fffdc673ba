#include <hls_task.h>

#include "../drive.hpp"
namespace regression_tasks_side_by_side {
#include "../regressions/tasks_side_by_side.cpp"
}

EPILINE_DRIVER(tasks_side_by_side) {
  // Tasks keep their streams for good: these outlive the session.
  static hls::stream<ap_uint<8>> given[2];
  static hls::stream<ap_uint<9>> taken[2];
  regression_tasks_side_by_side::tasks_side_by_side(given, taken);
  // One gets more tokens than the other.
  for (int lane = 0; lane < 2; ++lane) {
    auto& in = s.input<ap_uint<8>>(lane == 0 ? "in_0" : "in_1");
    auto& out = s.output<ap_uint<9>>(lane == 0 ? "out_0" : "out_1");
    std::vector<int> wanted;
    for (int i = 0; i < 40 + 60 * lane; ++i) {
      const auto value = s.any<ap_uint<8>>();
      in.push(value);
      given[lane].write(in.stream.read());
      wanted.push_back(value.to_int() + 3);
    }
    while (!taken[lane].empty()) out.stream.write(taken[lane].read());
    s.expect_equal(out.drain(), wanted, "out");
  }
}
