#include "hls_stream.h"

void asks_with_a_table(hls::stream<int>& in, hls::stream<int>& out) {
  int counts[256] = {0};
  while (!in.empty()) {  // refused: timing in a loop that ends, counts or keeps something
    out.write(++counts[in.read() & 255]);
  }
}
