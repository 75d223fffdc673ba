#include "hls_stream.h"

void asks_first_of_two(hls::stream<int>& a, hls::stream<int>& b, hls::stream<int>& out) {
  if (!a.empty())  // refused: results depend on timing since line 7 does something even when the stream is empty
    out.write(a.read());
  else if (!b.empty())
    out.write(b.read());
}
