#include "ap_int.h"
#include "hls_stream.h"

void stream_array_parameter(hls::stream<int> in[2], hls::stream<int>& out) {  // refused: 'in'.*array
  out.write(in[0].read() + in[1].read());
}
