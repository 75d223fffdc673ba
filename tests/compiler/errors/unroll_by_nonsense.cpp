#include "ap_int.h"
#include "hls_stream.h"

void unroll_by_nonsense(hls::stream<int>& in, hls::stream<int>& out) {
  int sum = in.read();
  for (int i = 0; i < 8; ++i) {
#pragma HLS UNROLL factor = some  // refused: UNROLL
    sum += i;
  }
  out.write(sum);
}
