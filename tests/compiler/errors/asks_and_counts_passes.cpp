#include "ap_int.h"
#include "hls_stream.h"

void asks_and_counts_passes(hls::stream<int>& in, hls::stream<int>& out) {
  int idle = 0;
  while (true) {
    if (!in.empty()) {  // refused: results depend on timing since a variable of the loop changes even when the stream
                        // is empty
      out.write(in.read() + idle);
    } else {
      ++idle;
    }
  }
}
