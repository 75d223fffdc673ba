// Tables that code fills with the C library's mathematics were refused: in a local array at the beginning of every
// call, in a static one at the first call, by a constructor, before main; and single values.
#include <cmath>

#include "ap_fixed.h"
#include "ap_int.h"
#include "hls_stream.h"

using wave_t = ap_fixed<16, 2, AP_RND, AP_SAT>;
using level_t = ap_fixed<18, 4>;

// At the beginning of every call.
static void fill_sine(short table[64]) {
  for (int i = 0; i < 64; ++i) table[i] = static_cast<short>(32767.0 * sin(2 * M_PI * i / 64));
}

// At the first call: the flag of generated networks. Of a template, so that more than one file may have it.
template <int size>
level_t sigmoid(ap_fixed<12, 5> x) {
  static bool initialized = false;
  static level_t table[size];
  if (!initialized) {
    for (int i = 0; i < size; ++i) {
      const float at = 32.0f * (float(i) - size / 2.0f) / size;
      table[i] = 1.0f / (1.0f + std::exp(-at));
    }
    initialized = true;
  }
  int index = (x * size) / 32 + size / 2;
  if (index < 0) index = 0;
  if (index > size - 1) index = size - 1;
  return table[index];
}

// By a constructor, with two loops of which the second needs what the first found.
template <int taps>
struct window_t {
  wave_t weight[taps];
  float scale;
  window_t() {
    float raw[taps];
    float sum = 0;
    for (int i = 0; i < taps; ++i) {
      raw[i] = 0.5f - 0.5f * std::cos(2.0f * 3.14159265f * i / (taps - 1));
      sum += raw[i];
    }
    scale = 1 / sum;
    for (int i = 0; i < taps; ++i) weight[i] = raw[i] * scale * 8;
  }
};

// Before main.
struct powers_t {
  ap_int<16> word[32];
  powers_t() {
    for (int i = 0; i < 32; ++i) word[i] = static_cast<int>(std::pow(1.3, i)) % 30000;
  }
};
static const powers_t powers;
static const level_t eighth_turn = std::atan(1.0);

void tables_of_constants(hls::stream<ap_uint<12>>& in, hls::stream<ap_int<40>>& out) {
  short sine[64];
  fill_sine(sine);
  static const window_t<16> window;
  const wave_t scale = window.scale * 8;
  for (int i = 0; i < 16; ++i) {
#pragma HLS PIPELINE
    const ap_uint<12> x = in.read();
    const ap_uint<6> at = x >> 6;
    ap_fixed<12, 5> signed_x;
    signed_x.V = ap_int<12>(x);
    ap_fixed<40, 30> sum = sine[at] + sigmoid<256>(signed_x) * powers.word[x & 31] + eighth_turn + scale;
    sum += window.weight[i] * ap_int<13>(x);
    for (int k = 1; k < 4; ++k) sum += wave_t(std::sqrt(0.2 * k)) * (x >> k);  // single values, where it is unrolled
    out.write(sum.V);
  }
}
