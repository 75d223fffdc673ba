#pragma once

#include <nlohmann/json.hpp>

#include "eval/metrics.hpp"

namespace epiline::eval {

/// The counts and shares of `figures`, flat, in per cent; `nonocc_` and `disc_` begin the names of those over
/// non-occluded pixels and over pixels near discontinuities.
[[nodiscard]] nlohmann::ordered_json figures_json(const map_figures& figures);

}  // namespace epiline::eval
