#include "ap_int.h"
#include "hls_stream.h"

void shifted_by_less_than_nothing(hls::stream<int>& in, hls::stream<int>& out) {
  out.write(in.read() >> -1);  // refused: shift
}
