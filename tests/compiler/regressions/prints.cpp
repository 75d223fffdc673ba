// Text for the native run, with the vendors' headers that came for it: hardware prints nothing.
#include "ap_int.h"
#include "ap_utils.h"
#include "hls_print.h"
#include "hls_stream.h"

void prints(hls::stream<ap_int<12>>& in, hls::stream<ap_int<13>>& out) {
  const ap_int<12> value = in.read();
  if (value == -2048) hls::print("the smallest: %d\n", value.to_int());
  hls::print("");
  out.write(-value);
}
