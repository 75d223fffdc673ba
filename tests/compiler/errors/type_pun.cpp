#include "hls_stream.h"

union bits_t {
  unsigned number;
  unsigned char bytes[4];
};

void type_pun(hls::stream<unsigned>& in, hls::stream<unsigned>& out, int which) {
  static bits_t state;
  state.number ^= in.read();          // refused: union|type|overlap|byte
  out.write(state.bytes[which & 3]);  // refused: union|type|overlap|byte
}
