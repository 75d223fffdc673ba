#include "ap_int.h"
#include "hls_stream.h"

void array_reference_parameter(int (&in)[64], hls::stream<int>& out) {  // refused: 'in'.*array
  for (int i = 0; i < 64; ++i) out.write(in[i]);
}
