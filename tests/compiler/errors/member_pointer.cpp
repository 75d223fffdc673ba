#include "ap_int.h"
#include "hls_stream.h"

struct filter_t {
  int twice(int x) { return 2 * x; }
  int thrice(int x) { return 3 * x; }
};

void member_pointer(hls::stream<int>& in, hls::stream<int>& out) {
  filter_t filter;
  const int x = in.read();
  int (filter_t::*f)(int) = x > 3 ? &filter_t::twice : &filter_t::thrice;
  out.write((filter.*f)(x));  // refused: pointer
}
