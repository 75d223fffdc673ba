#pragma once

namespace epiline::kernels {

/// One value for every lane of a beat and every disparity level.
template <class Value, int Lanes, int Levels>
struct level_array {
  Value at[Lanes][Levels];

  level_array() = default;
  /// Copied element by element, and therefore returned through memory at every size: small structs that may be copied
  /// as bytes are returned in machine registers, where a compiler to hardware could no longer tell their elements.
  level_array(const level_array& other) {
    for (int lane = 0; lane < Lanes; ++lane) {
      for (int d = 0; d < Levels; ++d) at[lane][d] = other.at[lane][d];
    }
  }
  level_array& operator=(const level_array&) = default;
};

}  // namespace epiline::kernels
