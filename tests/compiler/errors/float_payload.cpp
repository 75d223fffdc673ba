#include "hls_stream.h"

struct sample_t {
  float left, right;
};

void float_payload(hls::stream<sample_t>& in, hls::stream<sample_t>& out) {  // refused: float
  out.write(in.read());                                                      // refused: float
}
