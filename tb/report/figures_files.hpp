#pragma once
// The report's figures for programs.

#include <nlohmann/json.hpp>
#include <string>

#include "report/page.hpp"

namespace epiline::report {

inline constexpr const char* figures_schema = "epiline-evaluation/1";

/// Everything that the page says in numbers.
[[nodiscard]] nlohmann::ordered_json evaluation_json(const report_contents& contents);

/// A line for every method on every pair that was evaluated, figures as in the JSON.
[[nodiscard]] std::string evaluation_csv(const evaluation& found);

}  // namespace epiline::report
