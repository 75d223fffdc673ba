#include "ap_int.h"
#include "hls_stream.h"

void pointer_in_state(hls::stream<ap_uint<4>>& in, hls::stream<int>& out) {
  static int line[16];
  static int* cursor = line;
  *cursor = in.read();
  ++cursor;
  if (cursor == line + 16) cursor = line;  // refused: address of 'line'
  out.write(line[0]);
}
