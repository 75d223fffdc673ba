#include "ap_int.h"
#include "hls_stream.h"

static unsigned odd(unsigned n);                                                    // refused: recurs
static unsigned even(unsigned n) { return n == 0 ? 1 : odd(n - 1) ^ odd(n / 2); }   // refused: recurs
static unsigned odd(unsigned n) { return n == 0 ? 0 : even(n - 1) + even(n / 3); }  // refused: recurs

void mutual_recursion(hls::stream<ap_uint<32>>& in, hls::stream<ap_uint<32>>& out) {
  out.write(even(in.read().to_uint()));  // refused: recurs
}
