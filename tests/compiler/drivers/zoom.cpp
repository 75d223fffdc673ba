#include "../drive.hpp"
namespace kernel_zoom {
#include "../kernels/zoom.cpp"
}
using namespace kernel_zoom;

EPILINE_DRIVER(zoom) {
  auto& in = s.input<pixel_t>("in");
  auto& out = s.output<pixel_t>("out");
  const int sizes[][3] = {{6, 4, 3}, {1, 1, 7}, {63, 2, 1}, {5, 5, 2}, {3, 0, 2}, {3, 3, 0}};
  for (const auto& size : sizes) {
    const int width = size[0], height = size[1], factor = size[2];
    std::vector<unsigned> image, wanted;
    for (int i = 0; i < (factor == 0 ? 0 : width * height); ++i) {
      const pixel_t p = s.any<pixel_t>();
      in.push(p);
      image.push_back(p.to_uint());
    }
    for (int y = 0; y < height * factor; ++y) {
      for (int x = 0; x < width * factor; ++x) wanted.push_back(image[std::size_t(y / factor * width + x / factor)]);
    }
    s.call({{"width", ap_uint<6>(width)}, {"height", ap_uint<6>(height)}, {"factor", ap_uint<3>(factor)}});
    zoom(in.stream, out.stream, width, height, factor);
    s.expect_equal(out.drain(), wanted, "out");
  }
}
