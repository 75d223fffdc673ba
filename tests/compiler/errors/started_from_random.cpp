#include <cstdlib>

#include "hls_stream.h"

void started_from_random(hls::stream<int>& in, hls::stream<int>& out) {
  static int noise = std::rand();  // refused: rand
  out.write(in.read() + noise);    // refused: noise|rand
}
