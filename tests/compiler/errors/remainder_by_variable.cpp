// options: --clock 6ns
#include "ap_int.h"
#include "hls_stream.h"

void remainder_by_variable(hls::stream<int>& in, hls::stream<int>& out, int modulus) {
  out.write(in.read() % modulus);  // refused: remainder|divi
}
