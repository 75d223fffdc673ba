#include <iostream>

#include "hls_stream.h"

void printed_stream(hls::stream<int>& in, hls::stream<int>& out) {
  const int x = in.read();
  std::cout << x << std::endl;  // refused: cout
  out.write(x);
}
