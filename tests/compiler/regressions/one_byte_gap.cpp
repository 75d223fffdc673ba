// A struct with a gap of one byte in front of `size`, and one that has a member in such a place: the gap was a part of
// the token. What is read of the first goes out in the second.
#include "ap_int.h"
#include "hls_stream.h"

struct gap_t {
  ap_uint<17> address;
  ap_uint<7> high[2];
  bool flag;
  short size;
  ap_uint<99> rest;
};
struct full_t {
  ap_uint<7> high;
  bool flag;
  short size;
};

void one_byte_gap(hls::stream<gap_t>& in, hls::stream<full_t>& out) {
#pragma HLS PIPELINE
  const gap_t from = in.read();
  full_t to;
  to.high = from.high[from.address & 1];
  to.flag = from.flag ^ (from.rest[98] != 0);
  to.size = static_cast<short>(from.size ^ static_cast<int>(from.address >> 1));
  out.write(to);
}
