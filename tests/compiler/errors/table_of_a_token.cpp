#include <cmath>

#include "hls_stream.h"

// What is in the table hangs on a token: it cannot be computed before there is one.
void table_of_a_token(hls::stream<int>& in, hls::stream<int>& out) {
  const int scale = in.read();
  int table[16];
  for (int i = 0; i < 16; ++i)
    table[i] = static_cast<int>(std::exp(scale * 0.1 + i));  // refused: 'exp' of a value that is known only at run time
  out.write(table[in.read() & 15]);
}
