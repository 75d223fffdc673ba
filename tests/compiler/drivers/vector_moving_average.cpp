#include <hls_vector.h>

#include <array>

#include "../drive.hpp"
namespace kernel_vector_moving_average {
#include "../kernels/vector_moving_average.cpp"
}
EPILINE_LEAVES(kernel_vector_moving_average::beat_t, v[0], v[1], v[2], v[3]);
using namespace kernel_vector_moving_average;

EPILINE_DRIVER(vector_moving_average) {
  auto& in = s.input<beat_t>("in");
  auto& mean = s.output<beat_t>("mean");
  auto& total = s.output<ap_uint<16>>("total");
  std::vector<std::array<unsigned, 4>> past(3, std::array<unsigned, 4>{});
  std::vector<unsigned> means, totals;
  for (int n = 0; n < 200; ++n) {
    const beat_t beat = s.any<beat_t>();
    in.push(beat);
    past.push_back({beat[0].to_uint(), beat[1].to_uint(), beat[2].to_uint(), beat[3].to_uint()});
    const std::size_t last = past.size() - 1;
    for (std::size_t c = 0; c < 4; ++c) {
      const unsigned sum = past[last][c] + past[last - 1][c] + past[last - 2][c] + past[last - 3][c];
      means.push_back((sum + 2) % 16384 / 4);
    }
    totals.push_back(past[last][0] + past[last][1] + past[last][2] + past[last][3]);
    vector_moving_average(in.stream, mean.stream, total.stream);
  }
  std::vector<unsigned> found;
  for (const beat_t& beat : mean.drain())
    for (const ap_uint<12>& channel : beat) found.push_back(channel.to_uint());
  s.expect_equal(found, means, "mean");
  s.expect_equal(total.drain(), totals, "total");
}
