#include "ap_int.h"
#include "hls_stream.h"

void partition_of_too_much(hls::stream<ap_uint<20>>& in, hls::stream<int>& out) {
  static int lines[1048576];  // refused: 'lines' has 1048576 elements
#pragma HLS ARRAY_PARTITION variable = lines complete
  lines[in.read()] += 1;
  out.write(lines[0]);
}
