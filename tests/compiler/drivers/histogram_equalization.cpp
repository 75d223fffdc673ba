#include <map>

#include "../drive.hpp"
namespace kernel_histogram_equalization {
#include "../kernels/histogram_equalization.cpp"
}
using namespace kernel_histogram_equalization;

EPILINE_DRIVER(histogram_equalization) {
  auto& in = s.input<video_t>("in");
  auto& out = s.output<video_t>("out");
  std::vector<int> wanted;
  for (int frame = 0; frame < 4; ++frame) {
    std::vector<int> values;
    for (int i = 0; i < FRAME_SIZE; ++i) {
      video_t beat = s.any<video_t>();
      if (frame == 1) beat.data = 77;                  // one value only
      if (frame == 2) beat.data = s.number(100, 120);  // little contrast
      if (frame == 3) beat.data = i < 3 ? 0 : i % 2 ? 255 : 254;
      values.push_back(int(beat.data) / 4);
      in.push(beat);
    }
    std::map<int, int> at_most;  // value: how many are not larger
    for (const int v : values)
      at_most[v] = int(std::count_if(values.begin(), values.end(), [&](int w) { return w <= v; }));
    const int smallest = at_most.begin()->second;
    const int range = std::max(1, FRAME_SIZE - smallest);
    for (int i = 0; i < FRAME_SIZE; ++i) {
      const int mapped = ((at_most[values[std::size_t(i)]] - smallest) * 63 + range / 2) / range;
      wanted.push_back((mapped * 4 + mapped / 16) * 4 + (i % FRAME_WIDTH == FRAME_WIDTH - 1) * 2 + (i == 0));
    }
    histogram_equalization(in.stream, out.stream);
  }
  std::vector<int> found;
  for (const video_t& beat : out.drain()) found.push_back(int(beat.data) * 4 + int(beat.last) * 2 + int(beat.user));
  s.expect_equal(found, wanted, "out");
}
