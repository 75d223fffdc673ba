#include "ap_int.h"
#include "hls_stream.h"

struct shape {
  virtual int area(int x) const { return x; }
};
struct square : shape {
  int area(int x) const override { return x * x; }
};

void dynamic_cast_used(hls::stream<int>& in, hls::stream<int>& out) {
  static shape plain;
  static square other;
  const int x = in.read();
  const shape* chosen = x > 3 ? &plain : &other;
  out.write(dynamic_cast<const square*>(chosen) != nullptr ? x : 0);  // refused: run time|pointer|cast|defin
}
