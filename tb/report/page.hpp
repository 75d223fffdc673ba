#pragma once

#include <string>

#include "report/evaluation.hpp"
#include "report/timing.hpp"

namespace epiline::report {

/// What a report is made of.
struct report_contents {
  const evaluation& found;
  const timings& timing;  // empty when nothing was measured
  std::string version;
  std::string command;  // that made the report
};

/// One HTML page that needs nothing else: pictures are embedded, there is no script.
[[nodiscard]] std::string page_of(const report_contents& contents);

}  // namespace epiline::report
