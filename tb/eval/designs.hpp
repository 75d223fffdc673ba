#pragma once
// The one table of designs: what `epiline --list` prints, what a request is checked against and what engines are told
// about a design's limits all come from here.

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace epiline::eval {

/// A run-time parameter of a design (`--set NAME=VALUE`). `name` is also the name of the top's scalar.
struct parameter_description {
  std::string_view name;
  int minimum;
  int maximum;
  int default_value;
  std::string_view meaning;
};

/// A design as it is built: `name` is also the name of the top function and of the RTL module.
struct design_description {
  std::string_view name;
  std::string_view meaning;
  int max_width;   // columns the line memories hold
  int max_height;  // rows the frame counters hold
  int max_levels;  // disparity levels of the hardware
  int default_levels;
  int pixels_per_beat;  // of the top the engines run
  std::span<const parameter_description> parameters;
  std::string_view same_maps_as = {};  // the design this one is only another speed of; empty: a method of its own
};

using parameter_values = std::map<std::string, int, std::less<>>;

[[nodiscard]] std::span<const design_description> all_designs();

/// The design of that name, or null.
[[nodiscard]] const design_description* find_design(std::string_view name);

/// The parameter of that name, or null.
[[nodiscard]] const parameter_description* find_parameter(const design_description& design, std::string_view name);

/// Every parameter of the design with its default.
[[nodiscard]] parameter_values default_parameters(const design_description& design);

/// The name in `known` closest to `name` by edit distance; empty when none is near enough to be a slip of the finger.
[[nodiscard]] std::string_view closest_name(std::string_view name, std::span<const std::string_view> known);

}  // namespace epiline::eval
