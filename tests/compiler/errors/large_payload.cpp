#include "ap_int.h"
#include "hls_stream.h"

struct image_t {
  int pixel[4096];
};

void large_payload(hls::stream<image_t>& in, hls::stream<int>& out) {
  out.write(in.read().pixel[7]);  // refused: bits
}
