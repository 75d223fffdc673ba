#include "ap_int.h"
#include "hls_stream.h"

void nonblocking_write(hls::stream<int>& in, hls::stream<int>& out) {
  const int x = in.read();
  if (!out.write_nb(x)) out.write(0);  // refused: non-blocking
}
