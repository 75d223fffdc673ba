#pragma once
#include <ap_int.h>

#include "kernels/level_array.hpp"
#include "window/bits.hpp"
#include "window/delay_line.hpp"

namespace epiline::kernels {

/// Delays the values of a group of levels by `Length` iterations; before the first one come zeros. Long delays take RAM
/// instead of Length * Levels registers. An object must start zeroed (static, or T{}).
template <class Value, int Levels, int Length>
class level_delay {
 public:
  using values = level_array<Value, 1, Levels>;

  /// Takes the newest values, returns those of `Length` steps ago.
  values step(const values& newest) {
#pragma HLS INLINE
    if constexpr (Length == 0) {
      return newest;
    } else if constexpr (!in_ram) {
      values oldest;
      for (int d = 0; d < Levels; ++d) oldest.at[0][d] = registers_[Length - 1][d];
      for (int k = Length - 1; k > 0; --k) {
        for (int d = 0; d < Levels; ++d) registers_[k][d] = registers_[k - 1][d];
      }
      for (int d = 0; d < Levels; ++d) registers_[0][d] = newest.at[0][d];
      return oldest;
    } else {
      // RAM cannot start zeroed: what it holds at power-up is not looked at.
      const bool filled = steps_ == Length;
      if (!filled) steps_ = steps_ + 1;
      values oldest = ram_.step(newest);
      for (int d = 0; d < Levels; ++d) oldest.at[0][d] = filled ? oldest.at[0][d] : Value(0);
      return oldest;
    }
  }

 private:
  /// A RAM of up to 16 words would become registers and multiplexers.
  static constexpr bool in_ram = Length > 16;
  Value registers_[in_ram || Length == 0 ? 1 : Length][Levels];
  window::delay_line<values, in_ram ? Length : 1> ram_;
  ap_uint<window::bits_for(Length)> steps_;
};

}  // namespace epiline::kernels
