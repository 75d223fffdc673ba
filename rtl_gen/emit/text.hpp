#pragma once
// Small pieces of Verilog text that several writers need.

#include <fmt/format.h>
#include <llvm/ADT/APInt.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <string>
#include <string_view>

#include "dataflow/graph.hpp"

namespace epiline::emit {

/// "[7:0] ", or nothing for one bit.
[[nodiscard]] inline std::string range_of(unsigned width) {
  return width == 1 ? "" : fmt::format("[{}:0] ", width - 1);
}

/// Bits that count from 0 to `largest`, at least one.
[[nodiscard]] inline unsigned bits_for(std::uint64_t largest) {
  return std::max(1u, static_cast<unsigned>(std::bit_width(largest)));
}

/// "8'd200", or "16'h1f40" for what a person would not read in tens.
[[nodiscard]] std::string literal(const llvm::APInt& value);
[[nodiscard]] std::string literal(unsigned width, std::uint64_t value);

/// The bits of an operand inverted: of two operators in front of one another Verilog-2005 makes a syntax error.
[[nodiscard]] inline std::string inverted(const std::string& operand) {
  return operand.starts_with("~") ? "~(" + operand + ")" : "~" + operand;
}

/// "kernel.cpp:12" without folders; empty when unknown.
[[nodiscard]] inline std::string place_text(const dataflow::graph& g, dataflow::source_location where) {
  if (where.line == 0 || where.file >= g.files.size()) return "";
  const std::string_view path = g.files[where.file];
  const std::size_t slash = path.find_last_of('/');
  return fmt::format("{}:{}", path.substr(slash == std::string_view::npos ? 0 : slash + 1), where.line);
}

}  // namespace epiline::emit
