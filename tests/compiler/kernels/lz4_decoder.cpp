// Decompressor of LZ4 blocks: literals and matches of the last 1024 bytes, a byte a clock whatever it comes from. The
// block ends, as LZ4's do, with literals: `last` of the input marks its final byte.
#include "ap_axi_sdata.h"
#include "ap_int.h"
#include "hls_stream.h"

#define HISTORY_BITS 10
#define HISTORY (1 << HISTORY_BITS)

typedef ap_axiu<8, 0, 0, 0> byte_t;
typedef ap_uint<HISTORY_BITS> position_t;

enum lz4_state { TOKEN, LITERAL_LENGTH, LITERALS, OFFSET_LOW, OFFSET_HIGH, MATCH_LENGTH, MATCH };

void lz4_decoder(hls::stream<byte_t>& in, hls::stream<byte_t>& out) {
#pragma HLS INTERFACE axis port = in
#pragma HLS INTERFACE axis port = out
#pragma HLS INTERFACE ap_ctrl_none port = return
  static ap_uint<8> history[HISTORY];
#pragma HLS BIND_STORAGE variable = history type = ram_2p impl = bram
  position_t head = 0;
  position_t offset = 0;
  ap_uint<16> literals = 0, match = 0;
  lz4_state state = TOKEN;
  bool last = false;
  bool more_length = false;

decode:
  while (!last) {
#pragma HLS PIPELINE II = 1
    byte_t beat;
    ap_uint<8> c = 0;
    if (state != MATCH) {
      beat = in.read();
      c = beat.data;
      last = beat.last;
    }
    ap_uint<8> produced = 0;
    bool produce = false;

    switch (state) {
      case TOKEN:
        literals = c >> 4;
        match = (c & 15) + 4;
        more_length = (c & 15) == 15;
        state = literals == 15 ? LITERAL_LENGTH : literals != 0 ? LITERALS : OFFSET_LOW;
        break;
      case LITERAL_LENGTH:
        literals += c;
        if (c != 255) state = LITERALS;
        break;
      case LITERALS:
        produced = c;
        produce = true;
        literals--;
        if (literals == 0) state = OFFSET_LOW;
        break;
      case OFFSET_LOW:
        offset = c;
        state = OFFSET_HIGH;
        break;
      case OFFSET_HIGH:
        offset.range(HISTORY_BITS - 1, 8) = c.range(HISTORY_BITS - 9, 0);
        state = more_length ? MATCH_LENGTH : MATCH;
        break;
      case MATCH_LENGTH:
        match += c;
        if (c != 255) state = MATCH;
        break;
      case MATCH:
        produced = history[position_t(head - offset)];
        produce = true;
        match--;
        if (match == 0) state = TOKEN;
        break;
    }
    if (produce) {
      history[head] = produced;
      head++;
      byte_t o;
      o.data = produced;
      o.keep = -1;
      o.strb = -1;
      o.last = last;
      out.write(o);
    }
  }
}
