// Arithmetic and bit access. Compiled to LLVM IR by check_llvm_contract.cmake, which says what must be found in it.
#include <ap_int.h>

template <int W>
ap_uint<W> everything(ap_uint<W> a, const ap_int<W>& b, int i, int j) {
  ap_uint<W> r = ((a + b) << i) - (b >> j);
  r(i, j) = (a, b).get()(j, i);
  r[j] = a[i] ^ b.xor_reduce();
  r(8, 3) = a(5, 0);
  r.reverse();
  return (r * a) ^ b.countLeadingZeros();
}

extern "C" {
void add_13(const ap_uint<13>& a, const ap_int<13>& b, ap_int<15>& r, ap_int<30>& s) {
  r = a + b;
  s = (a + b) * (a - b);
}
void reversed(const ap_uint<13>& a, ap_uint<13>& r) { r = a(0, 12); }
void at_13(const ap_uint<13>& a, const ap_int<13>& b, int i, int j, ap_uint<13>& r) { r = everything<13>(a, b, i, j); }
void at_64(const ap_uint<64>& a, const ap_int<64>& b, int i, int j, ap_uint<64>& r) { r = everything<64>(a, b, i, j); }
void at_77(const ap_uint<77>& a, const ap_int<77>& b, int i, int j, ap_uint<77>& r) { r = everything<77>(a, b, i, j); }
void at_200(const ap_uint<200>& a, const ap_int<200>& b, int i, int j, ap_uint<200>& r) {
  r = everything<200>(a, b, i, j);
}
}
