#include <cstring>

#include "ap_int.h"
#include "hls_stream.h"

void memory_by_size(hls::stream<ap_uint<5>>& in, hls::stream<int>& out) {
  static unsigned char line[64];
  static unsigned char last[64];
  const ap_uint<5> length = in.read();
  std::memcpy(last, line, length);  // refused: run-time number
  line[length] = last[0] + 1;
  out.write(line[3]);
}
