#include "../drive.hpp"
namespace regression_whole_copies {
#include "../regressions/whole_copies.cpp"
}

EPILINE_DRIVER(whole_copies) {
  auto& in = s.input<ap_uint<8>>("in");
  auto& out = s.output<ap_uint<16>>("out");
  std::vector<unsigned> before(128, 0);
  for (const int count : {3, 0, 31, 17}) {
    std::vector<unsigned> now(128, 0), pattern(200, 0x5a), sum(100, 0), steps(50, 0), wanted;
    for (int i = 0; i < count; ++i) {
      const ap_uint<8> value = s.any<ap_uint<8>>();
      in.push(value);
      const unsigned v = value.to_uint();
      now[v & 127] += v;
      ++pattern[v % 200];
      ++sum[v % 100];
      ++steps[v % 50];
    }
    for (unsigned i = 0; i < 128; ++i)
      wanted.push_back(now[i] + before[127 - i] + pattern[i] + sum[i % 100] + (steps[i % 50] * (i % 3) & 15));
    wanted.push_back(static_cast<unsigned>(count));
    before = now;
    s.call({{"count", ap_uint<5>(count)}});
    regression_whole_copies::whole_copies(in.stream, out.stream, count);
    s.expect_equal(out.drain(), wanted, "out");
  }
}
