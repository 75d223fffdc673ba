#include "ap_int.h"
#include "hls_stream.h"

void stream_pointer(hls::stream<int>* in, hls::stream<int>& out) {  // refused: 'in'.*pointer
  out.write(in->read());
}
