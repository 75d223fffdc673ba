// Packs variable-length codes (length 0..12) into 16-bit words, first bit on top; a length of 15 flushes.
// The recurrence holds a barrel shifter, so it needs a slower clock than the default.
// epiline-hls: --clock 20ns
// one iteration a token of codes
#include "ap_int.h"
#include "hls_stream.h"

struct code_t {
  ap_uint<12> bits;
  ap_uint<4> length;
};

void bit_packer(hls::stream<code_t>& codes, hls::stream<ap_uint<16>>& words) {
#pragma HLS PIPELINE II = 1
  static ap_uint<32> pool = 0;   // valid bits at the top
  static ap_uint<6> filled = 0;  // 0..15 between calls
  const code_t c = codes.read();
  if (c.length == 15) {
    if (filled != 0) words.write(pool.range(31, 16));
    pool = 0;
    filled = 0;
  } else {
    const ap_uint<32> aligned = ap_uint<32>(c.bits & ((ap_uint<13>(1) << c.length) - 1)) << (32 - filled - c.length);
    pool |= c.length == 0 ? ap_uint<32>(0) : aligned;
    filled += c.length;
    if (filled >= 16) {
      words.write(pool.range(31, 16));
      pool <<= 16;
      filled -= 16;
    }
  }
}
