// Long arrays as parameters: streams of their elements. Those that are accessed in order take no memory, those that are
// not are read before the call and given after it, and what a call does not write stays.
#include <ap_int.h>

constexpr int rows = 6;
constexpr int columns = 16;
typedef ap_uint<24> pixel_t;

struct point_t {
  short x;
  ap_int<9> y;
};

void arrays_of_data(pixel_t image[rows][columns], const int table[64], unsigned char bright[rows * columns],
                    point_t points[48], int sums[columns][4], const short pairs[2 * 30], short differences[30],
                    ap_uint<6> first) {
#pragma HLS INTERFACE axis port = image
#pragma HLS INTERFACE axis port = bright, pairs, differences
#pragma HLS INTERFACE mode = ap_fifo port = points
  int count = 0;
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {
#pragma HLS PIPELINE II = 1
      const pixel_t pixel = image[y][x];
      bright[count++] = table[pixel.range(5, 0)] + pixel.range(15, 8).to_int();
    }
  for (int i = 0; i < 30; ++i) differences[i] = pairs[2 * i + 1] - pairs[2 * i];
  for (int i = 47; i >= 0; --i) {
    points[i].x = i * first;
    if (i < first) points[i].y = table[i];
  }
  for (int x = 0; x < columns; ++x) {
    for (int k = 0; k < 4; ++k) {
      sums[x][k] = 0;
      for (int i = 0; i < 4; ++i) sums[x][k] += table[4 * i + k] ^ x;
    }
  }
}
