// Bytes that end where a member of LLVM's alignment begins are members: they were taken for padding before `value`,
// which needs none in C++, and left out of the token.
#include "ap_int.h"
#include "hls_stream.h"

struct record_t {
  unsigned char kind;
  unsigned char bytes[3];
  ap_uint<17> value;
  unsigned char more[7];
  ap_uint<63> wide;
  unsigned char last;
};

void bytes_between(hls::stream<record_t>& in, hls::stream<record_t>& out) {
  record_t r = in.read();
  r.bytes[1] = r.bytes[0] ^ r.bytes[2];
  r.value += r.last;
  out.write(r);
}
