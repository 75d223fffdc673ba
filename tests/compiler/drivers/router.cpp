#include "../drive.hpp"
namespace kernel_router {
#include "../kernels/router.cpp"
}
using namespace kernel_router;

EPILINE_DRIVER(router) {
  auto& in = s.input<beat_t>("in");
  auto& a = s.output<ap_uint<16>>("a");
  auto& b = s.output<ap_uint<16>>("b");
  auto& c = s.output<ap_uint<16>>("c");
  auto& lost = s.output<ap_uint<8>>("lost");
  std::vector<unsigned> wanted[3], wanted_lost;
  unsigned count = 0;
  for (int i = 0; i < 300; ++i) {
    beat_t beat = s.any<beat_t>();
    beat.last = i == 299 || s.chance(10);
    in.push(beat);
    const unsigned to = beat.dest.to_uint();
    if (to < 3)
      wanted[to].push_back(beat.data.to_uint());
    else
      ++count;
    if (beat.last) {
      wanted_lost.push_back(count);
      count = 0;
    }
    router(in.stream, a.stream, b.stream, c.stream, lost.stream);
  }
  s.expect_equal(a.drain(), wanted[0], "a");
  s.expect_equal(b.drain(), wanted[1], "b");
  s.expect_equal(c.drain(), wanted[2], "c");
  s.expect_equal(lost.drain(), wanted_lost, "lost");
}
