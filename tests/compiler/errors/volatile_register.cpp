#include "ap_int.h"
#include "hls_stream.h"

void volatile_register(hls::stream<int>& in, hls::stream<int>& out) {
  static volatile int status;  // refused: volatile
  status = in.read();          // refused: volatile
  out.write(status + status);  // refused: volatile
}
