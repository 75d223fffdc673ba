// Run-length encoder of AXI4-Stream packets: (value, count) pairs, the last one of a packet with `last`.
#include "ap_axi_sdata.h"
#include "ap_int.h"
#include "hls_stream.h"

typedef ap_axiu<16, 1, 1, 1> in_pkt;
typedef ap_axiu<24, 1, 1, 1> out_pkt;

void run_length(hls::stream<in_pkt>& A, hls::stream<out_pkt>& B) {
#pragma HLS INTERFACE axis port = A
#pragma HLS INTERFACE axis port = B
#pragma hls interface s_axilite port = return
  ap_uint<16> value = 0;
  ap_uint<8> count = 0;
  ap_uint<1> pending = 0;  // the packet has ended, its last pair has not gone out
  bool done = false;
  while (!done) {
#pragma HLS PIPELINE II = 1
#pragma HLS LOOP_TRIPCOUNT min = 2 max = 1000
    bool emit = false;
    bool finish = pending;
    in_pkt tmp;
    tmp.data = 0;
    tmp.last = 0;
    if (!pending) A.read(tmp);
    const bool extend = !pending && count != 0 && count != 255 && tmp.data == value;
    emit = !extend && count != 0;
    if (emit) {
      out_pkt o;
      o.data = (count, value);
      o.keep = 0x7;
      o.strb = 0x7;
      o.user = 0;
      o.last = finish;
      o.id = 0;
      o.dest = 0;
      B.write(o);
    }
    count = extend ? ap_uint<8>(count + 1) : ap_uint<8>(1);
    value = tmp.data;
    pending = tmp.last;
    done = finish;
  }
}
