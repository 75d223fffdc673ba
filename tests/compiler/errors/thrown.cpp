#include "hls_stream.h"

void thrown(hls::stream<int>& in, hls::stream<int>& out) {
  const int x = in.read();
  if (x < 0) throw x;  // refused: exception|throw
  out.write(x);
}
