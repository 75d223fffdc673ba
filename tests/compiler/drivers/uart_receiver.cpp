#include "../drive.hpp"
namespace kernel_uart_receiver {
#include "../kernels/uart_receiver.cpp"
}
using namespace kernel_uart_receiver;
EPILINE_LEAVES(received_t, v.byte, v.parity_error, v.framing_error);

// Frames with pauses, with spikes of one sample that the majority outvotes, with wrong parity, without a stop bit, and
// glitches too short for a start bit.
EPILINE_DRIVER(uart_receiver) {
  auto& line = s.input<ap_uint<1>>("line");
  auto& bytes = s.output<received_t>("bytes");
  const auto hold = [&](int value, int ticks) {
    for (int i = 0; i < ticks; ++i) line.push(value);
  };
  std::vector<int> wanted;
  hold(1, 20);
  for (int frame = 0; frame < 24; ++frame) {
    const int byte = frame == 0 ? 0 : frame == 1 ? 255 : int(s.number(0, 255));
    const bool bad_parity = s.chance(20), bad_stop = s.chance(15);
    const bool parity = (__builtin_popcount(unsigned(byte)) & 1) != (bad_parity ? 1 : 0);
    if (s.chance(20)) {
      hold(0, int(s.number(1, 6)));
      hold(1, 17);
    }
    hold(0, 16);
    for (int bit = 0; bit < 9; ++bit) {
      const int value = bit < 8 ? byte >> bit & 1 : int(parity);
      const int spike = s.chance(30) ? int(s.number(0, 15)) : -1;
      for (int tick = 0; tick < 16; ++tick) line.push(tick == spike ? !value : value);
    }
    hold(bad_stop ? 0 : 1, 12);
    hold(1, 4 + int(s.chance(50) ? 0 : s.number(1, 40)));
    if (bad_stop) hold(1, 16);  // the low end of the stop bit was taken for a glitch
    wanted.push_back(byte << 2 | int(bad_parity) << 1 | int(bad_stop));
  }
  while (!line.stream.empty()) uart_receiver(line.stream, bytes.stream);
  std::vector<int> found;
  for (const received_t& r : bytes.drain())
    found.push_back(int(r.byte) << 2 | int(r.parity_error) << 1 | int(r.framing_error));
  s.expect_equal(found, wanted, "bytes");
}
