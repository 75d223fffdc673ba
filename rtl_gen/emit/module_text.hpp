#pragma once
// A module's text as it grows, and what its writers share: lines, names, values, flip-flops. Every other part of the
// module is written by functions of a header of its own: control, handshakes, memories, waiting_values, logic, state.

#include <fmt/format.h>

#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "dataflow/graph.hpp"
#include "emit/expressions.hpp"
#include "emit/module_design.hpp"
#include "emit/module_names.hpp"
#include "emit/text.hpp"

namespace epiline::emit {

struct module_text : module_design {
  module_text(const dataflow::graph& graph, const schedule::delay_model& delays, const schedule::result& schedule,
              const verilog_options& wanted)
      : module_design(graph, delays, schedule, wanted), names(*this), values(*this, names) {}
  module_text(const module_text&) = delete;
  module_text& operator=(const module_text&) = delete;

  module_names names;
  expressions values;
  std::string out;
  bool adds_or_subtracts = false;  // the module of that name is needed
  bool has_copies = false;         // likewise

  template <class... Args>
  void line(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(out), format, std::forward<Args>(args)...);
    out += '\n';
  }
  void title(std::string_view text) { line("\n  // ---- {} ----", text); }
  /// "  // kernel.cpp:12", or nothing.
  [[nodiscard]] std::string comment(dataflow::source_location where) const;

  /// The array of a memory that this read looks at.
  [[nodiscard]] const std::string& array_read_by(dataflow::node_id read) const;

  using move_list = std::vector<std::pair<std::string, std::string>>;  // at the clock: into what, and what
  struct flip_flops {
    std::string name;
    unsigned width = 1;
    dataflow::source_location where = {};
    bool is_zero_at_power_up = false;
  };
  /// Declares flip-flops and writes their copies; the flip-flops' own moves are added to `moves`. `source` gives the
  /// text of what they take over, for the reader that is set.
  template <class Source>
  void write_flip_flops(const flip_flops& wanted, const copies& all, const Source& source, move_list& moves);
  void write_moves(const move_list& moves);
  /// One copy: an instance that synthesis keeps apart.
  void write_copy(const std::string& name, unsigned width, const std::string& source);
};

template <class Source>
void module_text::write_flip_flops(const flip_flops& wanted, const copies& all, const Source& source,
                                   move_list& moves) {
  const std::string initial = wanted.is_zero_at_power_up ? fmt::format(" = {}", literal(wanted.width, 0)) : "";
  line("  reg {}{}{};{}", range_of(wanted.width), wanted.name, initial, comment(wanted.where));
  for (std::size_t copy = 0; copy < all.count(); ++copy) {
    values.read_by(all.first_reader[copy]);
    if (copy > 0) {
      write_copy(copy_name(wanted.name, copy), wanted.width, source());
    } else {
      moves.emplace_back(wanted.name, source());
    }
  }
  values.read_by(0);
}

}  // namespace epiline::emit
