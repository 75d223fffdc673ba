// A top without input streams: `count` tokens from `first` on.
#include <ap_int.h>
#include <hls_stream.h>

void count_up(hls::stream<ap_uint<16>>& numbers, ap_uint<16> first, ap_uint<8> count) {
  for (ap_uint<8> i = 0; i < count; ++i) {
#pragma HLS PIPELINE II = 1
    numbers.write(first + i);
  }
}
