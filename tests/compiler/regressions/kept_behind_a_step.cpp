// State that a reset leaves alone was refused where a step comes before the endless loop that has it: one that fills a
// memory, all at once or a word at a time. That it is there after a reset is tested by
// test_kept_state.py.
// epiline-hls: --clock 25ns
#include <ap_int.h>
#include <hls_stream.h>
#include <hls_task.h>

static void few_words(hls::stream<ap_uint<14>>& in, hls::stream<ap_uint<33>>& between) {
  static ap_uint<16> place = 65535;
#pragma HLS RESET variable = place off
  ap_uint<33> ram[32];
  for (int i = 0; i < 32; ++i) {
#pragma HLS PIPELINE II = 1
    ram[i] = i * 198;
  }
  while (true) {
#pragma HLS PIPELINE II = 1
    const ap_uint<14> value = in.read();
    const ap_uint<33> word = ram[ap_uint<5>(place + place)];
    ram[ap_uint<5>(value)] = word + value;
    if (value % 4 != 1) place = ap_uint<8>(value);
    between.write(word);
  }
}

static void many_words(hls::stream<ap_uint<33>>& between, hls::stream<ap_uint<40>>& out) {
  static ap_uint<9> place = 77;
#pragma HLS RESET variable = place off
  static ap_int<40> sum = -5;
#pragma HLS RESET variable = sum off
  ap_uint<20> ram[512];
  for (int i = 0; i < 100; ++i) {
#pragma HLS PIPELINE II = 1
    ram[i + 70] = between.read();
  }
  while (true) {
#pragma HLS PIPELINE II = 1
    const ap_uint<33> value = between.read();
    sum += ram[place];
    if (value % 2 == 0 && place < 160) place += 1;
    out.write(sum ^ value);
  }
}

void kept_behind_a_step(hls::stream<ap_uint<14>>& in, hls::stream<ap_uint<40>>& out) {
  hls_thread_local hls::stream<ap_uint<33>> between("between");
  hls_thread_local hls::task first(few_words, in, between);
  hls_thread_local hls::task second(many_words, between, out);
}
