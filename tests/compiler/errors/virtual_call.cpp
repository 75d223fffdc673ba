#include "ap_int.h"
#include "hls_stream.h"

struct filter {
  virtual int apply(int x) const = 0;
};
struct doubler : filter {
  int apply(int x) const override { return 2 * x; }
};
struct halver : filter {
  int apply(int x) const override { return x / 2; }
};

void virtual_call(hls::stream<int>& in, hls::stream<int>& out, bool which) {
  doubler twice;
  halver half;
  const filter* chosen = which ? static_cast<const filter*>(&twice) : &half;  // refused: virtual|pointer|function
  out.write(chosen->apply(in.read()));                                        // refused: virtual|pointer|function
}
