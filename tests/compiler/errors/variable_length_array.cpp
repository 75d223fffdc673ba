#include "ap_int.h"
#include "hls_stream.h"

void variable_length_array(hls::stream<int>& in, hls::stream<int>& out, int n) {
  int line[n];  // refused: only at run time
  for (int i = 0; i < n; ++i) line[i] = in.read();
  for (int i = n; i-- > 0;) out.write(line[i]);
}
