#include "ap_int.h"
#include "hls_stream.h"

void pointer_parameter(hls::stream<int>& in, int* values) {  // refused: values
  for (int i = 0; i < 16; ++i) values[i] = in.read();        // refused: values
}
