// Numbers given as text were refused; so was a number whose loop ends where its constants say.
#include "ap_int.h"
#include "hls_stream.h"

static int bits_of(unsigned long long value) {
  int bits = 0;
  while (value != 0) {
    value >>= 1;
    ++bits;
  }
  return bits;
}

void numbers_of_text(hls::stream<ap_uint<128>>& in, hls::stream<ap_uint<128>>& out) {
  const ap_uint<128> key("0123456789abcdef0123456789abcdef", 16);
  const ap_uint<128> mask = "0xffff0000ffff0000ffff0000ffff0f00";
  static const ap_uint<64> polynomial("42F0E1EBA9EA3693", 16);
  const ap_int<20> rounded(-3.9 * 1000);
  out.write((((in.read() & mask) ^ key) >> bits_of(polynomial.to_uint64() >> 50)) ^ polynomial ^
            ap_uint<128>(ap_uint<20>(rounded)));
}
