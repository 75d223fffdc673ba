#include "../drive.hpp"
namespace kernel_median {
#include "../kernels/median.cpp"
}
using namespace kernel_median;

EPILINE_DRIVER(median) {
  auto& in = s.input<pixel_t>("in");
  auto& out = s.output<pixel_t>("out");
  const int sizes[][2] = {{16, 12}, {1, 1}, {64, 3}, {2, 9}, {5, 1}, {1, 7}};
  std::vector<int> wanted;
  for (const auto& size : sizes) {
    const int width = size[0], height = size[1];
    std::vector<int> image;
    for (int i = 0; i < width * height; ++i) {
      image.push_back(int(s.number(0, 255)));
      in.push(image.back());
    }
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        std::vector<int> around;
        for (int j = -1; j <= 1; ++j) {
          for (int i = -1; i <= 1; ++i) {
            around.push_back(
                image[std::size_t(std::clamp(y + j, 0, height - 1) * width + std::clamp(x + i, 0, width - 1))]);
          }
        }
        std::sort(around.begin(), around.end());
        wanted.push_back(around[4]);
      }
    }
    s.call({{"width", ap_uint<7>(width)}, {"height", ap_uint<7>(height)}});
    median(in.stream, out.stream, width, height);
  }
  s.expect_equal(out.drain(), wanted, "out");
}
