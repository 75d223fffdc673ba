#include "ap_int.h"
#include "hls_stream.h"

#define FAST _Pragma("HLS PIPELINE II=none")

void pragma_inside_macro(hls::stream<int>& in, hls::stream<int>& out, int n) {
  for (int i = 0; i < n; ++i) {
    FAST  // refused: 'none'
        out.write(in.read());
  }
}
