#include "ap_int.h"
#include "hls_stream.h"

static unsigned collatz(unsigned n, unsigned steps) {  // refused: recurs
  if (n <= 1) return steps;
  return collatz(n % 2 == 0 ? n / 2 : 3 * n + 1, steps + collatz(n / 2, 0));  // refused: recurs
}

void recursion(hls::stream<ap_uint<32>>& in, hls::stream<ap_uint<32>>& out) {
  out.write(collatz(in.read().to_uint(), 0));  // refused: recurs
}
