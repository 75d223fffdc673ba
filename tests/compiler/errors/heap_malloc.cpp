#include <stdlib.h>

#include "ap_int.h"
#include "hls_stream.h"

void heap_malloc(hls::stream<int>& in, hls::stream<int>& out, int n) {
  int* buffer = static_cast<int*>(malloc(sizeof(int) * n));  // refused: malloc|heap
  for (int i = 0; i < n; ++i) buffer[i] = in.read();
  for (int i = 0; i < n; ++i) out.write(buffer[n - 1 - i]);
  free(buffer);
}
