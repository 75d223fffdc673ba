#pragma once
#include "window/bits.hpp"

namespace epiline::window {

// Border policies of row_window: what stands left of the first pixel of a row.

/// The last pixels of the row before. For windows whose borders the caller provides as pixels outside between the rows,
/// or where what stands there does not matter.
struct previous_row_border {
  static constexpr int replicated = 0;
};
/// `Pixels` copies of the row's first pixel; further left the row before.
template <int Pixels>
struct replicated_border {
  static constexpr int replicated = Pixels;
};

/// The newest `Length` pixels of a raster in registers, shifted on by a beat of `Lanes` pixels a step. Tap 0 is the
/// last lane of the newest beat, the pixel nearest to the right edge. Read at constant places only.
///
/// With several `Parts` the window is that many times as long, and a beat takes as many steps: step p shows pixels
/// p * Length and following at tap 0 and following. The parts stand in a queue, so that none is chosen by multiplexers.
template <class Value, int Lanes, int Length, class Border = previous_row_border, int Parts = 1>
class row_window {
 public:
  static_assert(Length >= Lanes && (Parts == 1 || Lanes == 1));

  /// `row_starts`: the beat is the first one of its row. `part`: 0 .. Parts - 1; all parts see the same beat.
  void step(const Value (&beat)[Lanes], bool row_starts, int part = 0) {
#pragma HLS INLINE
    constexpr int front = (Parts - 1) * Length;  // this part, a beat ago
    Value entering[Lanes];
    for (int lane = 0; lane < Lanes; ++lane) entering[lane] = part == 0 ? beat[lane] : passed_on_;
    if constexpr (Parts > 1) passed_on_ = tap[front + Length - 1];
    for (int i = Length - 1; i >= Lanes; --i) tap[front + i] = tap[front + i - Lanes];
    for (int lane = 0; lane < Lanes; ++lane) tap[front + Lanes - 1 - lane] = entering[lane];
    for (int p = 0; p < Parts; ++p) {
      if (row_starts && part == p) {
        for (int i = larger(Lanes, p * Length); i < Lanes + Border::replicated && i < (p + 1) * Length; ++i) {
          tap[front + i - p * Length] = beat[0];
        }
      }
    }
    if constexpr (Parts > 1) {
      Value shown[Length];
      for (int i = 0; i < Length; ++i) shown[i] = tap[front + i];
      for (int i = Parts * Length - 1; i >= Length; --i) tap[i] = tap[i - Length];
      for (int i = 0; i < Length; ++i) tap[i] = shown[i];
    }
  }

  Value tap[Parts * Length];

 private:
  Value passed_on_;  // what leaves a part enters the next one
};

}  // namespace epiline::window
