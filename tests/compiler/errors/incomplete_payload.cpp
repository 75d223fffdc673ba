#include "ap_int.h"
#include "hls_stream.h"

struct no_such;

void incomplete_payload(hls::stream<no_such>& in, hls::stream<int>& out) {
  out.write(in.read().x);  // refused: no_such|incomplete
}
