// Arrays of beats between processes: in order, member by member and as a whole, and out of order. A member whose mark,
// which has no size, comes first was taken for the mark.
#include <ap_axi_sdata.h>
#include <hls_stream.h>

typedef ap_axis<32, 2, 5, 6> beat_t;
constexpr int beats = 40;

static void load(const beat_t in[beats], hls::stream<beat_t>& raw) {
  for (int i = 0; i < beats; ++i) raw.write(in[i]);
}

static void scale(hls::stream<beat_t>& raw, hls::stream<beat_t>& scaled, ap_int<8> factor) {
  for (int i = 0; i < beats; ++i) {
#pragma HLS PIPELINE II = 1
    beat_t beat = raw.read();
    beat.data = beat.data * factor;
    scaled.write(beat);
  }
}

static void store(hls::stream<beat_t>& scaled, beat_t out[beats], beat_t reversed[4]) {
  for (int i = 0; i < beats; ++i) {
    const beat_t beat = scaled.read();
    out[i].data = beat.data;
    out[i].keep = beat.keep;
    out[i].strb = beat.strb;
    out[i].user = beat.user;
    out[i].last = i == beats - 1;
    out[i].id = beat.id;
    out[i].dest = beat.dest;
    if (i < 4) reversed[3 - i] = beat;
  }
}

void arrays_of_beats(beat_t in[beats], beat_t out[beats], beat_t reversed[4], ap_int<8> factor) {
#pragma HLS INTERFACE axis port = in
#pragma HLS INTERFACE axis port = out, reversed
#pragma HLS DATAFLOW
  hls::stream<beat_t> raw, scaled;
  load(in, raw);
  scale(raw, scaled, factor);
  store(scaled, out, reversed);
}
