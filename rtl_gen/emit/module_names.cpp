#include "emit/module_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <stdexcept>

#include "emit/names.hpp"
#include "emit/register_map.hpp"

namespace epiline::emit {

using dataflow::node;
using dataflow::node_id;
using dataflow::operation;
using dataflow::register_id;
using schedule::settled;

namespace {

/// What a value that has no name in the source is called after.
const char* name_of_result(operation kind) {
  switch (kind) {
    case operation::add:
      return "sum";
    case operation::subtract:
      return "difference";
    case operation::add_or_subtract:
      return "total";
    case operation::multiply:
      return "product";
    case operation::select:
      return "choice";
    case operation::equal:
      return "same";
    case operation::less_unsigned:
    case operation::less_signed:
      return "less";
    case operation::bit_and:
      return "both";
    case operation::bit_or:
      return "either";
    case operation::bit_xor:
      return "differ";
    case operation::bit_not:
      return "inverse";
    case operation::concat:
      return "joined";
    case operation::slice:
      return "part";
    case operation::extend_zero:
    case operation::extend_sign:
      return "wide";
    case operation::shift_left:
    case operation::shift_right_logical:
    case operation::shift_right_arithmetic:
      return "shifted";
    case operation::table:
      return "entry";
    case operation::memory_read:
      return "word";
    case operation::read:
      return "token";
    default:
      return "value";
  }
}

}  // namespace

std::string stage_name(std::string_view base, int stage) { return fmt::format("{}_s{}", base, stage); }

std::string copy_name(std::string_view base, std::size_t copy) { return fmt::format("{}_copy{}", base, copy); }

std::string pointer_name(const delay_line& line, std::string_view end) {
  const std::string name = fmt::format("delay_{}_{}", line.words(), end);
  return line.pointers == 0 ? name : copy_name(name, line.pointers);
}

module_names::module_names(const module_design& design) {
  reserve_interface(design);
  for (const delay_line& l : design.plan.lines)
    for (const char* end : {"in", "out"}) taken_.insert(pointer_name(l, end));
  for (const dataflow::port& port : design.g.ports) ports.push_back(fresh_port(port.name, design.options.axi_lite));
  for (const dataflow::register_state& r : design.g.registers)
    registers.push_back(fresh(r.name.empty() ? "state" : r.name));
  for (std::size_t i = 0; i < design.g.memories.size(); ++i) {
    const std::string& name = design.g.memories[i].name;
    memories.push_back({fresh(name.empty() ? "ram" : name)});
    for (std::size_t copy = 1; copy < design.plan.memories[i].reads.size(); ++copy)
      memories.back().push_back(fresh(copy_name(memories.back()[0], copy)));
  }
  for (const dataflow::table& t : design.g.tables) tables.push_back(fresh(t.name.empty() ? "rom" : t.name));
  pending.resize(design.g.registers.size());
  for (register_id r = 0; r < design.g.registers.size(); ++r) {
    if (design.s.register_stage[r] == settled) pending[r] = fresh(registers[r] + "_pending");
  }
  nodes.resize(design.g.nodes.size());
  for (node_id id = 0; id < design.g.nodes.size(); ++id) {
    const node& n = design.g.nodes[id];
    if (n.kind == operation::constant || n.kind == operation::write || n.kind == operation::memory_write) continue;
    if (n.kind == operation::register_value) {
      nodes[id] = registers[n.object];
    } else if (!n.name.empty()) {
      nodes[id] = fresh(n.name);
    } else {
      nodes[id] = fresh(fmt::format("{}_{}", name_of_result(n.kind), id));
    }
    taken_.insert(nodes[id] + "_q");
    taken_.insert(nodes[id] + "_exact");
  }
  for (const auto& [place, all] : design.plan.update_bits)
    update_bits[place] = fresh(fmt::format("{}_enable_{}", nodes[place.first], place.second));
  for (const delay_line& l : design.plan.lines)
    delay_lines.push_back(fresh(fmt::format("wait_s{}_to_s{}_ram", l.from, l.to)));
}

std::string module_names::fresh(std::string_view wanted) {
  std::string base;
  for (const char c : wanted) {
    const bool good = std::isalnum(static_cast<unsigned char>(c)) || c == '_';
    if (good) {
      base += c;
    } else if (!base.empty() && base.back() != '_') {
      base += '_';
    }
  }
  while (!base.empty() && base.back() == '_') base.pop_back();
  if (base.empty() || std::isdigit(static_cast<unsigned char>(base[0]))) base = "v" + base;
  // Names that look like a pipeline copy ("x_s3") or an internal number would be misread.
  const std::size_t mark = base.find_last_not_of("0123456789");
  if (mark != std::string::npos && mark + 1 < base.size()) {
    const std::string_view stem = std::string_view(base).substr(0, mark + 1);
    if (stem.ends_with("_s") || stem.ends_with("_copy")) base += "_v";
  }
  std::string name = base;
  if (is_keyword(name) || taken_.contains(name)) {
    unsigned& number = numbers_[base];
    do name = fmt::format("{}_{}", base, ++number);
    while (taken_.contains(name));
  }
  taken_.insert(name);
  return name;
}

/// A port's name, of which nothing internal of the port clashes either.
std::string module_names::fresh_port(const std::string& wanted, bool axi_lite) {
  constexpr const char* of_buffer[] = {"_first", "_second", "_fills_second", "_reads_second", "_there",
                                       "_ready", "_token",  "_take",         "_push"};
  constexpr const char* suffixes[] = {"_fifo",       "_in",        "_out",          "_after_out",     "_word",
                                      "_word_there", "_waits",     "_load",         "_leaves",        "_left",
                                      "_skipped",    "_holds_one", "_data",         "_holds_another", "_credits",
                                      "_fewer",      "_change",    "_credits_next", "_room",          "_served"};
  constexpr const char* argument_suffixes[] = {"_registers", "_wanted", "_sample", "_start",
                                               "_hold",      "_keep",   "_slave"};
  std::vector<std::string> used(std::begin(suffixes), std::end(suffixes));
  for (const char* suffix : of_buffer) {
    used.emplace_back(suffix);
    used.push_back(std::string("_end") + suffix);
  }
  if (axi_lite) used.insert(used.end(), std::begin(argument_suffixes), std::end(argument_suffixes));
  for (;;) {
    const std::string name = fresh(wanted);
    const bool clash = std::any_of(used.begin(), used.end(),
                                   [&](const std::string& suffix) { return taken_.contains(name + suffix); });
    if (clash) continue;
    for (const std::string& suffix : used) taken_.insert(name + suffix);
    return name;
  }
}

void module_names::reserve_interface(const module_design& design) {
  const std::vector<std::string> stems = reserve_signals(design.g, design.interface, taken_);
  if (design.options.axi_lite) {
    for (const argument_register& argument : make_register_map(design.g).arguments) {
      if (is_identifier(argument.name)) continue;
      throw std::invalid_argument(
          fmt::format("argument '{}' cannot have that name in Verilog: rename it", argument.name));
    }
  }
  for (const char* name :
       {"fire", "valid", "hold", "holding", "resetting", "may_issue", "commit", "state_reset", "early_state_reset"}) {
    if (!taken_.insert(name).second) {
      throw std::invalid_argument(
          fmt::format("port signal '{}' has the name of a control signal of the module: rename it", name));
    }
  }
  taken_.insert(stems.begin(), stems.end());
}

}  // namespace epiline::emit
