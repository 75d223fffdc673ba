#include "../drive.hpp"
namespace kernel_priority {
#include "../kernels/priority_encoder.cpp"
}
using namespace kernel_priority;

EPILINE_LEAVES(summary_t, v.leading, v.ones, v.parity, v.low_zeros);
EPILINE_DRIVER(priority_encoder) {
  auto& word = s.input<ap_uint<16>>("word");
  auto& summary = s.output<summary_t>("summary");
  for (int i = 0; i < 200; ++i) {
    const unsigned w = i < 16 ? 1u << i : s.any<ap_uint<16>>().to_uint();
    word.push(w);
    priority_encoder(word.stream, summary.stream);
    const summary_t found = summary.drain().at(0);
    s.expect(found.leading == (w == 0 ? 16 : 31 - __builtin_clz(w)), "leading one");
    s.expect(found.ones == __builtin_popcount(w) && found.parity == __builtin_parity(w), "count");
    s.expect(found.low_zeros == (w == 0 ? 15 : std::min(15, __builtin_ctz(w))), "trailing zeros");
  }
}
