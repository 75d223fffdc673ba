#include "../drive.hpp"
namespace kernel_arbiter {
#include "../kernels/arbiter.cpp"
}
using namespace kernel_arbiter;

EPILINE_DRIVER(arbiter) {
  auto& order = s.input<ap_uint<2>>("order");
  auto& first = s.input<word_t>("first");
  auto& second = s.input<word_t>("second");
  auto& merged = s.output<word_t>("merged");
  std::vector<unsigned> wanted;
  for (int packet = 0; packet < 60; ++packet) {
    const int which = int(s.number(0, 3));
    order.push(which);
    const int beats = which < 2 ? int(s.number(1, 9)) : 1;
    for (int i = 0; i < beats; ++i) {
      word_t w = s.any<word_t>();
      w.last = i + 1 == beats;
      if (which == 0 || which == 2) first.push(w);
      if (which == 1) second.push(w);
      if (which < 2) wanted.push_back(w.data.to_uint());
      if (which == 3) wanted.push_back(0xDEADBEEF);
    }
    arbiter(order.stream, first.stream, second.stream, merged.stream);
  }
  std::vector<unsigned> found;
  for (const word_t& w : merged.drain()) found.push_back(w.data.to_uint());
  s.expect_equal(found, wanted, "merged");
}
