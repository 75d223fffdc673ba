// An array of streams given to the processes as a whole: work is dealt out to four workers in turn, by a counter, and
// collected by an unrolled loop.
#include "ap_int.h"
#include "hls_stream.h"

#define LANES 4
typedef ap_uint<14> value_t;

static void deal(hls::stream<value_t>& in, hls::stream<value_t> lanes[LANES], ap_uint<6> rows) {
  for (int i = 0; i < rows * LANES; i++) {
#pragma HLS PIPELINE
    lanes[i % LANES].write(in.read());
  }
}

static void work(hls::stream<value_t>& lane, hls::stream<value_t>& done, ap_uint<6> rows, int number) {
  value_t before = number;
  for (int i = 0; i < rows; i++) {
#pragma HLS PIPELINE
    value_t v = lane.read();
    done.write(v ^ (before << number));
    before = v;
  }
}

static void collect(hls::stream<value_t> (&done)[LANES], hls::stream<ap_uint<14 * LANES>>& out, ap_uint<6> rows) {
  for (int i = 0; i < rows; i++) {
#pragma HLS PIPELINE
    ap_uint<14 * LANES> word = 0;
    for (int lane = 0; lane < LANES; lane++) {
#pragma HLS UNROLL
      word.range(14 * lane + 13, 14 * lane) = done[lane].read();
    }
    out.write(word);
  }
}

void dataflow_lanes(hls::stream<value_t>& in, hls::stream<ap_uint<14 * LANES>>& out, ap_uint<6> rows) {
#pragma HLS DATAFLOW
  hls::stream<value_t> lanes[LANES], done[LANES];
#pragma HLS STREAM variable = lanes depth = 4
  deal(in, lanes, rows);
  for (int i = 0; i < LANES; i++) {
#pragma HLS UNROLL
    work(lanes[i], done[i], rows, i);
  }
  collect(done, out, rows);
}
