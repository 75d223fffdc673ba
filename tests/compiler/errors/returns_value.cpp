#include "hls_stream.h"

int returns_value(hls::stream<int>& in) {  // refused: return
  return in.read() + 1;                    // refused: return
}
