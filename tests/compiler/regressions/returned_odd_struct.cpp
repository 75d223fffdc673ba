// A struct of 9 bytes returns as { i64, i8 }, which is 16 bytes in memory: its members were taken for type punning.
#include "ap_int.h"
#include "hls_stream.h"

struct pair_t {
  ap_uint<8> bytes[8];
  ap_uint<1> odd;
};

static pair_t shifted(const pair_t& before, ap_uint<8> newest, bool enabled) {
  pair_t result;
  for (int i = 0; i < 7; ++i) result.bytes[i] = enabled ? before.bytes[i + 1] : before.bytes[i];
  result.bytes[7] = newest;
  result.odd = newest & 1;
  return result;
}

void returned_odd_struct(hls::stream<ap_uint<8>>& in, hls::stream<ap_uint<65>>& out) {
  static pair_t kept;
  const ap_uint<8> x = in.read();
  kept = shifted(kept, x, x > 99);
  out.write((kept.odd, kept.bytes[7], kept.bytes[6], kept.bytes[5], kept.bytes[4], kept.bytes[3], kept.bytes[2],
             kept.bytes[1], kept.bytes[0]));
}
