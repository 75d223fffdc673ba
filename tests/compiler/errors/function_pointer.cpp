#include "ap_int.h"
#include "hls_stream.h"

static int plus_one(int x) { return x + 1; }
static int times_three(int x) { return x * 3; }

void function_pointer(hls::stream<int>& in, hls::stream<int>& out, int which) {
  int (*const table[2])(int) = {plus_one, times_three};
  out.write(table[which & 1](in.read()));  // refused: function|pointer|indirect
}
