#include <cmath>

#include "../drive.hpp"
namespace kernel_alpha_blend {
#include "../kernels/alpha_blend.cpp"
}
using namespace kernel_alpha_blend;
EPILINE_LEAVES(rectangle_t, v.left, v.top, v.width, v.height);

EPILINE_DRIVER(alpha_blend) {
  auto& video = s.input<video_t>("video");
  auto& overlay = s.input<overlay_t>("overlay");
  auto& out = s.output<video_t>("out");
  std::vector<int> wanted;
  // Inside, at the corner, beyond the right end, empty, all of it.
  const int places[][4] = {{3, 2, 5, 4}, {0, 0, 1, 1}, {14, 8, 5, 5}, {4, 4, 0, 3}, {0, 0, 16, 9}};
  for (const auto& place : places) {
    const int cols = 16, rows = 9;
    for (int y = 0; y < rows; ++y) {
      for (int x = 0; x < cols; ++x) {
        const video_t v = s.any<video_t>();
        video.push(v);
        int value = int(v.data);
        const int dx = x - place[0], dy = y - place[1];
        if (dx >= 0 && dx < place[2] && dy >= 0 && dy < place[3]) {
          const overlay_t o = s.any<overlay_t>();
          overlay.push(o);
          const int alpha = int(o.data >> 24);
          value = 0;
          for (int c = 0; c < 24; c += 8) {
            const int below = int(v.data >> c) & 255, above = int(o.data >> c) & 255;
            // The nearest integer: a half does not occur, since 255 is odd.
            value |= int(std::lround((above * alpha + below * (255 - alpha)) / 255.0)) << c;
          }
        }
        wanted.push_back(value * 4 + int(v.last) * 2 + int(v.user));
      }
    }
    rectangle_t where;
    where.left = place[0];
    where.top = place[1];
    where.width = place[2];
    where.height = place[3];
    s.call({{"cols", ap_uint<12>(cols)}, {"rows", ap_uint<12>(rows)}, {"where", where}});
    alpha_blend(video.stream, overlay.stream, out.stream, cols, rows, where);
  }
  std::vector<int> found;
  for (const video_t& v : out.drain()) found.push_back(int(v.data) * 4 + int(v.last) * 2 + int(v.user));
  s.expect_equal(found, wanted, "out");
}
