#include <functional>

#include "hls_stream.h"

void standard_function(hls::stream<int>& in, hls::stream<int>& out) {
  const int bias = in.read();
  const int scale = in.read();
  std::function<int(int)> f = [=](int x) { return x * scale + bias; };  // refused: pointer
  out.write(f(in.read()));                                              // refused: pointer
}
