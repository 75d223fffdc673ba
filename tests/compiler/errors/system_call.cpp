#include <cstdlib>

#include "hls_stream.h"

void system_call(hls::stream<int>& in, hls::stream<int>& out) {
  std::system("rm -rf /tmp/never");  // refused: system
  out.write(in.read());
}
