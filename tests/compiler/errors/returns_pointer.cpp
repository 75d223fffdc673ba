#include "hls_stream.h"

const int* returns_pointer(hls::stream<int>& in) {  // refused: returns a pointer or reference
  static int last;
  last = in.read();
  return &last;
}
