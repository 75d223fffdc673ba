#include "ap_int.h"
#include "hls_stream.h"

void missing_semicolon(hls::stream<int>& in, hls::stream<int>& out) {
  out.write(in.read())  // refused: expected ';'
}
