// A word is read, and read again at the same address, written another way, where what was read decides whether: both
// reads once had to be in the same clock.
#include <ap_int.h>
#include <hls_stream.h>

void reads_a_word_again(hls::stream<ap_int<33>>& in, hls::stream<ap_uint<22>>& out) {
#pragma HLS PIPELINE II = 1
  static ap_uint<22> words[128];
  const ap_int<33> token = in.read();
  ap_uint<22> word = words[ap_uint<7>(ap_int<32>(static_cast<int>(ap_int<13>(token))))];
  if (word != token) {
    word <<= 8;
  } else {
    ap_uint<33> steps[4];
    for (int i = 0; i < 4; ++i) steps[i] = ap_uint<4>(word) + i;
    steps[ap_uint<2>(word + token)] ^= 1;
    word += steps[ap_uint<2>(token)];
  }
  if (ap_uint<2>(word.range(14, 13)) < ap_uint<2>(token)) words[ap_uint<7>(token)] |= ap_uint<12>(token >> 5);
  out.write(word);
}
