#include "../drive.hpp"
namespace kernel_convolution5x5 {
#include "../kernels/convolution5x5.cpp"
}
using namespace kernel_convolution5x5;
EPILINE_LEAVES(weights_t, v.w[0][0], v.w[0][1], v.w[0][2], v.w[0][3], v.w[0][4], v.w[1][0], v.w[1][1], v.w[1][2],
               v.w[1][3], v.w[1][4], v.w[2][0], v.w[2][1], v.w[2][2], v.w[2][3], v.w[2][4], v.w[3][0], v.w[3][1],
               v.w[3][2], v.w[3][3], v.w[3][4], v.w[4][0], v.w[4][1], v.w[4][2], v.w[4][3], v.w[4][4], v.shift);

EPILINE_DRIVER(convolution5x5) {
  auto& src = s.input<video_t>("src");
  auto& dst = s.output<video_t>("dst");
  std::vector<int> wanted;
  const int sizes[][2] = {{16, 10}, {2, 1}, {64, 3}, {6, 7}};
  for (const auto& size : sizes) {
    const int cols = size[0], rows = size[1];
    weights_t weights = s.any<weights_t>();
    weights.shift = s.number(0, 8);
    std::vector<int> image;
    for (int i = 0; i < cols * rows; i += 2) {
      const video_t beat = s.any<video_t>();
      src.push(beat);
      image.push_back(int(beat.data) & 255);
      image.push_back(int(beat.data) >> 8);
    }
    for (int y = 0; y < rows; ++y) {
      for (int x = 0; x < cols; ++x) {
        int sum = weights.shift == 0 ? 0 : 1 << (int(weights.shift) - 1);
        for (int j = 0; j < 5; ++j) {
          for (int i = 0; i < 5; ++i) {
            const int v = y + j - 2, u = x + i - 2;
            if (v >= 0 && v < rows && u >= 0 && u < cols)
              sum += int(weights.w[j][i]) * image[std::size_t(v * cols + u)];
          }
        }
        wanted.push_back(std::clamp(sum >> int(weights.shift), 0, 255));
        if (x % 2 == 1) wanted.push_back((x + 1 == cols) * 2 + (x == 1 && y == 0));
      }
    }
    s.call({{"weights", weights}, {"rows", rows}, {"cols", cols}});
    convolution5x5(src.stream, dst.stream, weights, rows, cols);
  }
  std::vector<int> found;
  for (const video_t& beat : dst.drain()) {
    found.push_back(int(beat.data) & 255);
    found.push_back(int(beat.data) >> 8);
    found.push_back(int(beat.last) * 2 + int(beat.user));
  }
  s.expect_equal(found, wanted, "dst");
}
