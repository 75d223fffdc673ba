#include <stdio.h>

#include "hls_stream.h"

void printing(hls::stream<int>& in, hls::stream<int>& out) {
  const int x = in.read();
  printf("%d\n", x);  // refused: printf
  out.write(x);
}
