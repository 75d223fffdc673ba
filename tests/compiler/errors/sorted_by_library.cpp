#include <algorithm>

#include "hls_stream.h"

void sorted_by_library(hls::stream<int>& in, hls::stream<int>& out) {
  int values[32];
  for (int i = 0; i < 32; ++i) values[i] = in.read();
  std::sort(values, values + 32);  // refused: recursion|pointer|sort
  for (int i = 0; i < 32; ++i) out.write(values[i]);
}
