#include "ap_int.h"
#include "hls_stream.h"

void integer_of_negative_width(hls::stream<ap_int<-3>>& in, hls::stream<int>& out) {
  out.write(in.read());  // refused: width|bits
}
