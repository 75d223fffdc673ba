#include "ap_int.h"
#include "hls_stream.h"

extern int gain;

void external_variable(hls::stream<int>& in, hls::stream<int>& out) {
  out.write(in.read() * gain);  // refused: gain
}
