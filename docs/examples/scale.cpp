// The worked example of docs/rtl_interface.md: multiplies `count` samples by `factor`.
#include "ap_int.h"
#include "hls_stream.h"

void scale(hls::stream<ap_uint<8>>& samples, hls::stream<ap_uint<12>>& products, ap_uint<4> factor, ap_uint<16> count) {
  for (ap_uint<16> i = 0; i < count; ++i) {
#pragma HLS PIPELINE II = 1
    products.write(samples.read() * factor);
  }
}
