#include <ctime>

#include "hls_stream.h"

static const int seed = static_cast<int>(std::time(nullptr));

void started_from_a_clock(hls::stream<int>& in, hls::stream<int>& out) {
  out.write(in.read() ^ seed);  // refused: seed
}
