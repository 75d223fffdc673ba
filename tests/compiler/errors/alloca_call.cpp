#include <alloca.h>

#include "hls_stream.h"

void alloca_call(hls::stream<int>& in, hls::stream<int>& out, int n) {
  int* line = static_cast<int*>(alloca(n * sizeof(int)));  // refused: only at run time
  for (int i = 0; i < n; ++i) line[i] = in.read();
  for (int i = n; i-- > 0;) out.write(line[i]);
}
