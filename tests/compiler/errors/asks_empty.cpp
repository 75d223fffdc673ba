#include "ap_int.h"
#include "hls_stream.h"

void asks_empty(hls::stream<int>& in, hls::stream<int>& out) {
  while (!in.empty()) out.write(in.read());  // refused: empty\(\)
}
