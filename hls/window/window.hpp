#pragma once

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
template <class Value, int Lanes, int Length, class Border = previous_row_border>
class row_window {
 public:
  static_assert(Length >= Lanes);

  /// `row_starts`: the beat is the first one of its row.
  void step(const Value (&beat)[Lanes], bool row_starts) {
#pragma HLS INLINE
    for (int i = Length - 1; i >= Lanes; --i) tap[i] = tap[i - Lanes];
    for (int lane = 0; lane < Lanes; ++lane) tap[Lanes - 1 - lane] = beat[lane];
    if (row_starts) {
      for (int i = Lanes; i < Lanes + Border::replicated && i < Length; ++i) tap[i] = beat[0];
    }
  }

  Value tap[Length];
};

}  // namespace epiline::window
