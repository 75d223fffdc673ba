#include "ap_int.h"
#include "hls_stream.h"

void endless_wait(hls::stream<int>& in, hls::stream<int>& out) {
  const int start = in.read();
  volatile bool never = false;  // refused: volatile
  while (!never) {              // refused: volatile|loop
  }
  out.write(start);
}
