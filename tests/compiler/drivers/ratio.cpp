#include "../drive.hpp"
namespace kernel_ratio {
#include "../kernels/ratio.cpp"
}
using namespace kernel_ratio;

EPILINE_LEAVES(sample_t, v.sum, v.count, v.part, v.whole);
EPILINE_LEAVES(ratio_t, v.mean, v.rest, v.share, v.left_over, v.product, v.low_product);
EPILINE_DRIVER(ratio) {
  auto& in = s.input<sample_t>("in");
  auto& out = s.output<ratio_t>("out");
  for (int i = 0; i < 300; ++i) {
    sample_t x;
    // Numbers of every size, so that quotients of every size appear.
    x.sum = int(s.any<ap_int<32>>()) >> (i % 31);
    x.count = short(int(s.any<ap_int<16>>()) >> (i % 15));
    x.part = ap_uint<24>(s.any<ap_uint<24>>() >> (i % 23));
    x.whole = ap_uint<20>(s.any<ap_uint<20>>() >> (i % 19));
    if (x.count == 0) x.count = 1;
    if (x.whole == 0) x.whole = 3;
    in.push(x);
    ratio(in.stream, out.stream);
    const auto results = out.drain();
    s.expect(results.size() == 1, "one result a sample");
    const ratio_t& r = results.front();
    s.expect(std::int64_t{r.mean} * x.count + r.rest == x.sum, "mean and rest make the sum");
    s.expect(r.share.to_uint64() * x.whole.to_uint64() + r.left_over.to_uint64() == x.part.to_uint64() &&
                 r.left_over < x.whole,
             "share and what is left over make the part");
  }
}
