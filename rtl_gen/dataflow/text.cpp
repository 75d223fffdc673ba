#include "dataflow/text.hpp"

#include <fmt/format.h>
#include <llvm/ADT/SmallString.h>

#include <algorithm>
#include <iterator>
#include <map>

#include "dataflow/text_pieces.hpp"

namespace epiline::dataflow {

namespace {

constexpr std::uint64_t max_constant_bits = std::uint64_t{1} << 31;
constexpr std::uint64_t max_memory_bits = std::uint64_t{1} << 32;
constexpr std::size_t words_a_line = 8;

const char* object_word(operation kind) {
  switch (kind) {
    case operation::read:
    case operation::write:
      return "port";
    case operation::register_value:
      return "register";
    case operation::memory_read:
    case operation::memory_write:
      return "memory";
    case operation::table:
      return "table";
    default:
      return nullptr;
  }
}

// ---------------------------------------------------------------------------------------------------- printing

class printer {
 public:
  explicit printer(const graph& g) : g_(g) {}

  std::string run() {
    put("graph {}\n", in_quotes(g_.name));
    for (const std::string& file : g_.files) put("file {}\n", in_quotes(file));
    for (const port& p : g_.ports) text_ += print_port(p);
    for (const register_state& r : g_.registers) print_register(r);
    for (const memory& m : g_.memories) {
      put("memory {} {} words {}", in_quotes(m.name), m.words, m.width);
      if (m.distance != 1) put(" distance {}", m.distance);
      if (m.distance_promised) put(" promised");
      end_line(m.where);
      print_words(m.initial);
    }
    for (const table& t : g_.tables) {
      put("table {} {}", in_quotes(t.name), t.width);
      if (t.immediate) put(" immediate");
      end_line(t.where);
      print_words(t.values);
    }
    for (node_id id = 0; id < g_.nodes.size(); ++id) print_node(id);
    if (g_.patient != none) put("patient %{}\n", g_.patient);
    return std::move(text_);
  }

 private:
  template <class... Arguments>
  void put(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Arguments>(arguments)...);
  }

  static std::string hex(const llvm::APInt& value) {
    llvm::SmallString<32> digits;
    value.toString(digits, 16, false, false, false);
    return "0x" + digits.str().str();
  }

  void end_line(const source_location& where) { text_ += place_and_end(where); }

  void print_register(const register_state& r) {
    put("register {} {}", in_quotes(r.name), r.width);
    if (r.initial) put(" initial {}{}", hex(*r.initial), r.resets ? "" : " unreset");
    put(" next %{} enable %{}", r.next, r.enable);
    if (r.patient) put(" patient");
    end_line(r.where);
  }

  void print_words(const std::vector<llvm::APInt>& words) {
    for (std::size_t i = 0; i < words.size(); ++i) {
      put("{} {}", i % words_a_line == 0 ? "  words" : "", hex(words[i]));
      if (i % words_a_line == words_a_line - 1 || i + 1 == words.size()) text_ += '\n';
    }
  }

  void print_node(node_id id) {
    const node& n = g_.nodes[id];
    put("%{} = {} {}", id, name_of(n.kind), n.width);
    if (n.kind == operation::constant) put(" {}", hex(n.value));
    if (const char* word = object_word(n.kind)) put(" {} {}", word, n.object);
    if (n.kind == operation::slice) put(" low {}", n.low);
    if (!n.operands.empty()) {
      text_ += " (";
      for (std::size_t i = 0; i < n.operands.size(); ++i) put("{}%{}", i == 0 ? "" : ", ", n.operands[i]);
      text_ += ')';
    }
    if (!n.name.empty()) put(" {}", in_quotes(n.name));
    end_line(n.where);
  }

  const graph& g_;
  std::string text_;
};

// ----------------------------------------------------------------------------------------------------- parsing

class parser {
 public:
  parser(std::string_view text, unsigned lines_before) : text_(text), number_(lines_before) {
    for (int i = 0; i <= static_cast<int>(operation::extend_sign); ++i)
      operations_[name_of(static_cast<operation>(i))] = static_cast<operation>(i);
  }

  graph run() {
    bool named = false;
    while (!text_.empty()) {
      const std::size_t length = std::min(text_.find('\n'), text_.size());
      line_reader line(text_.substr(0, length), ++number_);
      text_.remove_prefix(std::min(length + 1, text_.size()));
      if (line.at_end()) continue;
      if (!named) {
        line.need("graph");
        g_.name = line.need_string("the graph's name in quotes");
        line.need_end();
        named = true;
        continue;
      }
      parse_item(line);
    }
    if (!named) throw text_error(fmt::format("line {}: found the end of the text, expected 'graph'", number_ + 1));
    if (auto what = find_violation(g_); !what.empty())
      throw text_error(fmt::format("line {}: the graph breaks a rule: {}", number_, what));
    return std::move(g_);
  }

 private:
  /// Which list a following `field` or `words` line belongs to.
  enum class owner { nothing, port, memory, table };

  void parse_item(line_reader& line) {
    if (line.take("field")) return parse_field(line);
    if (line.take("words")) return parse_words(line);
    owner_ = owner::nothing;
    if (line.take("%")) return parse_node(line);
    if (line.take("file")) return parse_file(line);
    if (line.take("input")) return add_port(line, true);
    if (line.take("output")) return add_port(line, false);
    if (line.take("register")) return parse_register(line);
    if (line.take("memory")) return parse_memory(line);
    if (line.take("table")) return parse_table(line);
    if (line.take("patient")) {
      if (g_.patient != none) line.fail("a second 'patient', expected one at most");
      g_.patient = line.need_node();
      return line.need_end();
    }
    line.unexpected("file, input, output, field, register, memory, table, words, patient or %N");
  }

  void parse_file(line_reader& line) {
    g_.files.push_back(line.need_string("a file name in quotes"));
    line.need_end();
  }

  void add_port(line_reader& line, bool input) {
    g_.ports.push_back(parse_port(line, input));
    owner_ = owner::port;
  }

  void parse_field(line_reader& line) {
    if (owner_ != owner::port) line.fail("a field stands here, expected it after input or output");
    append_field(line, g_.ports.back());
  }

  void parse_register(line_reader& line) {
    register_state r;
    r.name = line.need_string("the register's name in quotes");
    r.width = line.need_width();
    if (line.take("initial")) {
      count_bits(line, r.width);
      r.initial = line.need_value(r.width);
      r.resets = !line.take("unreset");
    }
    line.need("next");
    r.next = line.need_node();
    line.need("enable");
    r.enable = line.need_node();
    r.patient = line.take("patient");
    r.where = line.need_place_and_end();
    g_.registers.push_back(std::move(r));
  }

  void parse_memory(line_reader& line) {
    memory m;
    m.name = line.need_string("the memory's name in quotes");
    m.words = line.need_number("a number of words", 1, none);
    line.need("words");
    m.width = line.need_width();
    if (line.take("distance")) m.distance = line.need_number("a distance", 1, none);
    m.distance_promised = line.take("promised");
    m.where = line.need_place_and_end();
    memory_bits_ += std::uint64_t{m.words} * m.width;
    if (memory_bits_ > max_memory_bits) line.fail("the memories are too large, expected at most 2^32 bits in total");
    g_.memories.push_back(std::move(m));
    owner_ = owner::memory;
  }

  void parse_table(line_reader& line) {
    table t;
    t.name = line.need_string("the table's name in quotes");
    t.width = line.need_width();
    t.immediate = line.take("immediate");
    t.where = line.need_place_and_end();
    g_.tables.push_back(std::move(t));
    owner_ = owner::table;
  }

  void parse_words(line_reader& line) {
    if (owner_ != owner::memory && owner_ != owner::table)
      line.fail("words stand here, expected them after memory or table");
    const bool of_memory = owner_ == owner::memory;
    auto& words = of_memory ? g_.memories.back().initial : g_.tables.back().values;
    const unsigned width = of_memory ? g_.memories.back().width : g_.tables.back().width;
    do {
      count_bits(line, width);
      words.push_back(line.need_value(width));
    } while (!line.at_end());
  }

  void parse_node(line_reader& line) {
    const std::uint32_t id = line.need_number("a node number", 0, none - 1);
    if (id != g_.nodes.size()) line.fail(fmt::format("found node %{}, expected %{}", id, g_.nodes.size()));
    line.need("=");
    const std::string_view kind = line.need_word("an operation");
    const auto found = operations_.find(kind);
    if (found == operations_.end()) line.fail(fmt::format("found '{}', expected an operation", kind.substr(0, 40)));
    node n;
    n.kind = found->second;
    n.width = line.need_number("a width", 0, max_width);
    if (n.kind == operation::constant) {
      if (n.width == 0) line.fail("found width 0, expected a width from 1");
      count_bits(line, n.width);
      n.value = line.need_value(n.width);
    }
    if (const char* word = object_word(n.kind)) {
      line.need(word);
      n.object = line.need_number("an object number", 0, none - 1);
    }
    if (n.kind == operation::slice) {
      line.need("low");
      n.low = line.need_number("a bit number", 0, max_width);
    }
    if (line.take("(")) {
      do n.operands.push_back(line.need_node());
      while (line.take(","));
      line.need(")");
    }
    if (line.at_string()) n.name = line.need_string("a name");
    n.where = line.need_place_and_end();
    g_.nodes.push_back(std::move(n));
  }

  /// A short text must not fill the memory of the machine with wide constants.
  void count_bits(const line_reader& line, unsigned width) {
    constant_bits_ += width;
    if (constant_bits_ > max_constant_bits)
      line.fail("the constants are too large, expected at most 2^31 bits in total");
  }

  std::string_view text_;
  unsigned number_;  // of the line
  graph g_;
  std::map<std::string_view, operation> operations_;
  owner owner_ = owner::nothing;
  std::uint64_t constant_bits_ = 0, memory_bits_ = 0;
};

}  // namespace

std::string print(const graph& g) { return printer(g).run(); }

graph parse(std::string_view text) { return parse_part(text, 0); }

graph parse_part(std::string_view text, unsigned lines_before) { return parser(text, lines_before).run(); }

}  // namespace epiline::dataflow
