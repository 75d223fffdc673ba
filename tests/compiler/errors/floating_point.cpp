#include "ap_int.h"
#include "hls_stream.h"

void floating_point(hls::stream<ap_uint<8>>& in, hls::stream<ap_uint<8>>& out) {
  const float gain = 1.7f;                         // refused: float
  const float value = in.read().to_uint() * gain;  // refused: float
  out.write(static_cast<unsigned>(value));         // refused: float
}
