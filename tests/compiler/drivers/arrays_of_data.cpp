#include "../drive.hpp"
namespace regression_arrays_of_data {
#include "../regressions/arrays_of_data.cpp"
}  // namespace regression_arrays_of_data
using namespace regression_arrays_of_data;
EPILINE_LEAVES(point_t, v.x, v.y);

EPILINE_DRIVER(arrays_of_data) {
  auto& image_port = s.input<pixel_t>("image");
  auto& table_port = s.input<int>("table");
  auto& bright_port = s.output<unsigned char>("bright");
  auto& points_port = s.output<point_t>("points");
  auto& sums_port = s.output<int>("sums");
  auto& pairs_port = s.input<short>("pairs");
  auto& differences_port = s.output<short>("differences");
  point_t points[48] = {};
  point_t wanted[48] = {};
  for (const int first : {20, 0, 63, 1}) {
    pixel_t image[rows][columns];
    int table[64], sums[columns][4];
    unsigned char bright[rows * columns];
    short pairs[60], differences[30];
    for (auto& row : image)
      for (pixel_t& pixel : row) image_port.push(pixel = s.any<pixel_t>());
    for (int& value : table) table_port.push(value = int(s.number(-1000000, 1000000)));
    for (short& value : pairs) pairs_port.push(value = s.any<short>());
    while (!pairs_port.stream.empty()) pairs_port.stream.read();
    while (!image_port.stream.empty()) image_port.stream.read();  // they are in the arrays
    while (!table_port.stream.empty()) table_port.stream.read();
    s.call({{"first", ap_uint<6>(first)}});
    arrays_of_data(image, table, bright, points, sums, pairs, differences, first);

    for (int i = 0; i < rows * columns; ++i) {
      const unsigned pixel = image[i / columns][i % columns].to_uint();
      s.expect(bright[i] == static_cast<unsigned char>(table[pixel % 64] + int(pixel / 256 % 256)), "bright");
      bright_port.stream.write(bright[i]);
    }
    for (int i = 0; i < 48; ++i) {
      wanted[i].x = static_cast<short>(i * first);
      if (i < first) wanted[i].y = table[i];
      s.expect(points[i].x == wanted[i].x && points[i].y == wanted[i].y, "points");
      points_port.stream.write(points[i]);
    }
    for (int i = 0; i < columns * 4; ++i) {
      int sum = 0;
      for (int k = 0; k < 16; k += 4) sum += table[k + i % 4] ^ (i / 4);
      s.expect(sums[i / 4][i % 4] == sum, "sums");
      sums_port.stream.write(sum);
    }
    for (int i = 0; i < 30; ++i) {
      s.expect(differences[i] == static_cast<short>(pairs[2 * i + 1] - pairs[2 * i]), "differences");
      differences_port.stream.write(differences[i]);
    }
    differences_port.drain();
    bright_port.drain();
    points_port.drain();
    sums_port.drain();
  }
}
