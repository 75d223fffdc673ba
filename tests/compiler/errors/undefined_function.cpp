#include "hls_stream.h"

int elsewhere(int x);

void undefined_function(hls::stream<int>& in, hls::stream<int>& out) {
  out.write(elsewhere(in.read()));  // refused: elsewhere
}
