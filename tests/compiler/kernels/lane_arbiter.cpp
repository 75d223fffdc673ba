// Takes packets from four lanes in turn, a whole packet at a time, marks each beat with its lane and returns how many
// beats there were. One iteration a beat
#include "ap_axi_sdata.h"
#include "ap_int.h"
#include "hls_stream.h"

#define LANES 4

typedef ap_axiu<16, 0, 0, 0> beat_t;
typedef ap_axiu<16, 2, 0, 0> marked_t;

ap_uint<16> lane_arbiter(hls::stream<beat_t> in[LANES], hls::stream<marked_t>& out, ap_uint<4> first,
                         ap_uint<6> packets) {
#pragma HLS INTERFACE axis port = in
#pragma HLS INTERFACE axis port = out
#pragma HLS INTERFACE s_axilite port = return
#pragma HLS ARRAY_PARTITION variable = in complete
  ap_uint<16> beats = 0;
  ap_uint<2> lane = first;
  for (ap_uint<6> packet = 0; packet < packets; packet++) {
    bool last = false;
    while (!last) {
#pragma HLS PIPELINE II = 1
      const beat_t taken = in[lane].read();
      marked_t given;
      given.data = taken.data;
      given.keep = taken.keep;
      given.strb = taken.strb;
      given.user = lane;
      given.last = taken.last;
      out.write(given);
      last = taken.last;
      beats++;
    }
    lane++;
  }
  return beats;
}
