#include "../drive.hpp"
namespace regression_narrow_rows {
#include "../regressions/narrow_rows.cpp"
}

EPILINE_DRIVER(narrow_rows) {
  using regression_narrow_rows::pixel_t;
  auto& in = s.input<pixel_t>("in");
  auto& out = s.output<pixel_t>("out");
  const unsigned short sizes[][2] = {{7, 1}, {6, 2}, {5, 3}, {3, 20}, {9, 4}};
  for (const auto& size : sizes) {
    std::vector<int> image;
    for (int i = 0; i < size[0] * size[1]; ++i) {
      const pixel_t pixel = s.any<pixel_t>();
      in.push(pixel);
      image.push_back(int(pixel.data));
    }
    s.call({{"rows", size[0]}, {"columns", size[1]}});
    regression_narrow_rows::narrow_rows(in.stream, out.stream, size[0], size[1]);
    std::size_t at = 0;
    bool same = true;
    for (const pixel_t& pixel : out.drain()) {
      int sum = 0;
      for (std::size_t i = 0; i < 4 && at >= i * size[1]; ++i) sum += image[at - i * size[1]];
      same = same && pixel.data == sum / 4 && pixel.user == (at == 0) && pixel.last == ((at + 1) % size[1] == 0) &&
             pixel.keep == 0 && pixel.strb == 0 && pixel.id == 0 && pixel.dest == 0;
      ++at;
    }
    s.expect(same && at == image.size(), "pixels");
  }
}
