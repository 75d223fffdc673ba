// A state machine that asks for tokens in some of its steps only, beside a switch over all values of a number, and with
// a variable of which each half is written by itself.
#include <ap_axi_sdata.h>
#include <ap_int.h>
#include <hls_stream.h>

typedef ap_axiu<32, 0, 0, 0> word_t;

static void add_up(hls::stream<word_t>& in, hls::stream<word_t>& out, hls::stream<bool>& is_good) {
#pragma HLS PIPELINE II = 1
  static ap_uint<17> sums[2] = {0, 0};
  static ap_uint<1> step = 0;
  static bool is_last = false;
  if (is_last) {
    switch (step) {
      case 0:
        sums[0] = sums[0] + sums[1];
        sums[0] = (sums[0] + (sums[0] >> 16)) & 0xffff;
        step = 1;
        break;
      case 1:
        is_good.write(sums[0][0] == 0);
        sums[0] = 0;
        sums[1] = 0;
        step = 0;
        is_last = false;
        break;
    }
  } else if (!in.empty()) {
    const word_t word = in.read();
    for (int i = 0; i < 2; ++i) {
#pragma HLS UNROLL
      ap_uint<16> half;
      half(7, 0) = word.data(16 * i + 15, 16 * i + 8);
      half(15, 8) = word.data(16 * i + 7, 16 * i);
      sums[i] += half;
      sums[i] = (sums[i] + (sums[i] >> 16)) & 0xffff;
    }
    out.write(word);
    is_last = word.last;
  }
}

static void drop(hls::stream<word_t>& in, hls::stream<bool>& is_good, hls::stream<word_t>& out) {
#pragma HLS PIPELINE II = 1
  enum state_t { FIRST, KEEP, SKIP };
  static state_t state = FIRST;
  word_t word;
  switch (state) {
    case FIRST:
      if (!is_good.empty()) state = is_good.read() ? KEEP : SKIP;
      break;
    case KEEP:
      if (!in.empty()) {
        in.read(word);
        out.write(word);
        if (word.last) state = FIRST;
      }
      break;
    default:
      if (!in.empty()) {
        in.read(word);
        if (word.last) state = FIRST;
      }
      break;
  }
}

void asks_between_steps(hls::stream<word_t>& in, hls::stream<word_t>& out) {
#pragma HLS DATAFLOW
  static hls::stream<word_t> words("words");
  static hls::stream<bool> is_good("is_good");
#pragma HLS STREAM variable = words depth = 32
#pragma HLS STREAM variable = is_good depth = 4
  add_up(in, words, is_good);
  drop(words, is_good, out);
}
