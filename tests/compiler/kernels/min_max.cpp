// Running minimum and maximum of blocks of run-time length, positions too; totals by reference.
// one iteration a token of in
#include "ap_int.h"
#include "hls_stream.h"

typedef ap_int<14> value_t;

struct extreme_t {
  value_t value;
  ap_uint<10> position;
};

void min_max(hls::stream<value_t>& in, hls::stream<extreme_t>& minimum, hls::stream<extreme_t>& maximum,
             ap_uint<10> length, ap_int<24>& total, bool& any_negative) {
#pragma HLS INTERFACE axis port = in
#pragma HLS INTERFACE axis port = minimum
#pragma HLS INTERFACE axis port = maximum
#pragma HLS INTERFACE s_axilite port = length
#pragma HLS INTERFACE s_axilite port = total
#pragma HLS INTERFACE s_axilite port = any_negative
#pragma HLS INTERFACE s_axilite port = return
  extreme_t low = {value_t(8191), 0};
  extreme_t high = {value_t(-8192), 0};
  ap_int<24> sum = 0;
  bool negative = false;
  for (ap_uint<11> i = 0; i < length; i++) {
#pragma HLS PIPELINE
    const value_t v = in.read();
    if (v < low.value) {
      low.value = v;
      low.position = i;
    }
    if (v >= high.value) {
      high.value = v;
      high.position = i;
    }
    sum += v;
    negative |= v.sign();
    minimum.write(low);
    maximum.write(high);
  }
  total = sum;
  any_negative = negative;
}
