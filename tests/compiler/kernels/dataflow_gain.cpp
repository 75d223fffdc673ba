// Load, compute, store: the vendors' pattern. The scalars go to several processes; sizes differ from call to call.
#include "ap_axi_sdata.h"
#include "ap_int.h"
#include "hls_stream.h"

typedef ap_axiu<16, 1, 1, 1> beat_t;
typedef ap_uint<16> sample_t;

static void load(hls::stream<beat_t>& in, hls::stream<sample_t>& samples, ap_uint<12> count) {
load_samples:
  for (int i = 0; i < count; i++) {
#pragma HLS PIPELINE II = 1
    samples.write(in.read().data);
  }
}

static void compute(hls::stream<sample_t>& samples, hls::stream<sample_t>& scaled, ap_uint<12> count, ap_uint<8> gain,
                    ap_uint<16> offset) {
scale_samples:
  for (int i = 0; i < count; i++) {
#pragma HLS PIPELINE II = 1
    ap_uint<32> product = samples.read() * gain;
    scaled.write((product >> 4) + offset);
  }
}

static void store(hls::stream<sample_t>& scaled, hls::stream<beat_t>& out, ap_uint<12> count) {
store_samples:
  for (int i = 0; i < count; i++) {
#pragma HLS PIPELINE II = 1
    beat_t beat;
    beat.data = scaled.read();
    beat.keep = -1;
    beat.strb = -1;
    beat.user = i == 0;
    beat.last = i + 1 == count;
    beat.id = 0;
    beat.dest = 0;
    out.write(beat);
  }
}

void dataflow_gain(hls::stream<beat_t>& in, hls::stream<beat_t>& out, ap_uint<12> count, ap_uint<8> gain,
                   ap_uint<16> offset) {
#pragma HLS INTERFACE axis port = in
#pragma HLS INTERFACE axis port = out
#pragma HLS INTERFACE s_axilite port = count
#pragma HLS INTERFACE s_axilite port = gain
#pragma HLS INTERFACE s_axilite port = offset
#pragma HLS DATAFLOW
  hls::stream<sample_t> samples("samples");
  hls::stream<sample_t> scaled("scaled");
#pragma HLS STREAM variable = samples depth = 8
  load(in, samples, count);
  compute(samples, scaled, count, gain, offset);
  store(scaled, out, count);
}
