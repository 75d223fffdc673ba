// options: --clock 6ns
#include "ap_int.h"
#include "hls_stream.h"

void division_by_variable(hls::stream<ap_uint<16>>& numerator, hls::stream<ap_uint<16>>& denominator,
                          hls::stream<ap_uint<16>>& quotient) {
  const ap_uint<16> a = numerator.read();
  const ap_uint<16> b = denominator.read();
  quotient.write(a / b);  // refused: divi
}
