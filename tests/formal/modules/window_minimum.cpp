// A small kernel with what the large ones are made of: absolute differences, a sliding sum, a minimum with its place.
#include <ap_int.h>
#include <hls_stream.h>

void window_minimum(hls::stream<ap_uint<12>>& pairs, hls::stream<ap_uint<12>>& minima, ap_uint<4> count) {
  ap_uint<6> delayed[3] = {0, 0, 0};
  ap_uint<8> sum = 0;
  ap_uint<8> smallest = 255;
  ap_uint<4> place = 0;
  for (ap_uint<4> i = 0; i < count; ++i) {
#pragma HLS PIPELINE II = 1
    const ap_uint<12> pair = pairs.read();
    const ap_uint<6> left = pair.range(5, 0);
    const ap_uint<6> right = pair.range(11, 6);
    const ap_uint<6> difference = left < right ? right - left : left - right;
    sum = sum + difference - delayed[2];
    delayed[2] = delayed[1];
    delayed[1] = delayed[0];
    delayed[0] = difference;
    if (sum < smallest) {
      smallest = sum;
      place = i;
    }
    minima.write((place, smallest));
  }
}
