// Functions that call themselves, with numbers of the source: constant expressions, although nothing in the language
// asks for their values at compile time.
#include "ap_int.h"
#include "hls_stream.h"

namespace {

constexpr int log2_of(int number) { return number <= 1 ? 0 : 1 + log2_of(number / 2); }

unsigned fibonacci(unsigned n) { return n < 2 ? n : fibonacci(n - 1) + fibonacci(n - 2); }

const unsigned char steps[4] = {1, 2, 3, 5};
unsigned sum_of_steps(int from) { return from >= 4 ? 0 : steps[from] + sum_of_steps(from + 1); }

}  // namespace

void constant_recursion(hls::stream<ap_uint<16>>& in, hls::stream<ap_uint<24>>& out) {
  ap_uint<8> table[1 << log2_of(33)];
  for (int i = 0; i < 32; ++i) table[i] = ap_uint<8>(fibonacci(9) + i);
  const ap_uint<16> value = in.read();
  out.write((value >> log2_of(100)) + table[value & 31] * sum_of_steps(1));
}
