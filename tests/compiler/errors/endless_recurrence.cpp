#include "ap_int.h"
#include "hls_stream.h"

void endless_recurrence(hls::stream<int>& in, hls::stream<int>& out) {
  int x = in.read();
  while (true) x = x * 3 + 1;  // refused: endless loop
  out.write(x);
}
