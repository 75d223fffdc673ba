#include "hls_stream.h"
#include "hls_vector.h"

void vector_of_floating_point(hls::stream<hls::vector<float, 4>>& in, hls::stream<hls::vector<float, 4>>& out) {
  out.write(in.read());  // refused: floating point
}
