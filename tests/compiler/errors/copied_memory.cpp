#include <cstring>

#include "ap_int.h"
#include "hls_stream.h"

void copied_memory(hls::stream<ap_uint<14>>& in, hls::stream<int>& out) {
  static int now[16384];
  static int before[16384];
  const ap_uint<14> at = in.read();
  if (at == 0) std::memcpy(before, now, sizeof now);  // refused: array.*at once
  now[at] = before[at] + 1;
  out.write(before[at]);
}
