// SHA-256 of padded messages: 32-bit words in, a digest of eight words after the block with `last`. The message
// schedule is a shift register of sixteen words beside the rounds; a round a clock, 64 and a few clocks a block.
#include "ap_axi_sdata.h"
#include "ap_int.h"
#include "hls_stream.h"

typedef ap_uint<32> word_t;
typedef ap_axiu<32, 0, 0, 0> beat_t;

static const word_t K[64] = {
    0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5,
    0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
    0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
    0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967,
    0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
    0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070,
    0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
    0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2,
};

static const word_t H0[8] = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                             0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};

template <int N>
word_t rotr(word_t x) {
#pragma HLS INLINE
  return (x >> N) | (x << (32 - N));
}
static word_t ch(word_t x, word_t y, word_t z) { return (x & y) ^ (~x & z); }
static word_t maj(word_t x, word_t y, word_t z) { return (x & y) ^ (x & z) ^ (y & z); }
static word_t bsig0(word_t x) { return rotr<2>(x) ^ rotr<13>(x) ^ rotr<22>(x); }
static word_t bsig1(word_t x) { return rotr<6>(x) ^ rotr<11>(x) ^ rotr<25>(x); }
static word_t ssig0(word_t x) { return rotr<7>(x) ^ rotr<18>(x) ^ (x >> 3); }
static word_t ssig1(word_t x) { return rotr<17>(x) ^ rotr<19>(x) ^ (x >> 10); }

void sha256(hls::stream<beat_t>& message, hls::stream<word_t>& digest) {
#pragma HLS INTERFACE axis port = message
#pragma HLS INTERFACE axis port = digest
#pragma HLS INTERFACE ap_ctrl_none port = return
  word_t h[8];
#pragma HLS ARRAY_PARTITION variable = h complete
  for (int i = 0; i < 8; i++) {
#pragma HLS UNROLL
    h[i] = H0[i];
  }
  bool last = false;
blocks:
  while (!last) {
    word_t w[16];
#pragma HLS ARRAY_PARTITION variable = w complete
    word_t a = h[0], b = h[1], c = h[2], d = h[3], e = h[4], f = h[5], g = h[6], hh = h[7];
  rounds:
    for (int t = 0; t < 64; t++) {
#pragma HLS PIPELINE II = 1
      word_t wt;
      if (t < 16) {
        beat_t beat = message.read();
        wt = beat.data;
        if (t == 15) last = beat.last;
      } else {
        wt = ssig1(w[14]) + w[9] + ssig0(w[1]) + w[0];
      }
      for (int i = 0; i < 15; i++) w[i] = w[i + 1];
      w[15] = wt;
      const word_t t1 = hh + bsig1(e) + ch(e, f, g) + K[t] + wt;
      const word_t t2 = bsig0(a) + maj(a, b, c);
      hh = g;
      g = f;
      f = e;
      e = d + t1;
      d = c;
      c = b;
      b = a;
      a = t1 + t2;
    }
    h[0] += a;
    h[1] += b;
    h[2] += c;
    h[3] += d;
    h[4] += e;
    h[5] += f;
    h[6] += g;
    h[7] += hh;
  }
output:
  for (int i = 0; i < 8; i++) {
#pragma HLS PIPELINE II = 1
    digest.write(h[i]);
  }
}
