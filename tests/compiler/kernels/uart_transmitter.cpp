// UART transmitter, 8 bits, even parity, one stop bit: bytes in, samples of the line at 16 times the bit rate out.
#include "ap_int.h"
#include "hls_stream.h"

#define OVERSAMPLING 16

void uart_transmitter(hls::stream<ap_uint<8>>& bytes, hls::stream<ap_uint<1>>& line) {
#pragma HLS INTERFACE axis port = bytes
#pragma HLS INTERFACE axis port = line
#pragma HLS INTERFACE ap_ctrl_none port = return
  const ap_uint<8> byte = bytes.read();
  const ap_uint<1> parity = byte.xor_reduce();
  ap_uint<11> frame = (ap_uint<1>(1), parity, byte, ap_uint<1>(0));

  for (int bit = 0; bit < 11; bit++) {
    for (int tick = 0; tick < OVERSAMPLING; tick++) {
#pragma HLS PIPELINE II = 1
      line.write(frame[0]);
      if (tick == OVERSAMPLING - 1) frame >>= 1;
    }
  }
}
