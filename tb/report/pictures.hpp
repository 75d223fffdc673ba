#pragma once
// The pictures of the report, as data URIs.

#include <array>
#include <string>
#include <string_view>

#include "eval/indexed_png.hpp"
#include "eval/metrics.hpp"

namespace epiline::report {

/// What an error picture says of a pixel.
enum class error_class : std::uint8_t { right, off_by_two, wrong, undefined, unknown };

struct error_class_look {
  eval::rgb_colour colour;
  std::string_view meaning;
};

/// Colours and meanings by error_class: told apart by lightness too.
[[nodiscard]] const std::array<error_class_look, 5>& error_looks();

/// The class of a pixel: NaN disparity = undefined, NaN truth or one that does not count = unknown.
[[nodiscard]] error_class class_of(double disparity, double truth);

/// Both pictures in the colours of eval::picture_of.
[[nodiscard]] std::string map_uri(const eval::real_map& map, int levels);
/// Throws std::invalid_argument when the sizes differ.
[[nodiscard]] std::string error_uri(const eval::real_map& map, const eval::ground_truth& truth);
/// A photograph, compressed for looking at.
[[nodiscard]] std::string photograph_uri(const eval::rgb_image& image);

/// data:TYPE;base64,...
[[nodiscard]] std::string data_uri(std::string_view type, std::string_view bytes);

/// #rrggbb
[[nodiscard]] std::string hexadecimal(const eval::rgb_colour& colour);

}  // namespace epiline::report
