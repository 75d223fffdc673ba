// Viterbi decoder of the code with the generators 7 and 5 (octal), four states, hard decisions: frames of up to 64
// pairs of bits that end in state 0. The decisions of every step go into a RAM, the trace back reads it from the end
// and gives the bits in reverse into a stack, which comes out in order.
#include "ap_axi_sdata.h"
#include "ap_int.h"
#include "hls_stream.h"

#define STATES 4
#define MAX_FRAME 64

typedef ap_uint<7> metric_t;
typedef hls::axis<ap_uint<2>, 0, 0, 0> symbol_t;
typedef hls::axis<ap_uint<1>, 0, 0, 0> bit_t;

// The two bits sent when `bit` enters in `state` (the two bits before, newest on top).
static ap_uint<2> encode(ap_uint<2> state, ap_uint<1> bit) {
#pragma HLS INLINE
  const ap_uint<1> g0 = bit ^ state[1] ^ state[0];
  const ap_uint<1> g1 = bit ^ state[0];
  return (g0, g1);
}

void viterbi(hls::stream<symbol_t>& symbols, hls::stream<bit_t>& bits) {
#pragma HLS INTERFACE axis port = symbols
#pragma HLS INTERFACE axis port = bits
#pragma HLS INTERFACE ap_ctrl_none port = return
  ap_uint<STATES> decisions[MAX_FRAME];
  ap_uint<1> stack[MAX_FRAME];
  metric_t metrics[STATES];
#pragma HLS ARRAY_PARTITION variable = metrics complete

  for (int s = 0; s < STATES; s++) metrics[s] = s == 0 ? 0 : 32;

  ap_uint<7> length = 0;
  bool last = false;
add_compare_select:
  while (!last) {
#pragma HLS PIPELINE II = 1
    const symbol_t symbol = symbols.read();
    last = symbol.last;
    metric_t updated[STATES];
    ap_uint<STATES> decision;
    for (int s = 0; s < STATES; s++) {
#pragma HLS UNROLL
      // Into s = {bit, b1} from {b1, 0} and {b1, 1}.
      const ap_uint<1> bit = ap_uint<2>(s)[1];
      const ap_uint<1> b1 = ap_uint<2>(s)[0];
      metric_t path[2];
      for (int oldest = 0; oldest < 2; oldest++) {
        const ap_uint<2> from = (b1, ap_uint<1>(oldest));
        const ap_uint<2> wrong = encode(from, bit) ^ symbol.data;
        path[oldest] = metrics[from] + wrong[0] + wrong[1];
      }
      decision[s] = path[1] < path[0];
      updated[s] = path[1] < path[0] ? path[1] : path[0];
    }
    // Keep the smallest below 2: metrics never differ by more than 32 and a few.
    const bool all_large = updated[0] >= 2 && updated[1] >= 2 && updated[2] >= 2 && updated[3] >= 2;
    for (int s = 0; s < STATES; s++) metrics[s] = all_large ? metric_t(updated[s] - 2) : updated[s];
    decisions[length] = decision;
    length++;
  }

  ap_uint<2> state = 0;
trace_back:
  for (int i = length - 1; i >= 0; i--) {
#pragma HLS LOOP_TRIPCOUNT max = 64
#pragma HLS PIPELINE II = 1
    stack[i] = state[1];
    const ap_uint<1> oldest = decisions[i][state];
    state = (state[0], oldest);
  }

give:
  for (int i = 0; i < length; i++) {
#pragma HLS PIPELINE II = 1
    bit_t b;
    b.data = stack[i];
    b.keep = 1;
    b.strb = 1;
    b.last = i == length - 1;
    bits.write(b);
  }
}
