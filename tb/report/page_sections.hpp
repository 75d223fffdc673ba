#pragma once
// The sections of the page that are long enough for a file of their own. Each returns HTML.

#include <string>

#include "report/page.hpp"

namespace epiline::report {

/// Pictures and figures of one pair. `methods` are the columns of the evaluation.
[[nodiscard]] std::string pair_section(const std::vector<method>& methods, const pair_result& pair);

/// The paper's tables with its printed values beside ours.
[[nodiscard]] std::string paper_section(const report_contents& contents);

/// The name by which links on the page reach a pair.
[[nodiscard]] std::string anchor_of(const pair_result& pair);

/// "Tsukuba" for the scene "tsukuba", and "(synthetic)" where it is.
[[nodiscard]] std::string title_of(const pair_result& pair);

}  // namespace epiline::report
