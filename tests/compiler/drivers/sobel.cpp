#include "../drive.hpp"
namespace kernel_sobel {
#include "../kernels/sobel.cpp"
}
using namespace kernel_sobel;

EPILINE_DRIVER(sobel) {
  auto& src = s.input<video_t>("src");
  auto& dst = s.output<video_t>("dst");
  const int sizes[][2] = {{20, 10}, {3, 3}, {1, 1}, {128, 2}, {7, 5}};
  std::vector<int> wanted;
  for (const auto& size : sizes) {
    const int cols = size[0], rows = size[1];
    std::vector<int> image;
    for (int i = 0; i < cols * rows; ++i) {
      video_t beat = s.any<video_t>();
      image.push_back(int(beat.data));
      src.push(beat);
    }
    const auto at = [&](int y, int x) { return image[std::size_t(y * cols + x)]; };
    for (int y = 0; y < rows; ++y) {
      for (int x = 0; x < cols; ++x) {
        if (y == 0 || y == rows - 1 || x == 0 || x == cols - 1) {
          wanted.push_back(0);
          continue;
        }
        int gx = 0, gy = 0;
        for (int k = -1; k <= 1; ++k) {
          gx += (2 - std::abs(k)) * (at(y + k, x + 1) - at(y + k, x - 1));
          gy += (2 - std::abs(k)) * (at(y + 1, x + k) - at(y - 1, x + k));
        }
        wanted.push_back(std::min(255, std::abs(gx) + std::abs(gy)));
      }
    }
    s.call({{"rows", rows}, {"cols", cols}});
    sobel(src.stream, dst.stream, rows, cols);
  }
  std::vector<int> found;
  for (const video_t& beat : dst.drain()) found.push_back(int(beat.data));
  s.expect_equal(found, wanted, "dst");
}
