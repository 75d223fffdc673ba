#pragma once
// What the report compares: the designs with the settings worth seeing, and OpenCV's matchers.

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "eval/designs.hpp"
#include "eval/engine.hpp"
#include "opencv/matchers.hpp"

namespace epiline::report {

/// One row of the report's tables.
struct method {
  std::string id;                                        // in figures.json and figures.csv, for example adaptive_ca-r20
  std::string title;                                     // for people
  std::string settings;                                  // what differs from the defaults, or OpenCV's parameters
  const eval::design_description* design = nullptr;      // null: OpenCV
  const eval::engine_registry::entry* engine = nullptr;  // of the design
  eval::parameter_values parameters;                     // of the design
  opencv::matcher matcher{};                             // of OpenCV
  bool pictured = true;                                  // with pictures, or in the tables only
  bool final = true;                                     // what the method gives in the end; the summary has these
};

/// The variants of `design`, run by `engine`. A design that the table of variants does not know has one, with its
/// defaults.
[[nodiscard]] std::vector<method> methods_of(const eval::design_description& design,
                                             const eval::engine_registry::entry& engine);

/// StereoBM and StereoSGBM.
[[nodiscard]] std::vector<method> opencv_methods();

}  // namespace epiline::report
