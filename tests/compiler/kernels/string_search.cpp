// Finds a pattern of up to sixteen bytes, don't-care bytes among them, in packets on a bus of four bytes: all four
// positions are compared at once. Pattern and mask are loaded by a stream before the packet.
#include "ap_axi_sdata.h"
#include "ap_int.h"
#include "hls_stream.h"

#define PATTERN 16
#define BUS 4

typedef ap_axiu<8 * BUS, 0, 0, 0> word_t;

struct pattern_byte_t {
  unsigned char value;
  bool care;
  bool last;
};

struct match_t {
  unsigned int position;
  bool end;  // of the packet: position is its length
};

void string_search(hls::stream<pattern_byte_t>& pattern, hls::stream<word_t>& text, hls::stream<match_t>& matches) {
#pragma HLS INTERFACE axis port = pattern
#pragma HLS INTERFACE axis port = text
#pragma HLS INTERFACE axis port = matches
#pragma HLS INTERFACE ap_ctrl_none port = return
  ap_uint<8> wanted[PATTERN];
  bool care[PATTERN];
  ap_uint<8> seen[PATTERN + BUS - 1];
#pragma HLS ARRAY_PARTITION variable = wanted complete
#pragma HLS ARRAY_PARTITION variable = care complete
#pragma HLS ARRAY_PARTITION variable = seen complete
  for (int i = 0; i < PATTERN; i++) {
    wanted[i] = 0;
    care[i] = false;
  }
  // The pattern ends at the end of the array.
  ap_uint<5> length = 0;
  pattern_byte_t p;
  do {
#pragma HLS PIPELINE II = 1
    p = pattern.read();
    for (int i = 0; i < PATTERN - 1; i++) {
      wanted[i] = wanted[i + 1];
      care[i] = care[i + 1];
    }
    wanted[PATTERN - 1] = p.value;
    care[PATTERN - 1] = p.care;
    length++;
  } while (!p.last);

  unsigned int position = 0;
  word_t w;
  do {
#pragma HLS PIPELINE II = 4
    w = text.read();
    for (int i = 0; i < PATTERN - 1; i++) seen[i] = seen[i + BUS];
    for (int b = 0; b < BUS; b++) seen[PATTERN - 1 + b] = w.data.range(8 * b + 7, 8 * b);
    for (int b = 0; b < BUS; b++) {
      bool equal = w.keep[b] && position + b + 1 >= length;
      for (int i = 0; i < PATTERN; i++) equal = equal && (!care[i] || seen[i + b] == wanted[i]);
      if (equal) {
        match_t m;
        m.position = position + b + 1 - length;
        m.end = false;
        matches.write(m);
      }
    }
    for (int b = 0; b < BUS; b++) position += w.keep[b];
  } while (!w.last);
  match_t m;
  m.position = position;
  m.end = true;
  matches.write(m);
}
