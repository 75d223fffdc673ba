// UART receiver, 8 bits, even parity, one stop bit: samples of the line at 16 times the bit rate in, bytes with flags
// out. A start bit must last half a bit; every bit is the majority of three samples around its middle.
#include "ap_int.h"
#include "hls_stream.h"

enum uart_state { IDLE, START, DATA, PARITY, STOP };

struct received_t {
  ap_uint<8> byte;
  ap_uint<1> parity_error;
  ap_uint<1> framing_error;
};

void uart_receiver(hls::stream<ap_uint<1>>& line, hls::stream<received_t>& bytes) {
#pragma HLS INTERFACE ap_fifo port = line
#pragma HLS INTERFACE axis port = bytes
#pragma HLS INTERFACE ap_ctrl_none port = return
#pragma HLS PIPELINE II = 1
  static uart_state state = IDLE;
  static ap_uint<4> tick = 0;
  static ap_uint<3> bit = 0;
  static ap_uint<2> ones = 0;
  static ap_uint<8> shift = 0;
  static ap_uint<1> parity = 0;
  static bool parity_error = false;

  ap_uint<1> sample;
  line >> sample;

  if (tick == 0) ones = 0;
  if (tick == 6 || tick == 7 || tick == 8) ones += sample;
  const ap_uint<1> value = ones >= 2;
  const bool end_of_bit = tick == 15;

  switch (state) {
    case IDLE:
      tick = 0;
      if (sample == 0) {
        state = START;
        tick = 1;
      }
      break;
    case START:
      tick++;
      if (tick == 9 && value == 1) {
        state = IDLE;  // a glitch
      } else if (end_of_bit) {
        state = DATA;
        bit = 0;
        parity = 0;
      }
      break;
    case DATA:
      tick++;
      if (end_of_bit) {
        shift = (value, shift.range(7, 1));
        parity ^= value;
        if (bit == 7) state = PARITY;
        bit++;
      }
      break;
    case PARITY:
      tick++;
      if (end_of_bit) {
        parity_error = parity != value;
        state = STOP;
      }
      break;
    case STOP:
      tick++;
      if (tick == 10) {  // the middle is over: ready for an early start bit
        received_t r = {shift, parity_error, value == 0};
        bytes.write(r);
        state = IDLE;
        tick = 0;
      }
      break;
  }
}
