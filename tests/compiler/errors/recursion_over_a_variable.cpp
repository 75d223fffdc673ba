#include "hls_stream.h"

static unsigned limit = 3;
static unsigned count(unsigned n) { return n >= limit ? 0 : 1 + count(n + 1); }  // refused: recursion in 'count

// The argument is a number, but what comes out depends on a variable.
void recursion_over_a_variable(hls::stream<unsigned>& in, hls::stream<unsigned>& out) {
  out.write(in.read() + count(1));
  ++limit;
}
