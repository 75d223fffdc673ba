#pragma once
#include <ap_int.h>

#include "kernels/luma.hpp"
#include "window/bits.hpp"
#include "window/reduce.hpp"
#include "window/window.hpp"

namespace epiline::kernels {

/// How wide a window a pixel is matched with.
enum window_choice : unsigned char { window_3x3, window_5x5, window_7x7 };
using window_choice_t = ap_uint<2>;

/// Chooses every pixel's window from the local variation of the left luma, equation (1) of the paper, LV = sum over the
/// window of |I - mean|, without its division:
///   LV2 = sum |4 I - S| over rows y, y + 1 and columns x, x + 1 (0 .. 2040),
///   LV5 = sum |25 I - S| over the centred 5x5 (0 .. 79560), S = the sum of the window's pixels;
///   LV2 > 4 T2: 3x3, else LV5 > 25 T5: 5x5, else 7x7.
///
/// Lane l of the result belongs to the pixel `DelayColumns` columns left of lane l of the newest beat, in the middle of
/// its rows.
/// Border policy: replicated. Rows and columns outside the frame are replaced as they enter, by the nearest one inside.
/// State: the newest columns: every pixel 25 times (so that one multiplication serves all windows it takes part in) and
/// the columns' sums.
///
/// Config: pixels_per_beat.
template <class Config, int DelayColumns>
class local_variation {
 public:
  static constexpr int lanes = Config::pixels_per_beat;
  static constexpr int rows = 5;
  using lv2_t = ap_uint<window::bits_for(2040)>;
  using lv5_t = ap_uint<window::bits_for(79560)>;
  using t2_t = ap_uint<8>;
  using t5_t = ap_uint<window::bits_for(79560 / 25)>;

  struct place {
    bool row_in[rows];    // the row lies in the frame; the one in the middle is taken to
    bool lane_in[lanes];  // so does the column
    bool row_starts;      // the first beat of a row
  };

  /// `newest[k][lane]`: row k of the newest columns, 0 = the uppermost of the five.
  void step(const luma_t (&newest)[rows][lanes], const place& at) {
#pragma HLS INLINE
    luma_t inside[rows][lanes];
    for (int lane = 0; lane < lanes; ++lane) {
      inside[2][lane] = newest[2][lane];
      inside[1][lane] = at.row_in[1] ? newest[1][lane] : inside[2][lane];
      inside[0][lane] = at.row_in[0] ? newest[0][lane] : inside[1][lane];
      inside[3][lane] = at.row_in[3] ? newest[3][lane] : inside[2][lane];
      inside[4][lane] = at.row_in[4] ? newest[4][lane] : inside[3][lane];
    }
    sum_t sums[lanes];
    for (int row = 0; row < rows; ++row) {
      for (int lane = 0; lane < lanes; ++lane) {
        const luma_t before = lane > 0 ? inside[row][lane - 1] : luma_[row].tap[0];
        inside[row][lane] = at.lane_in[lane] ? inside[row][lane] : before;
      }
      luma_[row].step(inside[row], at.row_starts);
      times25_t scaled[lanes];
      for (int lane = 0; lane < lanes; ++lane) scaled[lane] = inside[row][lane] * 25;
      times25_[row].step(scaled, at.row_starts);
    }
    for (int lane = 0; lane < lanes; ++lane) {
      sums[lane] = inside[0][lane] + inside[1][lane] + inside[2][lane] + inside[3][lane] + inside[4][lane];
    }
    sums_.step(sums, at.row_starts);
  }

  lv2_t lv2(int lane) const {
#pragma HLS INLINE
    const int centre = centre_tap(lane);
    const luma_t pixels[4] = {luma_[2].tap[centre], luma_[2].tap[centre - 1],  //
                              luma_[3].tap[centre], luma_[3].tap[centre - 1]};
    const ap_uint<10> sum = pixels[0] + pixels[1] + pixels[2] + pixels[3];
    lv2_t result = 0;
    for (int i = 0; i < 4; ++i) {
      const ap_int<11> deviation = (ap_uint<10>(pixels[i]) << 2) - sum;
      result = result + (deviation < 0 ? ap_int<11>(-deviation) : deviation);
    }
    return result;
  }

  lv5_t lv5(int lane) const {
#pragma HLS INLINE
    const int first = centre_tap(lane) - 2;
    ap_uint<13> sum = 0;
    for (int k = 0; k < 5; ++k) sum = sum + sums_.tap[first + k];
    ap_uint<17> deviations[25];
    for (int row = 0; row < rows; ++row) {
      for (int k = 0; k < 5; ++k) {
        const ap_int<14> deviation = times25_[row].tap[first + k] - sum;
        deviations[5 * row + k] = deviation < 0 ? ap_int<14>(-deviation) : deviation;
      }
    }
    return window::reduce(deviations, [](lv5_t a, lv5_t b) -> lv5_t { return a + b; });
  }

  window_choice_t choice(int lane, t2_t t2, t5_t t5) const {
#pragma HLS INLINE
    if (lv2(lane) > (ap_uint<10>(t2) << 2)) return window_3x3;
    if (lv5(lane) > t5 * 25) return window_5x5;
    return window_7x7;
  }

 private:
  using times25_t = ap_uint<window::bits_for(25 * 255)>;
  using sum_t = ap_uint<window::bits_for(5 * 255)>;
  static constexpr int centre_tap(int lane) { return DelayColumns + lanes - 1 - lane; }
  static constexpr int taps = centre_tap(0) + 3;
  static_assert(centre_tap(lanes - 1) >= 2, "the window reaches further right than the newest column");
  using border = window::replicated_border<2>;

  window::row_window<luma_t, lanes, taps, border> luma_[rows];
  window::row_window<times25_t, lanes, taps, border> times25_[rows];
  window::row_window<sum_t, lanes, taps, border> sums_;
};

}  // namespace epiline::kernels
