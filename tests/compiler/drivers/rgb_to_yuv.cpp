#include "../drive.hpp"
namespace kernel_rgb_to_yuv {
#include "../kernels/rgb_to_yuv.cpp"
}
using namespace kernel_rgb_to_yuv;

EPILINE_LEAVES(rgb_t, v.r, v.g, v.b);
EPILINE_LEAVES(yuv_t, v.y, v.u, v.v);
EPILINE_DRIVER(rgb_to_yuv) {
  auto& rgb = s.input<rgb_t>("rgb");
  auto& yuv = s.output<yuv_t>("yuv");
  for (const int pixels : {1, 0, 200, 33}) {
    std::vector<int> wanted;
    for (int i = 0; i < pixels; ++i) {
      const rgb_t p = s.any<rgb_t>();
      rgb.push(p);
      const int r = int(p.r), g = int(p.g), b = int(p.b);
      wanted.push_back(std::clamp(((66 * r + 129 * g + 25 * b + 128) >> 8) + 16, 16, 235));
      wanted.push_back(std::clamp(((-38 * r - 74 * g + 112 * b + 128) >> 8) + 128, 16, 240));
      wanted.push_back(std::clamp(((112 * r - 94 * g - 18 * b + 128) >> 8) + 128, 16, 240));
    }
    s.call({{"pixels", static_cast<unsigned short>(pixels)}});
    rgb_to_yuv(rgb.stream, yuv.stream, static_cast<unsigned short>(pixels));
    std::vector<int> found;
    for (const yuv_t& p : yuv.drain()) {
      found.push_back(int(p.y));
      found.push_back(int(p.u));
      found.push_back(int(p.v));
    }
    s.expect_equal(found, wanted, "yuv");
  }
}
