// Scalars behind pointers, in arrays written with their sizes and behind references: what the top only reads is given,
// what it writes is a result. Two processes use one of them.
#include <ap_fixed.h>
#include <ap_int.h>
#include <hls_stream.h>

constexpr int taps = 5;
typedef ap_fixed<12, 2> tap_t;

struct limits_t {
  ap_int<20> low, high;
};

static void filter(hls::stream<ap_int<12>>& in, hls::stream<ap_int<20>>& out, const tap_t* coefficients,
                   const short more[2][2], ap_uint<8>* count) {
  ap_int<12> line[taps] = {};
  for (int i = 0; i < *count; ++i) {
#pragma HLS PIPELINE
    ap_fixed<26, 16> sum = 0;
    for (int k = taps - 1; k > 0; --k) {
      line[k] = line[k - 1];
      sum += line[k] * coefficients[k];
    }
    line[0] = in.read();
    sum += line[0] * coefficients[0];
    out.write(sum.to_int() + more[i & 1][i >> 1 & 1]);
  }
}

static void clip(hls::stream<ap_int<20>>& in, hls::stream<ap_int<20>>& out, limits_t& limits, ap_uint<8>* count,
                 unsigned* clipped, ap_int<20> extremes[2]) {
  unsigned changed = 0;
  ap_int<20> least = 0, most = 0;
  for (int i = 0; i < *count; ++i) {
    ap_int<20> value = in.read();
    if (value < least) least = value;
    if (value > most) most = value;
    const ap_int<20> inside = value < limits.low ? limits.low : value > limits.high ? limits.high : value;
    changed += inside != value;
    out.write(inside);
  }
  *clipped = changed;
  extremes[0] = least;
  extremes[1] = most;
}

void behind_pointers(hls::stream<ap_int<12>>& in, hls::stream<ap_int<20>>& out, tap_t coefficients[taps],
                     const short more[2][2], limits_t& limits, ap_uint<8>* count, unsigned* clipped,
                     ap_int<20> extremes[2], bool* any) {
#pragma HLS DATAFLOW
  hls::stream<ap_int<20>> between;
  filter(in, between, coefficients, more, count);
  clip(between, out, limits, count, clipped, extremes);
  *any = *count != 0;
}
