#include "ap_int.h"
#include "hls_stream.h"

static int turned(int x) {
  int y;
  asm("bswap %0" : "=r"(y) : "0"(x));  // refused: assembly
  return y;
}

void assembly_in_function(hls::stream<int>& in, hls::stream<int>& out) { out.write(turned(in.read())); }
