#include "ap_int.h"
#include "hls_stream.h"

void heap_new_array(hls::stream<int>& in, hls::stream<int>& out) {
  int* line = new int[64];  // refused: heap
  for (int i = 0; i < 64; ++i) line[i] = in.read();
  for (int i = 0; i < 64; ++i) out.write(line[63 - i]);
  delete[] line;
}
