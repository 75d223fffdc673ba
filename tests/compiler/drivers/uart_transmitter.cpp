#include "../drive.hpp"
namespace kernel_uart_transmitter {
#include "../kernels/uart_transmitter.cpp"
}
using namespace kernel_uart_transmitter;

EPILINE_DRIVER(uart_transmitter) {
  auto& bytes = s.input<ap_uint<8>>("bytes");
  auto& line = s.output<ap_uint<1>>("line");
  std::vector<int> wanted;
  for (int i = 0; i < 8; ++i) {
    const int byte = i == 0 ? 0 : i == 1 ? 255 : int(s.number(0, 255));
    bytes.push(byte);
    std::vector<int> bits = {0};
    int ones = 0;
    for (int bit = 0; bit < 8; ++bit) {
      bits.push_back(byte >> bit & 1);
      ones += bits.back();
    }
    bits.push_back(ones % 2);
    bits.push_back(1);
    for (const int bit : bits) wanted.insert(wanted.end(), 16, bit);
    uart_transmitter(bytes.stream, line.stream);
  }
  s.expect_equal(line.drain(), wanted, "line");
}
