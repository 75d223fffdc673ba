#include "ap_int.h"
#include "hls_stream.h"

#pragma HLS PIPELINE II = 1  // refused: PIPELINE.*function
void pipeline_outside(hls::stream<int>& in, hls::stream<int>& out) { out.write(in.read()); }
