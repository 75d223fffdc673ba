// A static variable of a template's function that begins with a value of the first call was refused: "accessed as
// another type than it has"; and what it was given may be changed later, which a table's may not.
#include "ap_int.h"
#include "hls_stream.h"

template <int step>
ap_uint<16> counted(ap_uint<16> start) {
  static ap_uint<16> count = start;
  count += step;
  return count;
}

template <int unused>
ap_uint<16> histogram(ap_uint<4> bin) {
  static bool cleared = false;
  static ap_uint<16> bins[16];
  if (!cleared) {
    for (int i = 0; i < 16; ++i) bins[i] = 100 + i;
    cleared = true;
  }
  bins[bin] += 1;
  return bins[bin];
}

// Read before the first call fills it: it holds zeros then.
ap_uint<8> late(ap_uint<3> at) {
  static bool filled = false;
  static ap_uint<8> table[8];
  const ap_uint<8> before = table[at];
  if (!filled) {
    for (int i = 0; i < 8; ++i) table[i] = 3 * i + 1;
    filled = true;
  }
  return before ^ table[7 - at];
}

// The flag itself is looked at.
bool is_first() {
  static bool seen = false;
  const bool before = seen;
  if (!before) seen = true;
  return !before;
}

void static_of_first_call(hls::stream<ap_uint<16>>& in, hls::stream<ap_uint<41>>& out) {
  const ap_uint<16> x = in.read();
  out.write((ap_uint<1>(is_first()), late(x), counted<3>(x), histogram<0>(x)));
}
