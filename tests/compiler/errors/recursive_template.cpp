#include "ap_int.h"
#include "hls_stream.h"

template <class T>
static T power(T base, int n) {  // refused: recursion
  return n == 0 ? T(1) : T(base * power(base, n - 1));
}

void recursive_template(hls::stream<int>& in, hls::stream<int>& out) { out.write(power(in.read(), 5)); }
