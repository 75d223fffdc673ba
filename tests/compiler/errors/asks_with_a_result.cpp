#include "hls_stream.h"

int asks_with_a_result(hls::stream<int>& in) {
  if (in.empty()) return -1;  // refused: results depend on timing since line
  return in.read();
}
