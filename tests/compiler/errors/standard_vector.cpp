#include <vector>

#include "ap_int.h"
#include "hls_stream.h"

void standard_vector(hls::stream<int>& in, hls::stream<int>& out, int n) {
  std::vector<int> values;                                  // refused: vector|heap|new
  for (int i = 0; i < n; ++i) values.push_back(in.read());  // refused: vector|heap|new
  for (int i = 0; i < n; ++i) out.write(values[n - 1 - i]);
}  // refused: vector|heap|new|delete
