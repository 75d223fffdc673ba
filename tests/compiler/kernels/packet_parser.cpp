// Parser of length-prefixed packets: 0x55, kind, length, payload, check byte (sum of kind, length and payload).
// The payload goes out as it comes; after the check byte one verdict goes out on another stream.
// one iteration a token of in
#include "ap_int.h"
#include "hls_stream.h"

enum state_t { hunting, reading_kind, reading_length, reading_payload, reading_check };

struct payload_t {
  ap_uint<8> byte;
  ap_uint<4> kind;
  bool first;
};

struct verdict_t {
  ap_uint<4> kind;
  ap_uint<8> length;
  bool good;
  verdict_t() {}
  verdict_t(ap_uint<4> k, ap_uint<8> l, bool g) : kind(k), length(l), good(g) {}
};

void packet_parser(hls::stream<ap_uint<8>>& in, hls::stream<payload_t>& payload, hls::stream<verdict_t>& verdict) {
#pragma HLS PIPELINE II = 1
  static state_t state = hunting;
  static ap_uint<8> kind = 0;
  static ap_uint<8> length = 0;
  static ap_uint<8> left = 0;
  static ap_uint<8> sum = 0;

  const ap_uint<8> byte = in.read();
  switch (state) {
    case hunting:
      if (byte == 0x55) state = reading_kind;
      break;
    case reading_kind:
      kind = byte;
      sum = byte;
      state = reading_length;
      break;
    case reading_length:
      length = byte;
      left = byte;
      sum += byte;
      state = byte == 0 ? reading_check : reading_payload;
      break;
    case reading_payload: {
      payload_t p;
      p.byte = byte;
      p.kind = kind;
      p.first = left == length;
      payload.write(p);
      sum += byte;
      left--;
      if (left == 0) state = reading_check;
      break;
    }
    default:
      verdict.write(verdict_t(kind, length, byte == sum));
      state = hunting;
      break;
  }
}
