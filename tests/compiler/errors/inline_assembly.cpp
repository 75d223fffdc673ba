#include "hls_stream.h"

void inline_assembly(hls::stream<int>& in, hls::stream<int>& out) {
  int x = in.read();
  asm volatile("nop" : "+r"(x));  // refused: asm|assembl
  out.write(x);
}
