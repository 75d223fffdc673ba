#include "ap_int.h"
#include "hls_stream.h"

void heap_new(hls::stream<ap_uint<8>>& in, hls::stream<ap_uint<8>>& out, int n) {
  ap_uint<8>* buffer = new ap_uint<8>[n];  // refused: new|heap
  for (int i = 0; i < n; ++i) buffer[i] = in.read();
  for (int i = n - 1; i >= 0; --i) out.write(buffer[i]);
  delete[] buffer;
}
