#include <hls_task.h>

#include "../drive.hpp"
namespace regression_asks_in_an_endless_loop {
#include "../regressions/asks_in_an_endless_loop.cpp"
}

EPILINE_DRIVER(asks_in_an_endless_loop) {
  auto& in = s.input<ap_uint<8>>("in");
  auto& out = s.output<ap_uint<16>>("out");
  // Tasks keep their streams for good: these outlive the session.
  static hls::stream<ap_uint<8>> given("given");
  static hls::stream<ap_uint<16>> taken("taken");
  std::vector<int> wanted;
  int count = 0;
  bool is_odd = false;
  int sums[4] = {0, 0, 0, 0};
  for (int i = 0; i < 500; ++i) {
    const int value = s.number(0, 3) == 0 ? 255 * static_cast<int>(s.number(0, 1)) : static_cast<int>(s.number(0, 255));
    in.push(ap_uint<8>(value));
    given.write(in.stream.read());
    if (value != 0) {
      int& sum = sums[value & 3];
      sum = (sum + (count << 8 | value)) & 0xffff;
      wanted.push_back(sum);
      count = (count + 1) & 0xff;
    }
    is_odd = !is_odd;
    if (is_odd && value == 255) count = 0;
  }
  regression_asks_in_an_endless_loop::asks_in_an_endless_loop(given, taken);
  while (!taken.empty()) out.stream.write(taken.read());
  s.expect_equal(out.drain(), wanted, "out");
}
