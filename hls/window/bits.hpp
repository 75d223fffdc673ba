#pragma once
// Small compile-time arithmetic on sizes.

namespace epiline::window {

/// Bits of an unsigned value that holds 0 .. largest, at least 1.
constexpr int bits_for(long largest) {
  int bits = 1;
  while ((largest >> bits) != 0) ++bits;
  return bits;
}

/// a / b, rounded up; a >= 0, b > 0.
constexpr int divide_up(int a, int b) { return (a + b - 1) / b; }

constexpr int larger(int a, int b) { return a < b ? b : a; }

}  // namespace epiline::window
