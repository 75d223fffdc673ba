// Error counter of a serial link's test pattern PRBS-31 (x^31 + x^28 + 1), 32 bits a clock: the checker loads its
// register from the line until it has seen eight words without an error, then it runs by itself and counts wrong bits;
// sixteen bad words of 64 in a row mean that lock is lost.
#include "ap_int.h"
#include "hls_stream.h"

struct status_t {
  bool locked;
  ap_uint<6> errors;  // of this word
  ap_uint<24> total;  // since lock, it saturates
};

static ap_uint<32> next_word(ap_uint<31>& state) {
#pragma HLS INLINE
  ap_uint<32> word;
  for (int i = 0; i < 32; i++) {
#pragma HLS UNROLL
    const ap_uint<1> bit = state[30] ^ state[27];
    state = (state.range(29, 0), bit);
    word[31 - i] = bit;
  }
  return word;
}

void prbs_checker(hls::stream<ap_uint<32>>& line, hls::stream<status_t>& status) {
#pragma HLS INTERFACE axis port = line
#pragma HLS INTERFACE axis port = status
#pragma HLS INTERFACE ap_ctrl_none port = return
#pragma HLS PIPELINE II = 1
  static ap_uint<31> state = 0x7fffffff;
  static bool locked = false;
  static ap_uint<3> good_words = 0;
  static ap_uint<6> window = 0;
  static ap_uint<5> bad_words = 0;
  static ap_uint<24> total = 0;

  const ap_uint<32> received = line.read();
  ap_uint<31> following = state;
  const ap_uint<32> expected = next_word(following);
  const ap_uint<32> difference = received ^ expected;
  ap_uint<6> errors = 0;
  for (int i = 0; i < 32; i++) errors += difference[i];

  if (!locked) {
    state = received.range(30, 0);
    good_words = difference == 0 && received != 0 ? ap_uint<3>(good_words + 1) : ap_uint<3>(0);
    if (difference == 0 && good_words == 0 && received != 0) {
      locked = true;
      total = 0;
      window = 0;
      bad_words = 0;
    }
  } else {
    state = following;
    total = total > 0xffffff - 32 ? ap_uint<24>(0xffffff) : ap_uint<24>(total + errors);
    if (window == 63) bad_words = 0;
    window++;
    if (difference != 0) bad_words++;
    if (bad_words == 16) {
      locked = false;
      good_words = 0;
    }
  }
  status_t s;
  s.locked = locked;
  s.errors = errors;
  s.total = total;
  status.write(s);
}
