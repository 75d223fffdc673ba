#include "hls_stream.h"

void asks_with_a_scalar(hls::stream<int>& in, hls::stream<int>& out, int gain) {
  while (!in.empty()) out.write(in.read() * gain);  // refused: timing in a loop that ends, counts or keeps something
}
