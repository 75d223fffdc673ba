#include "ap_int.h"
#include "hls_stream.h"

void asks_size(hls::stream<int>& in, hls::stream<int>& out) {
  if (in.size() > 4) out.write(in.read());  // refused: size
}
