#include "../drive.hpp"
namespace kernel_bayer_demosaic {
#include "../kernels/bayer_demosaic.cpp"
}
using namespace kernel_bayer_demosaic;

// For each colour the mean of the nearest sites of that colour, found by looking at their positions.
EPILINE_DRIVER(bayer_demosaic) {
  auto& raw = s.input<raw_t>("raw");
  auto& rgb = s.output<rgb_t>("rgb");
  std::vector<long long> wanted;
  const int sizes[][2] = {{12, 8}, {2, 2}, {64, 4}, {6, 2}};
  for (const auto& size : sizes) {
    const int width = size[0], height = size[1];
    std::vector<int> image;
    for (int i = 0; i < width * height; ++i) {
      const raw_t beat = s.any<raw_t>();
      raw.push(beat);
      image.push_back(int(beat.data));
    }
    const auto reflected = [](int i, int n) { return i < 0 ? -i : i >= n ? 2 * n - 2 - i : i; };
    const auto color_at = [](int y, int x) { return (y & 1) + (x & 1); };  // 0 red, 1 green, 2 blue
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        long long value[3];
        for (int color = 0; color < 3; ++color) {
          int sum = 0, count = 0;
          if (color_at(y, x) == color) {
            sum = image[std::size_t(y * width + x)];
            count = 1;
          } else {
            for (int j = -1; j <= 1; ++j) {
              for (int i = -1; i <= 1; ++i) {
                if (color_at(y + j, x + i) != color) continue;
                sum += image[std::size_t(reflected(y + j, height) * width + reflected(x + i, width))];
                ++count;
              }
            }
          }
          value[color] = (sum + count / 2) / count;
        }
        wanted.push_back((value[2] << 20 | value[1] << 10 | value[0]) << 2 | (x + 1 == width) << 1 |
                         (x == 0 && y == 0));
      }
    }
    s.call({{"width", ap_uint<7>(width)}, {"height", ap_uint<7>(height)}});
    bayer_demosaic(raw.stream, rgb.stream, width, height);
  }
  std::vector<long long> found;
  for (const rgb_t& beat : rgb.drain())
    found.push_back((long long)(beat.data) << 2 | int(beat.last) << 1 | int(beat.user));
  s.expect_equal(found, wanted, "rgb");
}
