// In LLVM's type the array has the very place and shape of the padding that clang would write there.
#include "ap_int.h"
#include "hls_stream.h"

struct header {
  unsigned char kind;
  unsigned char bytes[3];
  int length;
  unsigned char flags;
  ap_uint<17> rest;
};

void bytes_like_padding(hls::stream<header>& in, hls::stream<int>& out) {
  const header h = in.read();  // refused: 'bytes' of struct 'header'.*ap_uint<8>
  out.write(h.length + h.bytes[1]);
}
