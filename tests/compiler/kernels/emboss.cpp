// Embosses an image that is a parameter, as others' kernels have them: 128 + strength * (pixel - the one above and left
// of it), clamped, through a tone table; 128 at the upper and left edges. Image and result are accessed in order, so
// they are streams; the table is read anywhere, so it is a memory that is filled before each call.
#include "ap_int.h"

constexpr int rows = 36;
constexpr int columns = 52;
typedef ap_uint<8> gray_t;

void emboss(const gray_t image[rows][columns], gray_t embossed[rows][columns], const gray_t tone[256],
            ap_uint<3> strength) {
#pragma HLS INTERFACE axis port = image
#pragma HLS INTERFACE axis port = embossed
  static gray_t row_above[columns];
  gray_t diagonal = 0;
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
#pragma HLS PIPELINE II = 1
      const gray_t here = image[y][x];
      const gray_t above = row_above[x];
      row_above[x] = here;
      ap_int<13> height = 128;
      if (x > 0 && y > 0) height += strength * (here - diagonal);
      diagonal = above;
      embossed[y][x] = tone[height < 0 ? gray_t(0) : height > 255 ? gray_t(255) : gray_t(height)];
    }
  }
}
