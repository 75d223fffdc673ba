#include "ap_int.h"
#include "hls_stream.h"

void conditional_result(hls::stream<int>& in, int& found) {  // refused: found
  if (in.read() == 7) found = 1;
}
