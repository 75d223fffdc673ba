#include "hls_stream.h"

void asks_empty(hls::stream<int>& in, hls::stream<int>& out) {
  int number = 0;
  while (!in.empty()) out.write(in.read() + number++);  // refused: empty\(\)
}
