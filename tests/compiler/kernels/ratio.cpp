// Averages of groups and fixed-point ratios: divisions by variables, signed and unsigned, and products of C integers.
// epiline-hls: --clock 6ns
// one iteration a token of in
#include "ap_int.h"
#include "hls_stream.h"

struct sample_t {
  int sum;
  short count;
  ap_uint<24> part;
  ap_uint<20> whole;
};

struct ratio_t {
  int mean;
  short rest;
  ap_uint<24> share;  // floor(part / whole)
  ap_uint<20> left_over;
  long long product;
  unsigned int low_product;
};

void ratio(hls::stream<sample_t>& in, hls::stream<ratio_t>& out) {
#pragma HLS INTERFACE axis port = in
#pragma HLS INTERFACE axis port = out
#pragma HLS PIPELINE II = 1
  const sample_t s = in.read();
  ratio_t r;
  r.mean = s.sum / s.count;
  r.rest = static_cast<short>(s.sum % s.count);
  r.share = s.part / s.whole;
  r.left_over = s.part % s.whole;
  r.product = static_cast<long long>(s.sum) * (static_cast<long long>(s.sum) - s.count);
  r.low_product =
      static_cast<unsigned int>(s.sum) * 2654435761u + static_cast<unsigned int>(s.count) * s.part.to_uint();
  out.write(r);
}
