#include "ap_int.h"
#include "hls_stream.h"

static constexpr int modulus = 0;

void remainder_by_zero(hls::stream<int>& in, hls::stream<int>& out) {
  out.write(in.read() % modulus);  // refused: zero
}
