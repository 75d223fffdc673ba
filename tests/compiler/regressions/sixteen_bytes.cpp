// A struct of 16 bytes read from a stream was refused as type punning: clang returns it as two integers, the second one
// at an element of a type that the struct does not have.
#include "ap_int.h"
#include "hls_stream.h"

struct wide_t {
  ap_int<16> data[8];
};
struct narrow_t {
  ap_int<8> data[8];
};

void sixteen_bytes(hls::stream<wide_t>& in, hls::stream<narrow_t>& out) {
#pragma HLS PIPELINE II = 1
  const wide_t x = in.read();
  narrow_t y;
  for (unsigned i = 0; i < 8; i++) {
#pragma HLS UNROLL
    if (x.data[i] < 0)
      y.data[i] = 0;
    else if (x.data[i] > 127)
      y.data[i] = 127;
    else
      y.data[i] = x.data[i];
  }
  out.write(y);
}
