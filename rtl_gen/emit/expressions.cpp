#include "emit/expressions.hpp"

#include <fmt/format.h>
#include <llvm/ADT/APInt.h>

#include <algorithm>
#include <utility>

#include "emit/text.hpp"

namespace epiline::emit {

using dataflow::graph;
using dataflow::node;
using dataflow::node_id;
using dataflow::none;
using dataflow::operation;
using dataflow::register_id;
using schedule::settled;

namespace {

// An expression stays inside its user's line while it is this short.
constexpr std::size_t longest_inlined = 60;
constexpr std::size_t longest_concat_line = 100;

}  // namespace

expressions::expressions(const module_design& design, const module_names& names)
    : g_(design.g), s_(design.s), plan_(design.plan), names_(names) {
  choose_inlined();
}

void expressions::choose_inlined() {
  const std::size_t count = g_.nodes.size();
  std::vector<unsigned> use_count(count, 0);
  std::vector<char> needs_name(count, 0);
  std::vector<int> use_stage(count, settled);
  const auto note = [&](node_id value, int stage) {
    ++use_count[value];
    use_stage[value] = stage;
  };
  for (node_id id = 0; id < count; ++id) {
    const node& n = g_.nodes[id];
    for (const node_id operand : n.operands) {
      note(operand, s_.stage[id]);
      // What a bit select follows, and what is written more than once in the user's text.
      const bool selects = n.kind == operation::slice || n.kind == operation::extend_sign;
      const bool control = n.kind == operation::write || n.kind == operation::memory_write ||
                           n.kind == operation::read || n.kind == operation::memory_read || n.kind == operation::table;
      const bool shift = n.kind == operation::shift_left || n.kind == operation::shift_right_logical ||
                         n.kind == operation::shift_right_arithmetic;
      const bool division = n.kind == operation::divide_unsigned || n.kind == operation::divide_signed ||
                            n.kind == operation::remainder_unsigned || n.kind == operation::remainder_signed;
      if (selects || control || shift || division) needs_name[operand] = 1;
    }
  }
  for (register_id r = 0; r < g_.registers.size(); ++r) {
    note(g_.registers[r].next, s_.register_update[r]);
    note(g_.registers[r].enable, s_.register_update[r]);
    needs_name[g_.registers[r].enable] = 1;
  }
  if (g_.patient != none) needs_name[g_.patient] = 1;
  inlined_.assign(count, 0);
  for (node_id id = 0; id < count; ++id) {
    const node& n = g_.nodes[id];
    const bool here = s_.stage[id] == settled || (use_stage[id] == s_.stage[id] && plan_.waits[id].empty());
    // Copies of flip-flops are divided among nodes: inside another one's text the node would name that one's copy.
    const bool names_copies = std::any_of(n.operands.begin(), n.operands.end(), [&](node_id operand) {
      return plan_.value_copies.contains({operand, s_.stage[id]});
    });
    const bool single = use_count[id] == 1 && n.name.empty() && !needs_name[id] && !names_copies;
    const auto is_plain = [&](node_id value) {
      return g_.nodes[value].kind != operation::constant && !inlined_[value];
    };
    switch (n.kind) {
      case operation::slice:
        // Text as short as a name; a delayed slice still has copies of its own.
        inlined_[id] = !needs_name[id] && n.name.empty() && is_plain(n.operands[0]);
        break;
      case operation::extend_zero:
      case operation::extend_sign:
        inlined_[id] = here && !needs_name[id] && n.name.empty() && is_plain(n.operands[0]);
        break;
      case operation::bit_not:
        inlined_[id] = here && !needs_name[id] && n.name.empty() && is_plain(n.operands[0]);
        break;
      case operation::bit_and:
      case operation::bit_or:
      case operation::bit_xor:
      case operation::equal:
      case operation::less_unsigned:
      case operation::less_signed:
      case operation::select:
      case operation::concat:
        inlined_[id] = single && here && !schedule::is_settled_register(g_, s_, id) &&
                       expression(id).text.size() <= longest_inlined;
        break;
      default:
        break;
    }
  }
}

value_text expressions::at(node_id id, int stage) const {
  const node& n = g_.nodes[id];
  if (n.kind == operation::constant) return {literal(n.value), true, false};
  if (s_.stage[id] == settled || stage == s_.available[id]) {
    if (inlined_[id]) return expression(id);
    return {names_.nodes[id], true, true};
  }
  const auto all = plan_.value_copies.find({id, stage});
  const std::string name = stage_name(names_.nodes[id], stage);
  return {all == plan_.value_copies.end() ? name : copy_of(name, all->second), true, true};
}

std::string expressions::operand(node_id id, int stage) const {
  const value_text v = at(id, stage);
  return v.primary ? v.text : "(" + v.text + ")";
}

std::string expressions::whole(node_id id, int stage) const { return at(id, stage).text; }

std::string expressions::part(const value_text& v, node_id source, unsigned low, unsigned width) const {
  const node& n = g_.nodes[source];
  if (n.kind == operation::constant) return literal(n.value.extractBits(width, low));
  if (width == n.width) return v.text;
  if (width == 1) return fmt::format("{}[{}]", v.text, low);
  return fmt::format("{}[{}:{}]", v.text, low + width - 1, low);
}

std::string expressions::index(node_id address, int stage, std::uint64_t words) const {
  const unsigned width = g_.nodes[address].width;
  const unsigned needed = bits_for(words - 1);
  const value_text v = at(address, stage);
  if (width > needed) return part(v, address, 0, needed);
  if (width < needed) return fmt::format("{{{}, {}}}", literal(needed - width, 0), v.text);
  return v.text;
}

value_text expressions::expression(node_id id) const {
  const node& n = g_.nodes[id];
  const int stage = s_.stage[id];
  const auto o = [&](std::size_t i) { return operand(n.operands[i], stage); };
  const auto binary = [&](const char* symbol) -> value_text {
    return {fmt::format("{} {} {}", o(0), symbol, o(1)), false, false};
  };
  const auto as_signed = [&](std::size_t i) { return fmt::format("$signed({})", whole(n.operands[i], stage)); };
  switch (n.kind) {
    case operation::add:
      return binary("+");
    case operation::subtract:
      return binary("-");
    case operation::multiply:
      return binary("*");
    case operation::add_or_subtract:
      return {fmt::format("{0} ? {1} - {2} : {1} + {2}", o(2), o(0), o(1)), false, false};
    case operation::bit_and:
      return binary("&");
    case operation::bit_or:
      return binary("|");
    case operation::bit_xor:
      return binary("^");
    case operation::bit_not:
      return {inverted(o(0)), true, false};
    case operation::equal:
      return binary("==");
    case operation::less_unsigned:
      return binary("<");
    case operation::less_signed:
      return {fmt::format("{} < {}", as_signed(0), as_signed(1)), false, false};
    case operation::select:
      return {fmt::format("{} ? {} : {}", o(0), o(1), o(2)), false, false};
    case operation::shift_left:
    case operation::shift_right_logical:
    case operation::shift_right_arithmetic:
      return shift(id);
    case operation::divide_unsigned:
      return binary("/");
    case operation::remainder_unsigned:
      return binary("%");
    case operation::divide_signed:
      return {fmt::format("{} / {}", as_signed(0), as_signed(1)), false, false};
    case operation::remainder_signed:
      return {fmt::format("{} % {}", as_signed(0), as_signed(1)), false, false};
    case operation::slice: {
      const value_text v = at(n.operands[0], stage);
      // A part of a slice that is its operand's text needs no brackets of its own only when it is everything.
      return {part(v, n.operands[0], n.low, n.width), true, false};
    }
    case operation::extend_zero: {
      const unsigned more = n.width - g_.nodes[n.operands[0]].width;
      return {fmt::format("{{{}, {}}}", literal(more, 0), whole(n.operands[0], stage)), true, false};
    }
    case operation::extend_sign: {
      const node& a = g_.nodes[n.operands[0]];
      if (a.kind == operation::constant) return {literal(a.value.sext(n.width)), true, false};
      const unsigned more = n.width - a.width;
      const value_text v = at(n.operands[0], stage);
      return {fmt::format("{{{{{}{{{}}}}}, {}}}", more, part(v, n.operands[0], a.width - 1, 1), v.text), true, false};
    }
    case operation::concat:
      return {joined(id), true, false};
    default:
      return {names_.nodes[id], true, true};
  }
}

value_text expressions::shift(node_id id) const {
  const node& n = g_.nodes[id];
  const int stage = s_.stage[id];
  const bool arithmetic = n.kind == operation::shift_right_arithmetic;
  const char* const symbol = n.kind == operation::shift_left ? "<<" : arithmetic ? ">>>" : ">>";
  const std::string value =
      arithmetic ? fmt::format("$signed({})", whole(n.operands[0], stage)) : operand(n.operands[0], stage);
  const node& amount = g_.nodes[n.operands[1]];
  constexpr unsigned most = 17;  // amounts of more bits than any width has: tools take 32 at most
  if (amount.width <= most)
    return {fmt::format("{} {} {}", value, symbol, operand(n.operands[1], stage)), false, false};
  const value_text full = at(n.operands[1], stage);
  if (amount.kind == operation::constant) {
    const llvm::APInt limited(most, amount.value.getLimitedValue((1u << most) - 1));
    return {fmt::format("{} {} {}", value, symbol, literal(limited)), false, false};
  }
  // Saturated: any amount with a high bit set shifts everything out.
  return {fmt::format("{} {} ({} | {{{}{{|{}}}}})", value, symbol, part(full, n.operands[1], 0, most), most,
                      part(full, n.operands[1], most, amount.width - most)),
          false, false};
}

/// The operands of a concatenation, in lines that a person can read.
std::string expressions::joined(node_id id) const {
  const node& n = g_.nodes[id];
  const int stage = s_.stage[id];
  std::string text = "{";
  std::size_t length = 0;
  for (std::size_t i = 0; i < n.operands.size(); ++i) {
    const std::string item = whole(n.operands[i], stage);
    if (i > 0) {
      text += ", ";
      length += item.size() + 2;
      if (length > longest_concat_line) {
        text += "\n    ";
        length = item.size();
      }
    }
    text += item;
  }
  return text + "}";
}

std::string expressions::valid(int stage) const {
  if (stage == 0) return "fire";
  const std::size_t copy = plan_.valid_copies[stage].of(reader_);
  return copy == 0 ? fmt::format("valid[{}]", stage) : copy_name(fmt::format("valid_s{}", stage), copy);
}

std::string expressions::update_bit(node_id condition, int stage) const {
  const auto found = plan_.update_bits.find({condition, stage});
  if (found == plan_.update_bits.end()) return "";
  return copy_of(names_.update_bits.at({condition, stage}), found->second);
}

std::string expressions::state_reset() const {
  return plan_.has_reset_rows() ? copy_of("state_reset", plan_.reset_copies) : "resetting";
}

std::string expressions::copy_of(const std::string& name, const copies& all) const {
  const std::size_t copy = all.of(reader_);
  return copy == 0 ? name : copy_name(name, copy);
}

}  // namespace epiline::emit
