#include <queue>

#include "hls_stream.h"

void standard_queue(hls::stream<int>& in, hls::stream<int>& out) {
  static std::queue<int> waiting;  // refused: heap
  waiting.push(in.read());
  out.write(waiting.front());
}
