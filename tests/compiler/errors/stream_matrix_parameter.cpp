#include "ap_int.h"
#include "hls_stream.h"

void stream_matrix_parameter(hls::stream<int> in[2][2], hls::stream<int>& out) {  // refused: 'in'.*array of one dim
  out.write(in[0][1].read() + in[1][0].read());
}
