// Syndromes of Reed-Solomon (255, 239) codewords over GF(2^8): sixteen multiply-accumulate cells, one byte a clock.
// Byte packets pass through unchanged; their syndromes follow on a second stream, with a flag for an error. one
// iteration a token of in
#include "ap_axi_sdata.h"
#include "ap_int.h"
#include "hls_stream.h"

#define PARITY 16

typedef ap_axiu<8, 0, 0, 0> byte_t;
typedef ap_uint<8> symbol_t;

struct syndromes_t {
  symbol_t s[PARITY];
  bool error;
};

// x^8 + x^4 + x^3 + x^2 + 1
static constexpr unsigned times_alpha(unsigned x) { return (x << 1) ^ ((x & 0x80) != 0 ? 0x11d : 0); }

template <int POWER>
struct alpha_power {
  static const unsigned value = times_alpha(alpha_power<POWER - 1>::value);
};
template <>
struct alpha_power<0> {
  static const unsigned value = 1;
};

// A product with a constant is a few exclusive ors.
static symbol_t gf_multiply(symbol_t x, symbol_t constant) {
#pragma HLS INLINE
  ap_uint<16> product = 0;
  for (int i = 0; i < 8; i++) {
#pragma HLS UNROLL
    if (constant[i]) product ^= ap_uint<16>(x) << i;
  }
  for (int i = 14; i >= 8; i--) {
#pragma HLS UNROLL
    if (product[i]) product ^= ap_uint<16>(0x11d) << (i - 8);
  }
  return product;
}

template <int I>
struct cells {
  static void step(symbol_t s[PARITY], symbol_t x, bool first) {
#pragma HLS INLINE
    s[I] = (first ? symbol_t(0) : gf_multiply(s[I], alpha_power<I>::value)) ^ x;
    cells<I + 1>::step(s, x, first);
  }
};
template <>
struct cells<PARITY> {
  static void step(symbol_t*, symbol_t, bool) {}
};

void reed_solomon_syndromes(hls::stream<byte_t>& in, hls::stream<byte_t>& out, hls::stream<syndromes_t>& syndromes) {
#pragma HLS INTERFACE axis port = in
#pragma HLS INTERFACE axis port = out
#pragma HLS INTERFACE axis port = syndromes
#pragma HLS INTERFACE ap_ctrl_none port = return
#pragma HLS PIPELINE II = 1
  static bool first = true;
  static syndromes_t state;
#pragma HLS ARRAY_PARTITION variable = state.s complete

  byte_t beat;
  in >> beat;
  cells<0>::step(state.s, beat.data, first);
  first = beat.last;
  out << beat;
  if (beat.last) {
    state.error = false;
    for (int i = 0; i < PARITY; i++) state.error |= state.s[i] != 0;
    syndromes << state;
  }
}
