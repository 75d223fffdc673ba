#include "ap_int.h"
#include "hls_stream.h"

void number_of_letters(hls::stream<ap_uint<8>>& in, hls::stream<ap_uint<8>>& out) {
  const ap_uint<8> key("2g", 16);  // refused: no number
  out.write(in.read() ^ key);
}
