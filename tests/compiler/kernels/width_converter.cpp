// Packs 8-bit beats into 32-bit words (little end first); the tail of a packet is a partial word with `keep`.
#include "ap_axi_sdata.h"
#include "ap_int.h"
#include "hls_stream.h"

typedef ap_axiu<8, 1, 1, 1> narrow_t;
typedef ap_axiu<32, 1, 1, 1> wide_t;

void width_converter(hls::stream<narrow_t>& in, hls::stream<wide_t>& out) {
#pragma HLS INTERFACE axis port = in
#pragma HLS INTERFACE axis port = out
#pragma HLS INTERFACE ap_ctrl_none port = return
  bool last = false;
packet:
  while (!last) {
    ap_uint<32> word = 0;
    ap_uint<4> keep = 0;
  lanes:
    for (int lane = 0; lane < 4; lane++) {
#pragma HLS PIPELINE II = 1
      if (!last) {
        narrow_t n = in.read();
        word.range(8 * lane + 7, 8 * lane) = n.data;
        keep[lane] = 1;
        last = n.last;
      }
      if (lane == 3) {
        wide_t w;
        w.data = word;
        w.keep = keep;
        w.strb = keep;
        w.user = 0;
        w.last = last;
        w.id = 0;
        w.dest = 0;
        out.write(w);
      }
    }
  }
}
