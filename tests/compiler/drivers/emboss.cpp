#include <algorithm>

#include "../drive.hpp"
namespace kernel_emboss {
#include "../kernels/emboss.cpp"
}
using namespace kernel_emboss;

EPILINE_DRIVER(emboss) {
  auto& image_port = s.input<gray_t>("image");
  auto& embossed_port = s.output<gray_t>("embossed");
  auto& tone_port = s.input<gray_t>("tone");
  for (const int strength : {1, 7, 0}) {
    gray_t image[rows][columns], embossed[rows][columns], tone[256];
    for (auto& row : image)
      for (gray_t& pixel : row) image_port.push(pixel = s.any<gray_t>());
    for (int i = 0; i < 256; ++i) tone_port.push(tone[i] = gray_t(255 - i * i / 255));
    while (!image_port.stream.empty()) image_port.stream.read();  // they are in the arrays
    while (!tone_port.stream.empty()) tone_port.stream.read();
    s.call({{"strength", ap_uint<3>(strength)}});
    emboss(image, embossed, tone, strength);

    std::vector<gray_t> wanted;
    for (int y = 0; y < rows; ++y)
      for (int x = 0; x < columns; ++x) {
        const int slope = y == 0 || x == 0 ? 0 : image[y][x].to_int() - image[y - 1][x - 1].to_int();
        const int height = std::clamp(128 + strength * slope, 0, 255);
        wanted.push_back(gray_t(255 - height * height / 255));
        embossed_port.stream.write(embossed[y][x]);
      }
    s.expect_equal(embossed_port.drain(), wanted, "embossed");
  }
}
