#include "ap_int.h"
#include "hls_stream.h"

void reset_of_a_local(hls::stream<int>& in, hls::stream<int>& out) {
  int total = 0;
#pragma HLS RESET variable = total off  // refused: total
  for (int i = 0; i < 4; ++i) total += in.read();
  out.write(total);
}
