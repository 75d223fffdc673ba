#pragma once
// Reference model of method 2 (colour SAD 7x7, confidence, fuzzy inference): the whole image at once, straight from the
// equations, with no regard for hardware. It shares no code with hls/ and includes nothing from it.

#include <cstdint>

#include "golden/planes.hpp"

namespace epiline::golden {

struct color_fuzzy_parameters {
  int levels = 80;            // disparities 0 .. levels - 1 take part; at least 1
  bool left_right = true;     // keep a pixel only if the right image's winner agrees within 1
  int uniqueness = 17;        // keep it only if 16 * second minimum >= uniqueness * minimum; 0: no such check
  int fuzzy = 2;              // passes of the fuzzy filter
  bool careful_fill = false;  // fill an undefined pixel only between two defined ones that agree
};

/// Cost of disparity `d` >= 0 for every left pixel: |dR| + |dG| + |dB| against the right pixel d columns to the left
/// (column 0 where that lies outside), summed over 7x7 pixels of which those outside the image count 0. At most 37485.
[[nodiscard]] plane<std::uint16_t> aggregated_cost(const colour_image& left, const colour_image& right, int d);

/// Winner and confidence, before the fuzzy filter.
[[nodiscard]] disparity_plane confident_winners(const colour_image& left, const colour_image& right,
                                                const color_fuzzy_parameters& parameters);

/// A disparity or none, as an operand of the fuzzy inference.
struct operand {
  int disparity = 0;
  bool defined = false;
  [[nodiscard]] bool operator==(const operand&) const = default;
};

/// The inference of one pixel from itself and its neighbours three columns to the left and right.
[[nodiscard]] operand infer(operand centre, operand left, operand right, bool careful_fill);

/// One pass over a map; neighbours outside the image are undefined.
[[nodiscard]] disparity_plane fuzzy_filter(const disparity_plane& input, bool careful_fill);

/// Method 2 whole. The images must agree in size.
[[nodiscard]] disparity_plane color_fuzzy(const colour_image& left, const colour_image& right,
                                          const color_fuzzy_parameters& parameters);

}  // namespace epiline::golden
