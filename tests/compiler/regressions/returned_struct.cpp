// Small structs return in registers, as one or two wide integers: their members were taken for type punning.
#include "ap_int.h"
#include "hls_stream.h"

struct ring_t {
  ap_uint<8> words[16];
};

static ring_t rotated(const ring_t& ring, int by) {
  ring_t result;
  for (int i = 0; i < 16; ++i) result.words[i] = ring.words[(i + by) & 15];
  return result;
}

void returned_struct(hls::stream<ap_uint<8>>& in, hls::stream<ap_uint<40>>& out) {
  static ring_t ring;
  const ap_uint<8> x = in.read();
  ring = rotated(ring, 1);
  ring.words[15] = x;
  const ring_t turned = rotated(ring, x & 15);
  out.write((turned.words[0], turned.words[5], turned.words[9], turned.words[15], x));
}
