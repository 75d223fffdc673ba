// DC coefficients of a baseline JPEG scan: stuffed bytes in, differences out. The bits are looked at one by one, as in
// figures F.12 to F.16 of the standard; table K.3 (luminance) stands in three small ROMs.
#include "ap_int.h"
#include "hls_stream.h"

typedef ap_uint<8> byte_t;

struct difference_t {
  ap_uint<4> category;
  ap_int<12> value;
};

// Per code length: the largest code (-1: none), the smallest, and where its symbols begin.
static const ap_int<17> MAXCODE[10] = {-1, -1, 0, 6, 14, 30, 62, 126, 254, 510};
static const ap_uint<9> MINCODE[10] = {0, 0, 0, 2, 14, 30, 62, 126, 254, 510};
static const ap_uint<4> VALPTR[10] = {0, 0, 0, 1, 6, 7, 8, 9, 10, 11};
static const ap_uint<4> HUFFVAL[12] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};

struct bit_source {
  byte_t current;
  ap_uint<4> left;

  bit_source() : current(0), left(0) {}
  // figure F.18
  ap_uint<1> next(hls::stream<byte_t>& scan) {
#pragma HLS INLINE
    if (left == 0) {
      current = scan.read();
      left = 8;
      if (current == 0xff) scan.read();  // the stuffed zero
    }
    left--;
    return current[left];
  }
};

void huffman_decoder(hls::stream<byte_t>& scan, hls::stream<difference_t>& differences, unsigned short blocks) {
#pragma HLS INTERFACE axis port = scan
#pragma HLS INTERFACE axis port = differences
#pragma HLS INTERFACE s_axilite port = blocks
#pragma HLS INTERFACE s_axilite port = return
  bit_source bits;
BLOCK:
  for (unsigned short n = 0; n < blocks; n++) {
    ap_int<17> code = bits.next(scan);
    ap_uint<4> length = 1;
  CODE:
    while (code > MAXCODE[length]) {
#pragma HLS PIPELINE
      code = (code << 1) + bits.next(scan);
      length++;
    }
    const ap_uint<4> category = HUFFVAL[VALPTR[length] + code - MINCODE[length]];
    ap_int<12> value = 0;
  RECEIVE:
    for (ap_uint<4> i = 0; i < category; i++) {
#pragma HLS PIPELINE
      value = (value << 1) + bits.next(scan);
    }
    if (category != 0 && value < (1 << (category - 1))) value += (-1 << category) + 1;
    difference_t d;
    d.category = category;
    d.value = value;
    differences.write(d);
  }
}
