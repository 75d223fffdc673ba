#pragma once
// Small pieces of Verilog text that several writers need.

#include <fmt/format.h>

#include <string>
#include <string_view>

#include "dataflow/graph.hpp"

namespace epiline::emit {

/// "[7:0] ", or nothing for one bit.
[[nodiscard]] inline std::string range_of(unsigned width) {
  return width == 1 ? "" : fmt::format("[{}:0] ", width - 1);
}

/// "kernel.cpp:12" without folders; empty when unknown.
[[nodiscard]] inline std::string place_text(const dataflow::graph& g, dataflow::source_location where) {
  if (where.line == 0 || where.file >= g.files.size()) return "";
  const std::string_view path = g.files[where.file];
  const std::size_t slash = path.find_last_of('/');
  return fmt::format("{}:{}", path.substr(slash == std::string_view::npos ? 0 : slash + 1), where.line);
}

}  // namespace epiline::emit
