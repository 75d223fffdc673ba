#include "hls_stream.h"

void two_directions(hls::stream<int>& both, hls::stream<int>& out) {  // refused: both
  const int x = both.read();                                          // refused: both
  both.write(x + 1);                                                  // refused: both
  out.write(x);
}
