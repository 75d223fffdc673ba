#pragma once
// The names in a module's text: those of the source where it has any, and none of them twice.

#include <map>
#include <string>
#include <string_view>
#include <unordered_set>
#include <utility>
#include <vector>

#include "dataflow/graph.hpp"
#include "emit/module_design.hpp"

namespace epiline::emit {

class module_names {
 public:
  /// Chooses all names. Throws std::invalid_argument for a port or an argument that cannot have its name.
  explicit module_names(const module_design& design);

  /// A name like `wanted` that nothing has yet.
  [[nodiscard]] std::string fresh(std::string_view wanted);

  std::vector<std::string> nodes;  // empty for nodes that are never named
  std::vector<std::string> registers, tables, ports, delay_lines;
  std::vector<std::vector<std::string>> memories;                        // by memory: an array for each port that reads
  std::vector<std::string> pending;                                      // patient registers' next value
  std::map<std::pair<dataflow::node_id, int>, std::string> update_bits;  // of plan::update_bits

 private:
  void reserve_interface(const module_design& design);
  [[nodiscard]] std::string fresh_port(const std::string& wanted, bool axi_lite);

  std::unordered_set<std::string> taken_;
  std::map<std::string, unsigned, std::less<>> numbers_;
};

/// The value `base` as it stands in `stage`, some stages after its own.
[[nodiscard]] std::string stage_name(std::string_view base, int stage);
/// One of the copies of the flip-flops `base`.
[[nodiscard]] std::string copy_name(std::string_view base, std::size_t copy);
/// A pointer of a delay line: where the next word goes ("in"), or which one is read ("out").
[[nodiscard]] std::string pointer_name(const delay_line& line, std::string_view end);

}  // namespace epiline::emit
