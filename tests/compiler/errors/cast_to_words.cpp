#include "ap_int.h"
#include "hls_stream.h"

void cast_to_words(hls::stream<unsigned>& in, hls::stream<unsigned>& out) {
  static unsigned char bytes[64];
  const unsigned x = in.read();
  reinterpret_cast<unsigned*>(bytes)[x & 15] = x;  // refused: type
  out.write(bytes[x & 63]);                        // refused: type
}
