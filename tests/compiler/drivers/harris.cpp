#include "../drive.hpp"
namespace kernel_harris {
#include "../kernels/harris.cpp"
}
using namespace kernel_harris;

EPILINE_DRIVER(harris) {
  auto& image = s.input<pixel_t>("image");
  auto& response = s.output<response_t>("response");
  std::vector<long long> wanted;
  const int sizes[][2] = {{16, 12}, {1, 1}, {64, 5}, {5, 9}};
  for (const auto& size : sizes) {
    const int width = size[0], height = size[1];
    std::vector<int> pixels;
    for (int i = 0; i < width * height; ++i) {
      const bool square = i % width > 6 && i / width > 5;
      pixels.push_back(width == 16    ? (square ? 255 : 0)
                       : s.chance(40) ? int(s.chance(50)) * 255
                                      : int(s.number(0, 255)));
      image.push(pixels.back());
    }
    const auto at = [&](int y, int x) { return pixels[std::size_t(y * width + x)]; };
    // Everything is two rows and columns later than its center: the kernel emits what ends at (y, x).
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        long long xx = 0, yy = 0, xy = 0;
        for (int v = y - 2; v <= y && x >= 4 && y >= 4; ++v) {
          for (int u = x - 2; u <= x; ++u) {
            long long gx = 0, gy = 0;
            for (int k = -1; k <= 1; ++k) {
              gx += (2 - std::abs(k)) * (at(v - 1 + k, u) - at(v - 1 + k, u - 2));
              gy += (2 - std::abs(k)) * (at(v, u - 1 + k) - at(v - 2, u - 1 + k));
            }
            xx += gx * gx;
            yy += gy * gy;
            xy += gx * gy;
          }
        }
        wanted.push_back((xx * yy - xy * xy - ((xx + yy) * (xx + yy) >> 4)) >> 4);
      }
    }
    s.call({{"width", ap_uint<7>(width)}, {"height", ap_uint<7>(height)}});
    harris(image.stream, response.stream, width, height);
  }
  std::vector<long long> found;
  for (const response_t& r : response.drain()) found.push_back(r.to_int64());
  s.expect_equal(found, wanted, "response");
  s.expect(*std::max_element(wanted.begin(), wanted.begin() + 16 * 12) > 0, "the square's corner");
}
