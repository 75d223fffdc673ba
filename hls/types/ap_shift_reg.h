#pragma once
// ap_shift_reg<T, N>: N values in a row, with the vendors' names and meaning. Value 0 is the newest.
//
//   T shift(value, address = N - 1, enable = true)   the value at `address` before the shift; then, if enabled, `value`
//                                                    becomes the newest and the oldest one is lost
//   T read(address = N - 1)                          the value at `address`
//
// Up to `most_registers` values are registers: any number of them is read in an iteration. More live in a memory that
// nothing moves in, only the place of the newest one: a long delay costs a block RAM, and every address that an
// iteration reads a copy of it. All values begin as T{}. An address of N or more stops a native run.

#include <cstddef>

#ifndef __SYNTHESIS__
#include <cstdio>
#include <cstdlib>
#endif

template <class T, unsigned N = 32>
class ap_shift_reg {
  static_assert(N > 0, "an ap_shift_reg has at least one value");

 public:
  static constexpr unsigned most_registers = 64;

  constexpr ap_shift_reg() : values_{}, newest_(0) {}
  constexpr explicit ap_shift_reg(const char*) : ap_shift_reg() {}
  ap_shift_reg(const ap_shift_reg&) = delete;
  ap_shift_reg& operator=(const ap_shift_reg&) = delete;

  T shift(T value, unsigned address = N - 1, bool enable = true) {
    const T before = read(address);
    if (enable) push(value);
    return before;
  }

  T read(unsigned address = N - 1) const {
#ifndef __SYNTHESIS__
    if (address >= N) {
      std::fprintf(stderr, "ap_shift_reg: address %u is outside of %u values\n", address, N);
      std::abort();
    }
#endif
    if constexpr (is_memory) {
      const unsigned behind = newest_ + address;
      return values_[behind >= N ? behind - N : behind];
    } else {
      return values_[address];
    }
  }

 private:
  static constexpr bool is_memory = N > most_registers;

  void push(const T& value) {
    if constexpr (is_memory) {
      newest_ = newest_ == 0 ? N - 1 : newest_ - 1;
      values_[newest_] = value;
    } else {
#ifdef __SYNTHESIS__
#pragma HLS ARRAY_PARTITION variable = values_ complete
#endif
      for (unsigned i = N - 1; i > 0; --i) {
#ifdef __SYNTHESIS__
#pragma HLS UNROLL
#endif
        values_[i] = values_[i - 1];
      }
      values_[0] = value;
    }
  }

  T values_[N];
  unsigned newest_;  // of a memory
};
