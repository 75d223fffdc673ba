// A table that a function fills at its first call was refused as shared where two processes call the function.
#include <cmath>

#include "ap_int.h"
#include "hls_stream.h"

namespace {

struct wave_t {
  short word[64];
  wave_t() {
    for (int i = 0; i < 64; ++i) word[i] = static_cast<short>(1000 * std::sin(i * 0.1));
  }
};

short wave(ap_uint<6> at) {
  static const wave_t table;
  return table.word[at];
}

// With a flag of its own, and no floating point.
ap_uint<8> square(ap_uint<4> x) {
  static bool initialized = false;
  static ap_uint<8> table[16];
  if (!initialized) {
    for (int i = 0; i < 16; ++i) table[i] = i * i;
    initialized = true;
  }
  return table[x];
}

void first(hls::stream<ap_uint<6>>& in, hls::stream<ap_uint<6>>& between) {
  for (int i = 0; i < 4; ++i) {
#pragma HLS PIPELINE
    const ap_uint<6> x = in.read();
    between.write(wave(x) + square(x & 15));
  }
}

void second(hls::stream<ap_uint<6>>& between, hls::stream<ap_int<20>>& out) {
  for (int i = 0; i < 4; ++i) {
#pragma HLS PIPELINE
    const ap_uint<6> x = between.read();
    out.write(wave(x) * 16 + square(x >> 2));
  }
}

}  // namespace

void dataflow_tables(hls::stream<ap_uint<6>>& in, hls::stream<ap_int<20>>& out) {
#pragma HLS DATAFLOW
  hls::stream<ap_uint<6>> between("between");
  first(in, between);
  second(between, out);
}
