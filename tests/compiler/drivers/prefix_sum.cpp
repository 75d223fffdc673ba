#include "../drive.hpp"
namespace kernel_prefix_sum {
#include "../kernels/prefix_sum.cpp"
}
using namespace kernel_prefix_sum;

EPILINE_DRIVER(prefix_sum) {
  auto& in = s.input<in_t>("s");
  auto& out = s.output<out_t>("m");
  std::vector<int> wanted;
  int sum = 0;
  for (int i = 0; i < 250; ++i) {
    in_t beat = s.any<in_t>();
    beat.last = s.chance(10);
    in.push(beat);
    sum += int(ap_int<16>(beat.data));
    wanted.push_back(sum);
    if (beat.last) sum = 0;
    prefix_sum(in.stream, out.stream);
  }
  std::vector<int> found;
  for (const out_t& beat : out.drain()) found.push_back(int(ap_int<32>(beat.data)));
  s.expect_equal(found, wanted, "sums");
}
