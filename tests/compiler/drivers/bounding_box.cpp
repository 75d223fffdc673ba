#include "../drive.hpp"
namespace kernel_bounding_box {
#include "../kernels/bounding_box.cpp"
}
using namespace kernel_bounding_box;

EPILINE_DRIVER(bounding_box) {
  auto& in = s.input<pixel_in>("in");
  auto& out = s.output<pixel_out>("out");
  const int sizes[][3] = {{16, 9, 250}, {1, 1, 0}, {5, 3, 255}, {30, 4, 100}};
  for (const auto& size : sizes) {
    unsigned short l = 0xffff, t = 0xffff, r = 0, b = 0;
    unsigned n = 0;
    std::vector<bool> wanted;
    for (int y = 0; y < size[1]; ++y) {
      for (int x = 0; x < size[0]; ++x) {
        pixel_in p = s.any<pixel_in>();
        p.last = x + 1 == size[0];
        in.push(p);
        wanted.push_back(int(p.data) > size[2]);
        if (!wanted.back()) continue;
        l = static_cast<unsigned short>(std::min<int>(l, x));
        r = static_cast<unsigned short>(std::max<int>(r, x));
        t = static_cast<unsigned short>(std::min<int>(t, y));
        b = static_cast<unsigned short>(y);
        ++n;
      }
    }
    const auto width = static_cast<unsigned short>(size[0]), height = static_cast<unsigned short>(size[1]);
    const auto level = static_cast<unsigned char>(size[2]);
    s.call({{"width", width}, {"height", height}, {"level", level}});
    unsigned short left = 1, top = 1, right = 1, bottom = 1;
    unsigned area = 1;
    bounding_box(in.stream, out.stream, width, height, level, left, top, right, bottom, area);
    s.result("left", left);
    s.result("top", top);
    s.result("right", right);
    s.result("bottom", bottom);
    s.result("area", area);
    s.expect(left == l && top == t && right == r && bottom == b && area == n, "box");
    std::vector<bool> found;
    for (const pixel_out& p : out.drain()) found.push_back(bool(p.data));
    s.expect(found == wanted, "binary image");
  }
}
