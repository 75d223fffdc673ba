#include "ap_int.h"
#include "hls_stream.h"

union number_t {
  int whole;
  unsigned char bytes[4];
};

void union_payload(hls::stream<number_t>& in, hls::stream<int>& out) {
  const number_t x = in.read();  // refused: union|type
  out.write(x.bytes[0]);         // refused: union|type
}
