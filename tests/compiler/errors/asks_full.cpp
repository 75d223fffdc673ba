#include "ap_int.h"
#include "hls_stream.h"

void asks_full(hls::stream<int>& in, hls::stream<int>& out) {
  const int x = in.read();
  if (!out.full()) out.write(x);  // refused: full\(\)
}
