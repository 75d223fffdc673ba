// Histogram of one packet in a RAM of 256 bins (read, add one, write back, also when one value comes twice in a row);
// the end of the packet dumps all bins and clears them.
#include "ap_axi_sdata.h"
#include "ap_int.h"
#include "hls_stream.h"

typedef ap_axiu<8, 1, 1, 1> byte_t;
typedef ap_uint<16> count_t;

void histogram(hls::stream<byte_t>& in, hls::stream<count_t>& out) {
  static count_t bins[256];
  static bool cleared = false;

  if (!cleared) {
  clear:
    for (int i = 0; i < 256; ++i) {
#pragma HLS PIPELINE II = 1
      bins[i] = 0;
    }
    cleared = true;
  }

  bool last = false;
count:
  while (!last) {
#pragma HLS PIPELINE II = 1
    const byte_t beat = in.read();
    bins[beat.data] = bins[beat.data] + 1;
    last = beat.last;
  }

dump:
  for (int i = 0; i < 256; ++i) {
#pragma HLS PIPELINE II = 1
    out.write(bins[i]);
    bins[i] = 0;
  }
}
