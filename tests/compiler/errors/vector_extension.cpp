#include "ap_int.h"
#include "hls_stream.h"

typedef int four_t __attribute__((vector_size(16)));

void vector_extension(hls::stream<int>& in, hls::stream<int>& out) {
  static four_t sum;
  const int x = in.read();
  const four_t step = {x, x + 1, x + 2, x + 3};  // refused: vector type
  sum += step;
  out.write(sum[0] + sum[1] + sum[2] + sum[3]);
}
