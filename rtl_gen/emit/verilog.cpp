#include "emit/verilog.hpp"

#include <fmt/format.h>
#include <llvm/ADT/APInt.h>
#include <llvm/ADT/SmallString.h>
#include <llvm/ADT/StringRef.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <map>
#include <set>
#include <stdexcept>
#include <string_view>
#include <unordered_set>
#include <utility>

#include "emit/interface.hpp"
#include "emit/names.hpp"
#include "emit/register_map.hpp"
#include "emit/text.hpp"

namespace epiline::emit {

using dataflow::graph;
using dataflow::node;
using dataflow::node_id;
using dataflow::none;
using dataflow::operation;
using dataflow::port_kind;
using dataflow::register_id;
using schedule::settled;
using schedule::storage_kind;

namespace {

// An expression stays inside its user's line while it is this short.
constexpr std::size_t longest_inlined = 60;
constexpr std::size_t longest_concat_line = 100;

std::string literal(const llvm::APInt& value) {
  const unsigned width = value.getBitWidth();
  llvm::SmallString<64> digits;
  const bool small = value.getActiveBits() <= 10;
  value.toString(digits, small ? 10 : 16, false, false);
  std::string text(digits.str());
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return fmt::format("{}'{}{}", width, small ? 'd' : 'h', text);
}

std::string literal(unsigned width, std::uint64_t value) { return literal(llvm::APInt(width, value)); }

/// The bits of an operand inverted: of two operators in front of one another Verilog-2005 makes a syntax error.
std::string inverted(const std::string& operand) {
  return operand.starts_with("~") ? "~(" + operand + ")" : "~" + operand;
}

unsigned bits_for(std::uint64_t largest) { return std::max(1u, static_cast<unsigned>(std::bit_width(largest))); }

/// A module of its own, because synthesis makes one carry chain of it only when it is told how
/// (scripts/ecp5_operators.v); several generated files may be compiled together.
constexpr const char* add_or_subtract_module = R"(
`ifndef EPILINE_ADD_OR_SUBTRACT
`define EPILINE_ADD_OR_SUBTRACT
/* verilator lint_off DECLFILENAME */
module epiline_add_or_subtract #(
  parameter WIDTH = 8
) (
  input  wire [WIDTH-1:0] a,
  input  wire [WIDTH-1:0] b,
  input  wire             subtract,
  output wire [WIDTH-1:0] total
);
  // The lowest place only makes the carry: a - b is a + ~b + 1.
  wire [WIDTH:0] sum = {a, subtract} + {b ^ {WIDTH{subtract}}, subtract};
  assign total = sum[WIDTH:1];
endmodule
/* verilator lint_on DECLFILENAME */
`endif)";

/// A module of its own, because synthesis makes one flip-flop of several that hold the same bits unless each is one it
/// does not look into until the end (scripts/ecp5_copies.v).
constexpr const char* copy_module = R"(
`ifndef EPILINE_COPY
`define EPILINE_COPY
/* verilator lint_off DECLFILENAME */
module epiline_copy #(
  parameter WIDTH = 1
) (
  input  wire             clk,
  input  wire [WIDTH-1:0] d,
  output wire [WIDTH-1:0] q
);
  (* keep = "true", syn_preserve = 1, dont_merge *)
  reg [WIDTH-1:0] bits = {WIDTH{1'b0}};
  always @(posedge clk) bits <= d;
  assign q = bits;
endmodule
/* verilator lint_on DECLFILENAME */
`endif)";

class writer {
 public:
  writer(const graph& g, const schedule::delay_model& model, const schedule::result& s, const verilog_options& options)
      : g_(g),
        s_(s),
        options_(options),
        model_(model),
        plan_(make_plan(g, model, s, options.delay_lines)),
        interface_(interface_of(g, options.axi_lite)) {}

  std::string write();
  /// What the names that write() has given come from.
  [[nodiscard]] std::vector<signal> signals() const;

 private:
  // --- names ---
  std::string fresh(std::string_view wanted);
  std::string fresh_port(const std::string& wanted);  // no internal signal of the port clashes either
  void reserve_interface();
  void choose_names();
  void choose_inlined();
  static std::string stage_name(std::string_view base, int stage) { return fmt::format("{}_s{}", base, stage); }

  // --- expressions ---
  struct text_of_value {
    std::string text;
    bool primary = true;     // may stand beside any operator without parentheses
    bool identifier = true;  // a bit select may follow
  };
  text_of_value at(node_id id, int stage) const;
  std::string operand(node_id id, int stage) const;  // parenthesised unless primary
  std::string whole(node_id id, int stage) const;    // as a complete expression
  text_of_value expression(node_id id) const;
  std::string part(const text_of_value& v, node_id source, unsigned low, unsigned width) const;
  std::string index(node_id address, int stage, std::uint64_t words) const;
  std::string valid(int stage) const;
  /// The name of the flip-flops `name`, of which there are `all`, that the present reader looks at.
  std::string copy_of(std::string name, const copies& all) const {
    const std::size_t copy = all.of(reader_);
    return copy == 0 ? name : copy_name(name, copy);
  }
  static std::string copy_name(std::string_view base, std::size_t copy) { return fmt::format("{}_copy{}", base, copy); }
  std::string comment(dataflow::source_location where) const;
  bool is_always(node_id id) const {
    return g_.nodes[id].kind == operation::constant && g_.nodes[id].value.isAllOnes();
  }

  // --- text ---
  template <class... Args>
  void line(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(out_), format, std::forward<Args>(args)...);
    out_ += '\n';
  }
  void title(std::string_view text) { line("\n  // ---- {} ----", text); }
  void write_heading();
  void write_control_declarations();
  void write_inputs();
  void write_buffer(const std::string& stem, unsigned width, const std::string& token, const std::string& offered,
                    bool foreseen);
  void write_sampled_arguments(const std::string& name);
  void write_settled();
  void write_memory_declarations();
  void write_contents(const std::string& name, const std::vector<llvm::APInt>& values);
  void write_stage(int stage);
  void write_copies(int stage);
  using move_list = std::vector<std::pair<std::string, std::string>>;  // at the clock: into what, and what
  struct flip_flops {
    std::string name;
    unsigned width = 1;
    dataflow::source_location where = {};
    bool is_zero_at_power_up = false;
  };
  template <class Source>
  void write_flip_flops(const flip_flops& wanted, const copies& all, const Source& source, move_list& moves);
  void write_moves(const move_list& moves);
  void write_copy(const std::string& name, unsigned width, const std::string& source);
  void write_logic(int stage);
  void write_issue();
  void write_state(int stage);
  void write_memory_writes(int stage);
  void write_valids();
  void write_patient();
  void write_outputs();
  void write_delay_pointers();
  void write_node(node_id id);
  [[nodiscard]] std::string update_bit(node_id condition, int stage) const;
  [[nodiscard]] std::string state_reset() const;
  void write_reset_rows();
  void declare_register(register_id r);
  void collect_lines(node_id id, std::vector<dataflow::source_location>& lines) const;

  bool is_sampled(const dataflow::port& port) const { return options_.axi_lite && port.kind == port_kind::call; }
  int most_hold() const { return std::max(s_.hold, s_.initiation_interval - 1); }
  int settle_clocks() const { return s_.hold - s_.commit; }
  /// After a reset nothing is issued until what was in flight has left the pipeline, state has its initial values and
  /// what is computed from settled values is right: then valid bits need no reset, which would go to every stage.
  int reset_clocks() const { return std::max(plan_.last_valid, settle_clocks()) + 1 + after_state_reset; }
  /// Clocks from the end of `resetting` to the first issue, of which two rows of copies take two.
  static constexpr int after_state_reset = 4;
  unsigned hold_bits() const { return bits_for(std::max(most_hold(), reset_clocks()) + 1); }
  [[nodiscard]] std::optional<node_id> need_register(dataflow::port_id port) const;

  const graph& g_;
  const schedule::result& s_;
  const verilog_options& options_;
  const schedule::delay_model& model_;
  plan plan_;
  std::vector<rtl_port> interface_;
  std::string out_;
  std::unordered_set<std::string> taken_;
  std::map<std::string, unsigned, std::less<>> numbers_;
  std::vector<std::string> node_name_, register_name_, memory_name_, table_name_, port_name_, line_name_;
  std::map<std::pair<node_id, int>, std::string> update_name_;  // of plan::update_bits
  bool adds_or_subtracts_ = false;                              // the module of that name is needed
  bool has_copies_ = false;                                     // likewise
  schedule::reader reader_ = 0;  // whose text is being written: decides which copy of a flip-flop it names
  std::vector<char> inlined_;
  std::vector<std::string> pending_name_;       // patient registers' next value
  std::vector<std::vector<node_id>> nodes_at_;  // per stage
  std::vector<std::vector<register_id>> registers_at_, updates_at_;
  std::vector<std::vector<std::size_t>> memory_reads_at_;  // unused entries stay empty
};

std::string writer::fresh(std::string_view wanted) {
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

std::string writer::fresh_port(const std::string& wanted) {
  constexpr const char* of_buffer[] = {"_first", "_second", "_fills_second", "_reads_second", "_there",
                                       "_ready", "_token",  "_take",         "_push"};
  constexpr const char* suffixes[] = {"_fifo", "_in",   "_out",     "_word", "_word_there",   "_left",  "_skipped",
                                      "_load", "_data", "_credits", "_room", "_credits_next", "_served"};
  constexpr const char* argument_suffixes[] = {"_registers", "_wanted", "_sample", "_start",
                                               "_hold",      "_keep",   "_slave"};
  std::vector<std::string> used(std::begin(suffixes), std::end(suffixes));
  for (const char* suffix : of_buffer) {
    used.emplace_back(suffix);
    used.push_back(std::string("_end") + suffix);
  }
  if (options_.axi_lite) used.insert(used.end(), std::begin(argument_suffixes), std::end(argument_suffixes));
  for (;;) {
    const std::string name = fresh(wanted);
    const bool clash = std::any_of(used.begin(), used.end(),
                                   [&](const std::string& suffix) { return taken_.contains(name + suffix); });
    if (clash) continue;
    for (const std::string& suffix : used) taken_.insert(name + suffix);
    return name;
  }
}

void writer::reserve_interface() {
  const std::vector<std::string> stems = reserve_signals(g_, interface_, taken_);
  if (options_.axi_lite) {
    for (const argument_register& argument : make_register_map(g_).arguments) {
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

void writer::choose_names() {
  const auto letter_name = [](operation kind) {
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
  };
  for (const dataflow::port& port : g_.ports) port_name_.push_back(fresh_port(port.name));
  for (const dataflow::register_state& r : g_.registers)
    register_name_.push_back(fresh(r.name.empty() ? "state" : r.name));
  for (const dataflow::memory& m : g_.memories) memory_name_.push_back(fresh(m.name.empty() ? "ram" : m.name));
  for (const dataflow::table& t : g_.tables) table_name_.push_back(fresh(t.name.empty() ? "rom" : t.name));
  pending_name_.resize(g_.registers.size());
  for (register_id r = 0; r < g_.registers.size(); ++r) {
    if (s_.register_stage[r] == settled) pending_name_[r] = fresh(register_name_[r] + "_pending");
  }
  node_name_.resize(g_.nodes.size());
  for (node_id id = 0; id < g_.nodes.size(); ++id) {
    const node& n = g_.nodes[id];
    if (n.kind == operation::constant || n.kind == operation::write || n.kind == operation::memory_write) continue;
    if (n.kind == operation::register_value) {
      node_name_[id] = register_name_[n.object];
    } else if (!n.name.empty()) {
      node_name_[id] = fresh(n.name);
    } else {
      node_name_[id] = fresh(fmt::format("{}_{}", letter_name(n.kind), id));
    }
    taken_.insert(node_name_[id] + "_q");
    taken_.insert(node_name_[id] + "_exact");
  }
  for (const auto& [place, all] : plan_.update_bits)
    update_name_[place] = fresh(fmt::format("{}_enable_{}", node_name_[place.first], place.second));
  for (const delay_line& l : plan_.lines) line_name_.push_back(fresh(fmt::format("wait_s{}_to_s{}_ram", l.from, l.to)));
}

void writer::choose_inlined() {
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
    const bool single = use_count[id] == 1 && n.name.empty() && !needs_name[id];
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

writer::text_of_value writer::at(node_id id, int stage) const {
  const node& n = g_.nodes[id];
  if (n.kind == operation::constant) return {literal(n.value), true, false};
  if (s_.stage[id] == settled || stage == s_.available[id]) {
    if (inlined_[id]) return expression(id);
    return {node_name_[id], true, true};
  }
  const auto all = plan_.value_copies.find({id, stage});
  const std::string name = stage_name(node_name_[id], stage);
  return {all == plan_.value_copies.end() ? name : copy_of(name, all->second), true, true};
}

std::string writer::valid(int stage) const {
  if (stage == 0) return "fire";
  const std::size_t copy = plan_.valid_copies[stage].of(reader_);
  return copy == 0 ? fmt::format("valid[{}]", stage) : copy_name(fmt::format("valid_s{}", stage), copy);
}

std::string writer::update_bit(node_id condition, int stage) const {
  const auto found = plan_.update_bits.find({condition, stage});
  if (found == plan_.update_bits.end()) return "";
  return copy_of(update_name_.at({condition, stage}), found->second);
}

/// The reset of state: some clocks later than that of handshakes, and as long as iterations may be in flight.
std::string writer::state_reset() const {
  return plan_.has_reset_rows() ? copy_of("state_reset", plan_.reset_copies) : "resetting";
}

/// Flip-flops and their copies. `source` gives the text of what they take over, for the reader that is set.
template <class Source>
void writer::write_flip_flops(const flip_flops& wanted, const copies& all, const Source& source, move_list& moves) {
  const std::string initial = wanted.is_zero_at_power_up ? fmt::format(" = {}", literal(wanted.width, 0)) : "";
  line("  reg {}{}{};{}", range_of(wanted.width), wanted.name, initial, comment(wanted.where));
  for (std::size_t copy = 0; copy < all.count(); ++copy) {
    reader_ = all.first_reader[copy];
    if (copy > 0) {
      write_copy(copy_name(wanted.name, copy), wanted.width, source());
    } else {
      moves.emplace_back(wanted.name, source());
    }
  }
  reader_ = 0;
}

void writer::write_moves(const move_list& moves) {
  if (moves.empty()) return;
  line("  always @(posedge clk) begin");
  for (const auto& [target, source] : moves) line("    {} <= {};", target, source);
  line("  end");
}

void writer::write_reset_rows() {
  if (!plan_.has_reset_rows()) return;
  title("reset of the state: through two rows of flip-flops, near what they reset");
  move_list moves;
  write_flip_flops({"early_state_reset", 1}, plan_.early_reset_copies, [] { return std::string("resetting"); }, moves);
  write_flip_flops(
      {"state_reset", 1}, plan_.reset_copies, [&] { return copy_of("early_state_reset", plan_.early_reset_copies); },
      moves);
  write_moves(moves);
}

std::string writer::operand(node_id id, int stage) const {
  const text_of_value v = at(id, stage);
  return v.primary ? v.text : "(" + v.text + ")";
}

std::string writer::whole(node_id id, int stage) const { return at(id, stage).text; }

std::string writer::part(const text_of_value& v, node_id source, unsigned low, unsigned width) const {
  const node& n = g_.nodes[source];
  if (n.kind == operation::constant) return literal(n.value.extractBits(width, low));
  if (width == n.width) return v.text;
  if (width == 1) return fmt::format("{}[{}]", v.text, low);
  return fmt::format("{}[{}:{}]", v.text, low + width - 1, low);
}

std::string writer::index(node_id address, int stage, std::uint64_t words) const {
  const unsigned width = g_.nodes[address].width;
  const unsigned needed = bits_for(words - 1);
  const text_of_value v = at(address, stage);
  if (width > needed) return part(v, address, 0, needed);
  if (width < needed) return fmt::format("{{{}, {}}}", literal(needed - width, 0), v.text);
  return v.text;
}

std::string writer::comment(dataflow::source_location where) const {
  const std::string place = place_text(g_, where);
  return place.empty() ? "" : "  // " + place;
}

writer::text_of_value writer::expression(node_id id) const {
  const node& n = g_.nodes[id];
  const int stage = s_.stage[id];
  const auto o = [&](std::size_t i) { return operand(n.operands[i], stage); };
  const auto binary = [&](const char* symbol) -> text_of_value {
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
    case operation::shift_right_arithmetic: {
      const bool arithmetic = n.kind == operation::shift_right_arithmetic;
      const char* const symbol = n.kind == operation::shift_left ? "<<" : arithmetic ? ">>>" : ">>";
      const std::string value = arithmetic ? as_signed(0) : o(0);
      const node& amount = g_.nodes[n.operands[1]];
      constexpr unsigned most = 17;  // amounts of more bits than any width has: tools take 32 at most
      if (amount.width <= most) return {fmt::format("{} {} {}", value, symbol, o(1)), false, false};
      const text_of_value full = at(n.operands[1], stage);
      if (amount.kind == operation::constant) {
        const llvm::APInt limited(most, amount.value.getLimitedValue((1u << most) - 1));
        return {fmt::format("{} {} {}", value, symbol, literal(limited)), false, false};
      }
      // Saturated: any amount with a high bit set shifts everything out.
      return {fmt::format("{} {} ({} | {{{}{{|{}}}}})", value, symbol, part(full, n.operands[1], 0, most), most,
                          part(full, n.operands[1], most, amount.width - most)),
              false, false};
    }
    case operation::divide_unsigned:
      return binary("/");
    case operation::remainder_unsigned:
      return binary("%");
    case operation::divide_signed:
      return {fmt::format("{} / {}", as_signed(0), as_signed(1)), false, false};
    case operation::remainder_signed:
      return {fmt::format("{} % {}", as_signed(0), as_signed(1)), false, false};
    case operation::slice: {
      const text_of_value v = at(n.operands[0], stage);
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
      const text_of_value v = at(n.operands[0], stage);
      return {fmt::format("{{{{{}{{{}}}}}, {}}}", more, part(v, n.operands[0], a.width - 1, 1), v.text), true, false};
    }
    case operation::concat: {
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
      return {text + "}", true, false};
    }
    default:
      return {node_name_[id], true, true};
  }
}

void writer::write_heading() {
  line("// {}: made by epiline-hls.", g_.name);
  if (!options_.heading.empty()) {
    std::string_view rest = options_.heading;
    while (!rest.empty()) {
      const std::size_t end = rest.find('\n');
      line("// {}", rest.substr(0, end));
      rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
    }
  }
  line("// {} stages, one iteration every {} clock{}; period {:.2f} ns, target {}.", s_.depth, s_.initiation_interval,
       s_.initiation_interval == 1 ? "" : "s", s_.period, model_.target());
  line("//");
  line("// An iteration is issued (fire) when all it reads is there and every output has room for it. From then on it");
  line("// moves one stage a clock and never stops: values of stage 3 are named ..._s3 once they have left the stage");
  line("// that made them. State changes only where the stage's valid bit is set.");
  line("//");
  line("// UNUSED is waived because a narrow user may take some bits only of a value, a token or a scalar.");
  line("// UNSIGNED and CMPCONST are waived because the range of its operands may decide a comparison.");
  line("/* verilator lint_off UNUSED */");
  line("/* verilator lint_off UNSIGNED */");
  line("/* verilator lint_off CMPCONST */");
  line("`default_nettype none");
  line("");
}

void writer::write_control_declarations() {
  title("control");
  line("  wire fire;                // an iteration is issued in this clock");
  // Nothing is in flight at power-up: memories keep the contents that they were given.
  line("  reg [{}:1] valid = {};  // which stages hold an iteration", plan_.last_valid, literal(plan_.last_valid, 0));
  line("  reg [{}:0] hold;           // clocks until the next issue may come", hold_bits() - 1);
  line("  reg holding;");
  line("  reg resetting;            // what was in flight at a reset leaves the pipeline");
  // 0 at power-up, as valid is: an iteration issued before the first reset could change what only power-up sets.
  line("  reg may_issue = 1'b0;     // not holding, and outputs have room");
}

void writer::write_inputs() {
  for (std::size_t i = 0; i < g_.ports.size(); ++i) {
    const dataflow::port& port = g_.ports[i];
    if (!port.input) continue;
    const std::string& name = port_name_[i];
    if (is_sampled(port)) {
      write_sampled_arguments(name);
      continue;
    }
    // Neither tready nor a clock enable of the tokens hangs on the decision to issue, which is known last of all.
    title(fmt::format("input {}: two registers, filled and read in turn", port.name));
    std::string token;
    for (std::size_t f = port.fields.size(); f-- > 0;) {
      if (!token.empty()) token += ", ";
      token += signal_name(port, port.fields[f].signal);
    }
    if (port.fields.size() > 1) token = "{" + token + "}";
    write_buffer(name, port.width, token, signal_name(port, "tvalid"),
                 need_register(static_cast<dataflow::port_id>(i)).has_value());
    line("  assign {} = {}_ready;", signal_name(port, "tready"), name);
  }
}

/// Two registers, filled and read in turn: neither side's flip-flops hang on what the other side does in this clock.
/// Takes over `token` where `offered` and STEM_ready are 1, gives it as STEM_token while STEM_there is 1, until
/// STEM_take, which is assigned elsewhere.
void writer::write_buffer(const std::string& stem, unsigned width, const std::string& token, const std::string& offered,
                          bool foreseen) {
  const std::string range = range_of(width);
  line("  reg {0}{1}_first, {1}_second;", range, stem);
  line("  reg {0}_fills_second, {0}_reads_second;", stem);
  line("  reg {0}_there, {0}_ready;", stem);
  if (foreseen) line("  reg {}_served;  // the next iteration does not wait for this input", stem);
  line("  wire {}_take;", stem);
  line("  wire {0}_push = {1} & {0}_ready;", stem, offered);
  line("  wire {0}{1}_token = {1}_reads_second ? {1}_second : {1}_first;", range, stem);
  line("  always @(posedge clk) begin");
  line("    if ({0}_ready & ~{0}_fills_second) {0}_first <= {1};", stem, token);
  line("    if ({0}_ready & {0}_fills_second) {0}_second <= {1};", stem, token);
  line("    {0}_fills_second <= {0}_fills_second ^ {0}_push;", stem);
  line("    {0}_reads_second <= {0}_reads_second ^ {0}_take;", stem);
  line("    {0}_there <= {0}_push | ({0}_there & ~({0}_ready & {0}_take));", stem);
  line("    {0}_ready <= ~({0}_there & ~{0}_take & ({0}_push | ~{0}_ready));", stem);
  line("    if (rst) begin");
  for (const char* flag : {"fills_second", "reads_second", "there", "ready"}) line("      {}_{} <= 1'b0;", stem, flag);
  line("    end");
  line("  end");
}

void writer::write_sampled_arguments(const std::string& name) {
  const register_map map = make_register_map(g_);
  title("arguments: registers behind an AXI4-Lite slave, sampled when a call starts");
  std::string signals, waiting;
  for (const rtl_port& port : interface_) {
    if (port.kind != "axi_lite") continue;
    const auto connect = [&](const std::string& signal) { signals += fmt::format("    .{0}({0}),\n", signal); };
    for (const rtl_field& f : port.fields) connect(f.rtl);
    connect(port.valid);
    connect(port.ready);
  }
  for (std::size_t i = 0; i < g_.ports.size(); ++i) {
    if (!g_.ports[i].input || is_sampled(g_.ports[i])) continue;
    waiting += (waiting.empty() ? "" : " | ") + port_name_[i] + "_there";
  }
  const std::string range = range_of(map.argument_bits);
  line("  wire {}{}_registers;", range, name);
  line("  reg {}{}_token;", range, name);
  line("  reg {}_there;", name);
  line("  wire {0}_take, {0}_start, {0}_hold, {0}_keep;", name);
  line("  wire {}_wanted;  // the next iteration begins a call", name);
  if (waiting.empty()) {
    line("  wire {0}_sample = {0}_wanted & ~{0}_there & {0}_start;", name);
  } else {
    line("  wire {0}_sample = {0}_wanted & ~{0}_there & ({0}_start | (~{0}_hold & ({1})));", name, waiting);
  }
  line("  {} {}_slave (\n    .clk(clk),\n    .rst(rst),", map.module(), name);
  out_ += signals;
  line("    .started({}_sample),", name);
  for (const char* bit : {"start", "hold", "keep"}) line("    .{0}({1}_{0}),", bit, name);
  line("    .arguments({}_registers)\n  );", name);
  line("  always @(posedge clk) begin");
  line("    if ({0}_sample & ~{0}_keep) {0}_token <= {0}_registers;", name);
  line("    {0}_there <= {0}_sample | ({0}_there & ~{0}_take);", name);
  line("    if (rst) begin");
  line("      {}_token <= {};", name, literal(map.argument_bits, 0));
  line("      {}_there <= 1'b0;", name);
  line("    end");
  line("  end");
}

void writer::declare_register(register_id r) {
  const dataflow::register_state& state = g_.registers[r];
  const std::string at_power_up =
      state.initial && !is_reset(g_, s_, r) ? fmt::format(" = {}", literal(*state.initial)) : std::string();
  line("  reg {}{}{};{}", range_of(state.width), register_name_[r], at_power_up, comment(state.where));
}

void writer::write_settled() {
  std::vector<node_id> logic;
  for (node_id id = 0; id < g_.nodes.size(); ++id) {
    if (s_.stage[id] == settled && g_.nodes[id].kind != operation::constant &&
        g_.nodes[id].kind != operation::register_value) {
      logic.push_back(id);
    }
  }
  bool any = !logic.empty();
  for (register_id r = 0; r < g_.registers.size(); ++r) any |= s_.register_stage[r] == settled;
  if (!any) return;
  title("values that change only while no iteration is in flight");
  for (register_id r = 0; r < g_.registers.size(); ++r) {
    if (s_.register_stage[r] == settled) declare_register(r);
  }
  std::vector<node_id> clocked;
  for (const node_id id : logic) {
    const node& n = g_.nodes[id];
    if (inlined_[id]) continue;
    if (schedule::is_settled_register(g_, s_, id)) {
      line("  reg {}{};{}", range_of(n.width), node_name_[id], comment(n.where));
      clocked.push_back(id);
    } else {
      write_node(id);
    }
  }
  if (clocked.empty()) return;
  line("  always @(posedge clk) begin");
  for (const node_id id : clocked) {
    const node& n = g_.nodes[id];
    const bool quotient = n.kind == operation::divide_unsigned || n.kind == operation::divide_signed;
    const bool remainder = n.kind == operation::remainder_unsigned || n.kind == operation::remainder_signed;
    line("    {} <= {};", node_name_[id], expression(id).text);
    if (quotient || remainder) {
      const std::string by_zero = quotient ? fmt::format("{{{}{{1'b1}}}}", n.width) : whole(n.operands[0], settled);
      line("    if ({} == {}) {} <= {};", operand(n.operands[1], settled), literal(n.width, 0), node_name_[id],
           by_zero);
    }
  }
  line("  end");
}

void writer::write_memory_declarations() {
  const auto style = [](storage_kind kind) {
    return kind == storage_kind::block ? "ram_style = \"block\"" : "ram_style = \"distributed\"";
  };
  if (!g_.memories.empty()) title("memories: never reset, and not read before they are written");
  for (std::size_t m = 0; m < g_.memories.size(); ++m) {
    const dataflow::memory& memory = g_.memories[m];
    const memory_plan& p = plan_.memories[m];
    line("  (* {}{} *)", style(p.storage), p.never_meets ? ", no_rw_check" : "");
    line("  reg {}{} [0:{}];{}", range_of(memory.width), memory_name_[m], memory.words - 1, comment(memory.where));
    if (!memory.initial.empty()) write_contents(memory_name_[m], memory.initial);
  }
  if (!g_.tables.empty()) title("constant tables");
  for (std::size_t t = 0; t < g_.tables.size(); ++t) {
    const dataflow::table& table = g_.tables[t];
    std::vector<llvm::APInt> values = table.values;
    values.resize(std::bit_ceil(values.size()), llvm::APInt(table.width, 0));
    if (model_.storage(table) == storage_kind::block) line("  (* rom_style = \"block\" *)");
    line("  reg {}{} [0:{}];{}", range_of(table.width), table_name_[t], values.size() - 1, comment(table.where));
    write_contents(table_name_[t], values);
  }
}

void writer::write_contents(const std::string& name, const std::vector<llvm::APInt>& values) {
  // Runs of one value are loops: a wide memory of zeros, word by word, would take Verilator's compiler minutes.
  constexpr std::size_t shortest_loop = 5;
  const auto run_end = [&](std::size_t begin) {
    std::size_t end = begin + 1;
    while (end < values.size() && values[end] == values[begin]) ++end;
    return end;
  };
  bool loops = false;
  for (std::size_t i = 0; i < values.size(); i = run_end(i)) loops |= run_end(i) - i >= shortest_loop;
  if (loops) {
    line("  initial begin : {}", fresh(name + "_contents"));
    line("    integer i;");
  } else {
    line("  initial begin");
  }
  for (std::size_t i = 0; i < values.size();) {
    const std::size_t end = run_end(i);
    const std::string value = literal(values[i]);
    if (end - i >= shortest_loop) {
      line("    for (i = {}; i < {}; i = i + 1) {}[i] = {};", i, end, name, value);
    } else {
      for (std::size_t word = i; word < end; ++word) line("    {}[{}] = {};", name, word, value);
    }
    i = end;
  }
  line("  end");
}

void writer::write_copies(int stage) {
  // Flip-flops that hold in this stage what the stage before had; delay lines that end here.
  move_list moves;
  for (node_id id = 0; id < g_.nodes.size(); ++id) {
    for (const wait_step& step : plan_.waits[id]) {
      if (step.line >= 0 || stage <= step.from || stage > step.to) continue;
      const std::string name = stage_name(node_name_[id], stage);
      const auto all = plan_.value_copies.find({id, stage});
      write_flip_flops(
          {name, g_.nodes[id].width}, all == plan_.value_copies.end() ? copies{{0}} : all->second,
          [&] { return whole(id, stage - 1); }, moves);
    }
  }
  if (stage <= plan_.last_valid) {
    const copies& all = plan_.valid_copies[stage];
    for (std::size_t copy = 1; copy < all.count(); ++copy) {
      reader_ = all.first_reader[copy];
      write_copy(copy_name(fmt::format("valid_s{}", stage), copy), 1, valid(stage - 1));
    }
  }
  for (const auto& [place, all] : plan_.update_bits) {
    if (place.second != stage) continue;
    const auto source = [&] { return fmt::format("{} & {}", valid(stage - 1), operand(place.first, stage - 1)); };
    // Its copies are 0 at power-up, too: nothing changes state before the first reset.
    write_flip_flops({update_name_.at(place), 1, g_.nodes[place.first].where, true}, all, source, moves);
  }
  reader_ = 0;
  for (std::size_t i = 0; i < plan_.lines.size(); ++i) {
    const delay_line& l = plan_.lines[i];
    if (l.to != stage) continue;
    const bool block = l.storage == storage_kind::block;
    const std::string& name = line_name_[i];
    line("  (* ram_style = \"{}\", no_rw_check *)", block ? "block" : "distributed");
    line("  reg {}{} [0:{}];", range_of(l.width), name, l.words() - 1);
    if (block) line("  reg {}{}_q;", range_of(l.width), name);
    std::string data;
    for (std::size_t v = l.values.size(); v-- > 0;) {
      const node_id id = l.values[v];
      line("  reg {}{};", range_of(g_.nodes[id].width), stage_name(node_name_[id], stage));
      if (!data.empty()) data += ", ";
      data += whole(id, l.from);
    }
    if (l.values.size() > 1) data = "{" + data + "}";
    std::string target;
    for (std::size_t v = l.values.size(); v-- > 0;) {
      if (!target.empty()) target += ", ";
      target += stage_name(node_name_[l.values[v]], stage);
    }
    if (l.values.size() > 1) target = "{" + target + "}";
    moves.emplace_back(fmt::format("{}[delay_{}_in]", name, l.words()), data);
    const std::string word = fmt::format("{}[delay_{}_out]", name, l.words());
    if (block) {
      moves.emplace_back(name + "_q", word);
      moves.emplace_back(target, name + "_q");
    } else {
      moves.emplace_back(target, word);
    }
  }
  // Words of block RAMs and tables whose address stood two stages earlier.
  for (std::size_t m = 0; m < g_.memories.size(); ++m) {
    if (plan_.memories[m].storage != storage_kind::block) continue;
    for (const read_port& port : plan_.memories[m].reads) {
      if (port.stage + 2 != stage) continue;
      const std::string first = node_name_[port.reads[0]];
      for (const node_id id : port.reads) {
        line("  reg {}{};{}", range_of(g_.nodes[id].width), node_name_[id], comment(g_.nodes[id].where));
        moves.emplace_back(node_name_[id], first + "_q");
      }
    }
  }
  for (node_id id = 0; id < g_.nodes.size(); ++id) {
    const node& n = g_.nodes[id];
    if (n.kind != operation::table || s_.available[id] == s_.stage[id] || s_.available[id] != stage) continue;
    line("  reg {}{};{}", range_of(n.width), node_name_[id], comment(n.where));
    moves.emplace_back(node_name_[id], node_name_[id] + "_q");
  }
  write_moves(moves);
}

void writer::write_copy(const std::string& name, unsigned width, const std::string& source) {
  has_copies_ = true;
  line("  wire {}{};", range_of(width), name);
  line("  epiline_copy #(.WIDTH({})) {}_register (.clk(clk), .d({}), .q({}));", width, name, source, name);
}

void writer::write_node(node_id id) {
  reader_ = id;
  const node& n = g_.nodes[id];
  const int stage = s_.stage[id];
  const std::string& name = node_name_[id];
  const std::string range = range_of(n.width);
  const std::string note = comment(n.where);
  switch (n.kind) {
    case operation::constant:
    case operation::register_value:
    case operation::write:
    case operation::memory_write:
      return;
    case operation::read: {
      const std::string token = port_name_[n.object] + "_token";
      if (is_always(n.operands[0])) {
        line("  wire {}{} = {};{}", range, name, token, note);
      } else {
        line("  wire {}{} = {} ? {} : {};{}", range, name, operand(n.operands[0], stage), token, literal(n.width, 0),
             note);
      }
      return;
    }
    case operation::memory_read:
      if (plan_.memories[n.object].storage != storage_kind::block) {
        line("  wire {}{} = {}[{}];{}", range, name, memory_name_[n.object],
             index(n.operands[0], stage, g_.memories[n.object].words), note);
      }
      return;
    case operation::table: {
      const dataflow::table& table = g_.tables[n.object];
      const std::uint64_t words = std::bit_ceil(table.values.size());
      const unsigned needed = bits_for(words - 1);
      const unsigned width = g_.nodes[n.operands[0]].width;
      std::string word = fmt::format("{}[{}]", table_name_[n.object], index(n.operands[0], stage, words));
      if (width > needed) {  // past the end
        word =
            fmt::format("({} == {}) ? {} : {}", part(at(n.operands[0], stage), n.operands[0], needed, width - needed),
                        literal(width - needed, 0), word, literal(n.width, 0));
      }
      if (s_.available[id] == stage) {
        line("  wire {}{} = {};{}", range, name, word, note);
      } else {
        line("  reg {}{}_q;", range, name);
        line("  always @(posedge clk) {}_q <= {};", name, word);
      }
      return;
    }
    case operation::add_or_subtract:
      adds_or_subtracts_ = true;
      line("  wire {}{};{}", range, name, note);
      line("  epiline_add_or_subtract #(.WIDTH({})) {} (.a({}), .b({}), .subtract({}), .total({}));", n.width,
           fresh(name + "_adder"), whole(n.operands[0], stage), whole(n.operands[1], stage),
           whole(n.operands[2], stage), name);
      return;
    case operation::divide_unsigned:
    case operation::divide_signed:
    case operation::remainder_unsigned:
    case operation::remainder_signed: {
      const bool quotient = n.kind == operation::divide_unsigned || n.kind == operation::divide_signed;
      line("  wire {}{}_exact = {};", range, name, expression(id).text);
      const std::string by_zero = quotient ? fmt::format("{{{}{{1'b1}}}}", n.width) : operand(n.operands[0], stage);
      line("  wire {}{} = ({} == {}) ? {} : {}_exact;{}", range, name, operand(n.operands[1], stage),
           literal(n.width, 0), by_zero, name, note);
      return;
    }
    default:
      break;
  }
  line("  wire {}{} = {};{}", range, name, expression(id).text, note);
}

void writer::write_logic(int stage) {
  for (const node_id id : nodes_at_[stage]) {
    if (!inlined_[id]) write_node(id);
  }
  // Addresses of block RAMs: the word leaves the RAM a clock later and its register another clock later.
  for (std::size_t m = 0; m < g_.memories.size(); ++m) {
    if (plan_.memories[m].storage != storage_kind::block) continue;
    for (const read_port& port : plan_.memories[m].reads) {
      if (port.stage != stage) continue;
      const std::string& name = node_name_[port.reads[0]];
      reader_ = port.reads[0];
      line("  reg {}{}_q;{}", range_of(g_.memories[m].width), name, comment(g_.nodes[port.reads[0]].where));
      line("  always @(posedge clk) {}_q <= {}[{}];", name, memory_name_[m],
           index(port.address, stage, g_.memories[m].words));
    }
  }
}

/// The register that says whether the next iteration reads a token of `port`, if there is one whose next value is known
/// when an iteration is issued.
std::optional<node_id> writer::need_register(dataflow::port_id port) const {
  std::optional<node_id> need;
  for (const node& n : g_.nodes) {
    if (n.kind != operation::read || n.object != port) continue;
    const node& predicate = g_.nodes[n.operands[0]];
    if (need || predicate.kind != operation::register_value) return std::nullopt;
    if (s_.register_stage[predicate.object] != 0 || s_.register_update[predicate.object] != 0) return std::nullopt;
    need = n.operands[0];
  }
  return need;
}

void writer::write_issue() {
  std::string conditions = "may_issue";
  for (std::size_t i = 0; i < g_.ports.size(); ++i) {
    if (!g_.ports[i].input) continue;
    const auto port = static_cast<dataflow::port_id>(i);
    const std::string& name = port_name_[i];
    std::string take;
    bool always = false;
    for (const node& n : g_.nodes) {
      if (n.kind != operation::read || n.object != port) continue;
      always |= is_always(n.operands[0]);
      if (!take.empty()) take += " | ";
      take += operand(n.operands[0], 0);
    }
    if (take.empty()) take = "1'b0";
    line("  assign {}_take = fire & ({});", name, take);
    if (is_sampled(g_.ports[i])) line("  assign {}_wanted = ~holding & ({});", name, take);
    const std::optional<node_id> need = is_sampled(g_.ports[i]) ? std::nullopt : need_register(port);
    if (always) {
      conditions += fmt::format("\n    & {}_there", name);
    } else if (need) {
      // A flip-flop of its own says whether this input is waited for: the issue is one gate behind flip-flops.
      const dataflow::register_state& r = g_.registers[g_.nodes[*need].object];
      const std::string now = operand(*need, 0);
      const std::string later = is_always(r.enable)
                                    ? operand(r.next, 0)
                                    : fmt::format("({} ? {} : {})", operand(r.enable, 0), operand(r.next, 0), now);
      line("  always @(posedge clk) begin");
      line("    {0}_served <= fire ? {0}_push | ({0}_there & ~({0}_ready & {1})) | {2}", name, now, inverted(later));
      line("      : {0}_push | {0}_there | {1};", name, inverted(now));
      line("  end");
      conditions += fmt::format("\n    & {}_served", name);
    } else if (take != "1'b0") {
      conditions += fmt::format("\n    & ({}_there | ~({}))", name, take);
    }
  }
  line("  assign fire = {};", conditions);

  const unsigned width = hold_bits();
  const int after_any = s_.initiation_interval - 1;
  const bool waits = g_.patient != none && s_.hold > 0;
  const std::string longest = literal(width, most_hold());
  std::string after = longest;
  std::string starts = after_any > 0 ? "fire | " : "";
  if (waits && after_any == 0) {
    starts = fmt::format("(fire & {}) | ", operand(g_.patient, 0));  // `hold` counts for nothing unless `holding`
  } else if (waits) {
    after = fmt::format("({} ? {} : {})", operand(g_.patient, 0), longest, literal(width, after_any));
  }
  std::string room;
  for (const output_fifo& f : plan_.fifos) room += fmt::format(" & {}_room", port_name_[f.port]);
  line("  wire holding_next = {}(holding & (hold != {}));", starts, literal(width, 1));
  line("  always @(posedge clk) begin");
  if (starts.empty()) {
    line("    hold <= hold - {};", literal(width, 1));
  } else {
    line("    hold <= fire ? {} : hold - {};", after, literal(width, 1));
  }
  line("    holding <= holding_next;");
  line("    may_issue <= ~holding_next{};", room);
  line("    resetting <= resetting & (hold != {});", literal(width, after_state_reset));
  line("    if (rst) begin");
  line("      hold <= {};", literal(width, reset_clocks()));
  line("      holding <= 1'b1;");
  line("      may_issue <= 1'b0;");
  line("      resetting <= 1'b1;");
  line("    end");
  line("  end");
}

void writer::write_state(int stage) {
  const std::vector<register_id>& here = updates_at_[stage];
  if (here.empty()) return;
  struct group {  // registers that the same signals enable
    std::string when, enable;
    std::vector<register_id> registers;
  };
  std::vector<group> groups;  // in order of appearance
  std::map<std::pair<std::string, std::string>, std::size_t> group_of;
  const auto read_by = [&](register_id r) { reader_ = static_cast<schedule::reader>(g_.nodes.size() + r); };
  for (const register_id r : here) {
    read_by(r);
    const node_id condition = g_.registers[r].enable;
    std::string when = update_bit(condition, stage);
    std::string enable;
    if (when.empty()) {
      when = valid(stage);
      if (!is_always(condition)) enable = whole(condition, stage);
    }
    const auto [found, fresh_group] = group_of.try_emplace({when, enable}, groups.size());
    if (fresh_group) groups.push_back({when, enable, {}});
    groups[found->second].registers.push_back(r);
  }
  const auto target = [&](register_id r) {
    return s_.register_stage[r] == settled ? pending_name_[r] : register_name_[r];
  };
  for (const register_id r : here) {
    if (s_.register_stage[r] == settled) line("  reg {}{};", range_of(g_.registers[r].width), pending_name_[r]);
  }
  line("  always @(posedge clk) begin");
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const group& now = groups[i];
    if (i == 0 || groups[i - 1].when != now.when) line("    if ({}) begin", now.when);
    const bool conditional = !now.enable.empty();
    if (conditional) line("      if ({}) begin", now.enable);
    for (const register_id r : now.registers) {
      read_by(r);
      line("      {}{} <= {};{}", conditional ? "  " : "", target(r), whole(g_.registers[r].next, stage),
           comment(g_.registers[r].where));
    }
    if (conditional) line("      end");
    if (i + 1 == groups.size() || groups[i + 1].when != now.when) line("    end");
  }
  std::string open;  // the reset whose block is open
  for (const register_id r : here) {
    if (!is_reset(g_, s_, r)) continue;
    read_by(r);
    const std::string reset = state_reset();
    if (reset != open) {
      if (!open.empty()) line("    end");
      line("    if ({}) begin", reset);
      open = reset;
    }
    line("      {} <= {};", target(r), literal(*g_.registers[r].initial));
  }
  if (!open.empty()) line("    end");
  reader_ = 0;
  line("  end");
}

void writer::write_memory_writes(int stage) {
  for (std::size_t m = 0; m < g_.memories.size(); ++m) {
    const memory_plan& p = plan_.memories[m];
    if (p.writes.empty() || s_.stage[p.writes[0]] != stage) continue;
    const std::string& name = memory_name_[m];
    const std::uint64_t words = g_.memories[m].words;
    reader_ = p.writes[0];
    const auto enable = [&](node_id id) {
      const node_id e = g_.nodes[id].operands[2];
      return is_always(e) ? valid(stage) : fmt::format("{} & {}", valid(stage), operand(e, stage));
    };
    if (p.writes.size() == 1 || !p.exclusive_writes) {
      line("  always @(posedge clk) begin{}", comment(g_.nodes[p.writes[0]].where));
      for (const node_id id : p.writes) {
        const node& n = g_.nodes[id];
        line("    if ({}) {}[{}] <= {};", enable(id), name, index(n.operands[0], stage, words),
             whole(n.operands[1], stage));
      }
      line("  end");
      continue;
    }
    // At most one is enabled: one write port.
    std::string any, address, data;
    for (const node_id id : p.writes) {
      const node& n = g_.nodes[id];
      const std::string e = operand(n.operands[2], stage);
      any += (any.empty() ? "" : " | ") + e;
      if (id == p.writes.back()) {
        address += index(n.operands[0], stage, words);
        data += operand(n.operands[1], stage);
      } else {
        address += fmt::format("{} ? {} : ", e, index(n.operands[0], stage, words));
        data += fmt::format("{} ? {} : ", e, operand(n.operands[1], stage));
      }
    }
    const std::string port = fresh(name + "_write");
    const std::string port_address = fresh(name + "_write_address");
    const std::string port_data = fresh(name + "_write_data");
    line("  wire {} = {} & ({});", port, valid(stage), any);
    line("  wire {}{} = {};", range_of(bits_for(words - 1)), port_address, address);
    line("  wire {}{} = {};", range_of(g_.memories[m].width), port_data, data);
    line("  always @(posedge clk) begin");
    line("    if ({}) {}[{}] <= {};", port, name, port_address, port_data);
    line("  end");
  }
}

void writer::write_stage(int stage) {
  title(fmt::format("stage {}", stage));
  for (const register_id r : registers_at_[stage]) declare_register(r);
  write_copies(stage);
  write_logic(stage);
  if (stage == 0) write_issue();
  write_state(stage);
  write_memory_writes(stage);
}

void writer::write_patient() {
  std::vector<register_id> patient;
  for (register_id r = 0; r < g_.registers.size(); ++r) {
    if (s_.register_stage[r] == settled) patient.push_back(r);
  }
  if (patient.empty()) return;
  title("registers that wait for the pipeline to drain");
  line("  wire commit = holding & (hold == {});", literal(hold_bits(), settle_clocks() + 1));
  line("  always @(posedge clk) begin");
  line("    if (commit) begin");
  for (const register_id r : patient) line("      {} <= {};", register_name_[r], pending_name_[r]);
  line("    end");
  std::string resets;
  for (const register_id r : patient) {
    if (!g_.registers[r].initial) continue;
    fmt::format_to(std::back_inserter(resets), "      {} <= {};\n", register_name_[r],
                   literal(*g_.registers[r].initial));
  }
  if (!resets.empty()) {
    line("    if ({}) begin", state_reset());
    out_ += resets;
    line("    end");
  }
  line("  end");
}

void writer::write_valids() {
  title("valid bits");
  const std::string before = plan_.last_valid > 1 ? fmt::format("{{valid[{}:1], fire}}", plan_.last_valid - 1) : "fire";
  line("  always @(posedge clk) valid <= {};", before);
}

void writer::write_outputs() {
  for (std::size_t i = 0; i < g_.ports.size(); ++i) {
    const dataflow::port& port = g_.ports[i];
    if (port.input) continue;
    const auto found = std::find_if(plan_.fifos.begin(), plan_.fifos.end(),
                                    [&](const output_fifo& f) { return f.port == static_cast<dataflow::port_id>(i); });
    const std::string& name = port_name_[i];
    if (found == plan_.fifos.end()) {  // nothing is ever written
      title(fmt::format("output {}: never written", port.name));
      line("  assign {} = 1'b0;", signal_name(port, "tvalid"));
      for (const dataflow::field& f : port.fields) {
        line("  assign {} = {};", signal_name(port, f.signal), literal(f.width, 0));
      }
      continue;
    }
    const output_fifo& fifo = *found;
    const unsigned pointer = bits_for(fifo.depth - 1);
    const unsigned counter = pointer + 1;
    const int stage = fifo.stage;
    std::string pushes, data;
    bool always = false;
    for (const node_id id : fifo.writes) {
      const node& n = g_.nodes[id];
      const std::string predicate = operand(n.operands[0], stage);
      always |= is_always(n.operands[0]);
      pushes += (pushes.empty() ? "" : " | ") + predicate;
      const bool last = id == fifo.writes.back();
      data +=
          last ? operand(n.operands[1], stage) : fmt::format("{} ? {} : ", predicate, operand(n.operands[1], stage));
    }
    line("  wire {}_push = {};", name, always ? valid(stage) : fmt::format("{} & ({})", valid(stage), pushes));
    line("  (* ram_style = \"{}\", no_rw_check *)", name_of(fifo.storage));
    line("  reg {}{}_fifo [0:{}];", range_of(port.width), name, fifo.depth - 1);
    line("  reg [{}:0] {}_in, {}_out;", counter - 1, name, name);
    line("  reg {}{}_word;", range_of(port.width), name);
    line("  reg {}_word_there, {}_left{};", name, name, always ? "" : fmt::format(", {}_skipped", name));
    // tready comes from a pin, or from somebody else's gates: only the last buffer's flags hang on it.
    const std::string end = name + "_end";
    write_buffer(end, port.width, name + "_word", name + "_word_there", false);
    line("  assign {0}_take = {0}_there & {1};", end, signal_name(port, "tready"));
    line("  wire {0}_load = ({0}_in != {0}_out) & ({1}_ready | ~{0}_word_there);", name, end);
    line("  wire {}{}_data = {};", range_of(port.width), name, data);
    // The iteration issued in this clock is not counted yet.
    line("  assign {}_room = {}_credits_next > {};", name, name, literal(counter, 1));
    line("  wire [{}:0] {}_credits_next = {}_credits - {{{}, valid[1]}} + {{{}, {}_left}}{};", counter - 1, name, name,
         literal(counter - 1, 0), literal(counter - 1, 0), name,
         always ? "" : fmt::format(" + {{{}, {}_skipped}}", literal(counter - 1, 0), name));
    line("  always @(posedge clk) begin");
    line("    if ({}_push) {}_fifo[{}_in[{}:0]] <= {}_data;", name, name, name, pointer - 1, name);
    line("    if ({}_load) {}_word <= {}_fifo[{}_out[{}:0]];", name, name, name, name, pointer - 1);
    line("    if ({}_push) {}_in <= {}_in + {};", name, name, name, literal(counter, 1));
    line("    if ({}_load) {}_out <= {}_out + {};", name, name, name, literal(counter, 1));
    line("    {0}_word_there <= {0}_load | ({0}_word_there & ~{1}_ready);", name, end);
    line("    {}_left <= {}_load;", name, name);
    if (!always) line("    {}_skipped <= {} & ~({});", name, valid(stage), pushes);
    line("    {}_credits <= {}_credits_next;", name, name);
    line("    if (resetting) begin");
    line("      {}_word_there <= 1'b0;", name);
    line("      {}_in <= {};", name, literal(counter, 0));
    line("      {}_out <= {};", name, literal(counter, 0));
    line("      {}_left <= 1'b0;", name);
    if (!always) line("      {}_skipped <= 1'b0;", name);
    line("      {}_credits <= {};", name, literal(counter, fifo.depth));
    line("    end");
    line("  end");
    line("  assign {} = {}_there;", signal_name(port, "tvalid"), end);
    for (const dataflow::field& f : port.fields) {
      const std::string bits = f.width == port.width ? end + "_token"
                               : f.width == 1        ? fmt::format("{}_token[{}]", end, f.offset)
                                              : fmt::format("{}_token[{}:{}]", end, f.offset + f.width - 1, f.offset);
      line("  assign {} = {};", signal_name(port, f.signal), bits);
    }
  }
}

void writer::write_delay_pointers() {
  std::map<int, bool> lengths;
  for (const delay_line& l : plan_.lines) lengths[l.words()] = true;
  if (lengths.empty()) return;
  title("pointers of the delay lines: a word is read just before its place is written again");
  for (const auto& [words, used] : lengths) {
    const unsigned width = bits_for(words - 1);
    line("  reg {}delay_{}_in, delay_{}_out;", range_of(width), words, words);
  }
  line("  always @(posedge clk) begin");
  for (const auto& [words, used] : lengths) {
    const unsigned width = bits_for(words - 1);
    line("    delay_{}_in <= delay_{}_out;", words, words);
    line("    delay_{}_out <= (delay_{}_out == {}) ? {} : delay_{}_out + {};", words, words, literal(width, words - 1),
         literal(width, 0), words, literal(width, 1));
  }
  line("    if (resetting) begin");
  for (const auto& [words, used] : lengths) {
    const unsigned width = bits_for(words - 1);
    line("      delay_{}_in <= {};", words, literal(width, 0));
    line("      delay_{}_out <= {};", words, literal(width, 1));
  }
  line("    end");
  line("  end");
}

std::string writer::write() {
  reserve_interface();
  for (const delay_line& l : plan_.lines) {
    taken_.insert(fmt::format("delay_{}_in", l.words()));
    taken_.insert(fmt::format("delay_{}_out", l.words()));
  }
  choose_names();
  choose_inlined();
  nodes_at_.resize(s_.depth);
  registers_at_.resize(s_.depth);
  updates_at_.resize(s_.depth);
  for (node_id id = 0; id < g_.nodes.size(); ++id) {
    if (s_.stage[id] != settled) nodes_at_[s_.stage[id]].push_back(id);
  }
  for (register_id r = 0; r < g_.registers.size(); ++r) {
    if (s_.register_stage[r] != settled) registers_at_[s_.register_stage[r]].push_back(r);
    updates_at_[s_.register_update[r]].push_back(r);
  }
  write_heading();
  out_ += module_head(g_, interface_);
  write_control_declarations();
  for (const output_fifo& f : plan_.fifos) {
    const unsigned counter = bits_for(f.depth - 1) + 1;
    line("  reg [{}:0] {}_credits;  // places of the FIFO that nothing in flight may need", counter - 1,
         port_name_[f.port]);
    line("  wire {}_room;", port_name_[f.port]);
  }
  write_inputs();
  write_reset_rows();
  write_settled();
  write_memory_declarations();
  write_delay_pointers();
  for (int stage = 0; stage < s_.depth; ++stage) write_stage(stage);
  write_valids();
  write_patient();
  if (!plan_.fifos.empty()) title("outputs: a FIFO with room for all iterations in flight");
  write_outputs();
  line("\nendmodule\n");
  if (options_.axi_lite) line("{}", emit_axi_lite_slave(make_register_map(g_)));
  if (adds_or_subtracts_) line("{}", add_or_subtract_module);
  if (has_copies_) line("{}", copy_module);
  line("`default_nettype wire");
  return std::move(out_);
}

/// The line of a node and those of the operands whose text is part of its own.
void writer::collect_lines(node_id id, std::vector<dataflow::source_location>& lines) const {
  const node& n = g_.nodes[id];
  const bool is_new = std::none_of(lines.begin(), lines.end(), [&](const dataflow::source_location& known) {
    return known.file == n.where.file && known.line == n.where.line;
  });
  if (is_new && n.where.line != 0) lines.push_back(n.where);
  for (const node_id operand : n.operands) {
    if (inlined_[operand]) collect_lines(operand, lines);
  }
}

std::vector<signal> writer::signals() const {
  std::vector<signal> all = interface_signals(g_.name, interface_);
  const auto control = [&](const char* name, const char* what, unsigned width) {
    all.push_back({name, "control", what, width, -1, {}});
  };
  control("fire", "1 when an iteration is issued", 1);
  control("valid", "which stages hold an iteration", 0);
  control("hold", "clocks until the next issue may come", 0);
  control("holding", "1 while no issue may come", 1);
  control("holding_next", "the next value of 'holding'", 1);
  control("may_issue", "1 when nothing but missing tokens keeps the next iteration from being issued", 1);
  control("resetting", "1 after a reset until what was in flight has left the pipeline", 1);
  control("commit", "1 when registers that wait for the pipeline change", 1);
  if (plan_.has_reset_rows()) {
    control("early_state_reset", "the reset on its way to the state", 1);
    control("state_reset", "the reset of the state", 1);
  }
  for (std::size_t i = 0; i < g_.ports.size(); ++i) {
    const dataflow::port& port = g_.ports[i];
    all.push_back({port_name_[i], "port", port.input ? "input" : "output", port.width, -1, {port.where}});
  }
  if (options_.axi_lite) {
    const register_map map = make_register_map(g_);
    all.push_back({map.module(), "control", "the AXI4-Lite slave in front of the arguments", 0, -1, {}});
    for (const argument_register& argument : map.arguments) {
      const std::string what = fmt::format("argument '{}' behind the AXI4-Lite slave", argument.name);
      all.push_back({"argument_" + argument.name, "register", what, 0, -1, {}});
    }
    for (const char* inside :
         {"aw_there", "aw_waits", "w_there", "w_waits", "ar_there", "ar_waits", "write", "read", "write_word",
          "write_data", "write_strobe", "read_word", "calls", "arguments", "started", "start", "keep"}) {
      control(inside, "inside the AXI4-Lite slave", 0);
    }
  }
  for (register_id r = 0; r < g_.registers.size(); ++r) {
    const dataflow::register_state& state = g_.registers[r];
    std::vector<dataflow::source_location> lines;
    if (state.where.line != 0) lines.push_back(state.where);
    if (g_.nodes[state.next].kind != operation::constant) collect_lines(state.next, lines);
    all.push_back({register_name_[r], "register", "", state.width, s_.register_stage[r], std::move(lines)});
    if (!pending_name_[r].empty() && pending_name_[r] != register_name_[r] + "_pending") {
      all.push_back({pending_name_[r], "register", "its next value", state.width, -1, {state.where}});
    }
  }
  for (std::size_t m = 0; m < g_.memories.size(); ++m) {
    const dataflow::memory& memory = g_.memories[m];
    all.push_back({memory_name_[m], "memory", fmt::format("{} words", memory.words), memory.width, -1, {memory.where}});
  }
  for (std::size_t t = 0; t < g_.tables.size(); ++t) {
    const dataflow::table& table = g_.tables[t];
    const std::string words = fmt::format("{} words", table.values.size());
    all.push_back({table_name_[t], "table", words, table.width, -1, {table.where}});
  }
  for (std::size_t i = 0; i < plan_.lines.size(); ++i) {
    const delay_line& line = plan_.lines[i];
    std::vector<dataflow::source_location> lines;
    for (const node_id id : line.values) collect_lines(id, lines);
    const std::string what = fmt::format("values that wait from stage {} to {}", line.from, line.to);
    all.push_back({line_name_[i], "delay line", what, line.width, line.to, std::move(lines)});
  }
  std::set<int> lengths;
  for (const delay_line& line : plan_.lines) lengths.insert(line.words());
  for (const int words : lengths) {
    const std::string what = fmt::format("pointer of the delay lines of {} words", words);
    for (const char* end : {"in", "out"}) {
      all.push_back({fmt::format("delay_{}_{}", words, end), "control", what, bits_for(words - 1), -1, {}});
    }
  }
  for (node_id id = 0; id < g_.nodes.size(); ++id) {
    const node& n = g_.nodes[id];
    if (node_name_[id].empty() || n.kind == operation::register_value) continue;
    if (inlined_[id] && plan_.waits[id].empty()) continue;  // its text is part of others'
    std::vector<dataflow::source_location> lines;
    collect_lines(id, lines);
    all.push_back({node_name_[id], "value", dataflow::name_of(n.kind), n.width, s_.stage[id], std::move(lines)});
  }
  return all;
}

}  // namespace

verilog_text emit_module(const graph& g, const schedule::delay_model& model, const schedule::result& s,
                         const verilog_options& options) {
  writer all(g, model, s, options);
  std::string text = all.write();
  return {std::move(text), {{g.name, g.files, all.signals()}}};
}

std::string emit_verilog(const graph& g, const schedule::delay_model& model, const schedule::result& s,
                         const verilog_options& options) {
  return emit_module(g, model, s, options).text;
}

}  // namespace epiline::emit
