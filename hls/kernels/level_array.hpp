#pragma once

namespace epiline::kernels {

/// One value for every lane of a beat and every disparity level.
template <class Value, int Lanes, int Levels>
struct level_array {
  Value at[Lanes][Levels];
};

}  // namespace epiline::kernels
