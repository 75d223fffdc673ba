#pragma once
// Reference model of method 1 (local variation, adaptive SAD, cellular automaton): the whole image at once, straight
// from the equations, with no regard for hardware. It shares no code with hls/ and includes nothing from it.

#include <cstdint>

#include "golden/planes.hpp"

namespace epiline::golden {

struct adaptive_ca_parameters {
  int levels = 80;        // disparities 0 .. levels - 1 take part; at least 1
  int t2 = 32;            // 3x3 where the local variation of 2x2 pixels is above 4 * t2
  int t5 = 100;           // else 5x5 where that of 5x5 pixels is above 25 * t5, else 7x7
  bool automaton = true;  // apply the cellular automaton
  int ring = 24;          // cells of 40 that must agree with a claim of the automaton's second rule (R), 1 .. 40
};

/// (R + 2G + B + 2) / 4, rounded down.
[[nodiscard]] plane<std::uint8_t> luma(const colour_image& image);

/// Four times equation (1) of the paper on rows y, y + 1 and columns x, x + 1: sum |4 I - S| over the four pixels, S
/// their sum; the border is replicated. At most 2040.
[[nodiscard]] plane<int> local_variation_2x2(const plane<std::uint8_t>& image);

/// Twenty-five times equation (1) on the centred 5x5 pixels: sum |25 I - S|; the border is replicated. At most 79560.
[[nodiscard]] plane<int> local_variation_5x5(const plane<std::uint8_t>& image);

/// Side of the matching window of every pixel of the left image: 3, 5 or 7.
[[nodiscard]] plane<std::uint8_t> chosen_window(const plane<std::uint8_t>& left, int t2, int t5);

/// Cost of disparity `d` >= 0 for every left pixel: |left - right| against the right pixel d columns to the left
/// (column 0 where that lies outside), summed over the pixel's own window, of which pixels outside the image count 0.
/// At most 2295, 6375 or 12495.
[[nodiscard]] plane<std::uint16_t> adaptive_cost(const plane<std::uint8_t>& left, const plane<std::uint8_t>& right,
                                                 const plane<std::uint8_t>& window, int d);

/// The disparity d <= x of lowest cost for every pixel, the smallest in a tie. All are defined.
[[nodiscard]] disparity_plane adaptive_winners(const colour_image& left, const colour_image& right,
                                               const adaptive_ca_parameters& parameters);

/// The automaton's first rule, on one binary plane for every level, cells outside the image clear:
/// a) no neighbour of 8 set: clear; b) at least 7 of 8 set: set, and clear in the plane that held the pixel before;
/// otherwise as it was. Disparities of `map` must be below `levels`.
[[nodiscard]] disparity_plane automaton_rule_1(const disparity_plane& map, int levels);

/// The automaton's second rule, likewise: c) a cell of the 3x3 set: set; d) fewer than `ring` of the 40 cells of the
/// 7x7 outside the 3x3 set: clear. c) and d) both look at the planes as they come in. A pixel that exactly one plane
/// then claims has that level; one that none or several claim is undefined.
[[nodiscard]] disparity_plane automaton_rule_2(const disparity_plane& map, int levels, int ring);

/// Method 1 whole. The images must agree in size.
[[nodiscard]] disparity_plane adaptive_ca(const colour_image& left, const colour_image& right,
                                          const adaptive_ca_parameters& parameters);

}  // namespace epiline::golden
