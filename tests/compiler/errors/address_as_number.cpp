#include "ap_int.h"
#include "hls_stream.h"

void address_as_number(hls::stream<int>& in, hls::stream<int>& out) {
  static int state;
  state += in.read();
  out.write(static_cast<int>(reinterpret_cast<unsigned long>(&state)));  // refused: address
}
