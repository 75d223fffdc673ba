// Processes without an end that ask before they read, and keep what they know in variables of their own: a variable
// that a pass without a token leaves as it is.
#include <ap_int.h>
#include <hls_stream.h>
#include <hls_task.h>

static void number(hls::stream<ap_uint<8>>& in, hls::stream<ap_uint<16>>& between) {
  ap_uint<8> count = 0;
  bool is_odd = false;
  while (true) {
#pragma HLS PIPELINE II = 1
    if (!in.empty()) {
      const ap_uint<8> value = in.read();
      if (value != 0) {
        between.write((count, value));
        ++count;
      }
      is_odd = !is_odd;
      if (is_odd && value == 255) count = 0;
    }
  }
}

static void add_up(hls::stream<ap_uint<16>>& between, hls::stream<ap_uint<16>>& out) {
  ap_uint<16> sums[4] = {0, 0, 0, 0};
#pragma HLS ARRAY_PARTITION variable = sums complete
  ap_uint<16> token;
  while (true) {
#pragma HLS PIPELINE II = 1
    if (between.read_nb(token)) {
      const ap_uint<2> which = token(1, 0);
      sums[which] += token;
      out.write(sums[which]);
    }
  }
}

void asks_in_an_endless_loop(hls::stream<ap_uint<8>>& in, hls::stream<ap_uint<16>>& out) {
  hls_thread_local hls::stream<ap_uint<16>> between("between");
  hls_thread_local hls::task numbering(number, in, between);
  hls_thread_local hls::task adding(add_up, between, out);
}
