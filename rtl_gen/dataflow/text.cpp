#include "dataflow/text.hpp"

#include <fmt/format.h>
#include <llvm/ADT/SmallString.h>
#include <llvm/ADT/StringExtras.h>
#include <llvm/ADT/StringRef.h>

#include <algorithm>
#include <charconv>
#include <iterator>
#include <map>

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

constexpr port_kind port_kinds[] = {port_kind::stream, port_kind::call, port_kind::result};

// ---------------------------------------------------------------------------------------------------- printing

class printer {
 public:
  explicit printer(const graph& g) : g_(g) {}

  std::string run() {
    put("graph {}\n", quoted(g_.name));
    for (const std::string& file : g_.files) put("file {}\n", quoted(file));
    for (const port& p : g_.ports) print_port(p);
    for (const register_state& r : g_.registers) print_register(r);
    for (const memory& m : g_.memories) {
      put("memory {} {} words {}", quoted(m.name), m.words, m.width);
      if (m.distance != 1) put(" distance {}", m.distance);
      if (m.distance_promised) put(" promised");
      end_line(m.where);
      print_words(m.initial);
    }
    for (const table& t : g_.tables) {
      put("table {} {}", quoted(t.name), t.width);
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

  static std::string quoted(std::string_view text) {
    std::string result = "\"";
    for (const char c : text) {
      if (c == '"' || c == '\\')
        (result += '\\') += c;
      else if (c == '\n')
        result += "\\n";
      else if (c == '\t')
        result += "\\t";
      else if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) >= 0x7f)
        result += fmt::format("\\x{:02x}", static_cast<unsigned>(static_cast<unsigned char>(c)));
      else
        result += c;
    }
    return result += '"';
  }

  static std::string hex(const llvm::APInt& value) {
    llvm::SmallString<32> digits;
    value.toString(digits, 16, false, false, false);
    return "0x" + digits.str().str();
  }

  void end_line(const source_location& where) {
    if (where.line != 0 || where.file != 0) put(" @{}:{}", where.file, where.line);
    text_ += '\n';
  }

  void print_port(const port& p) {
    put("{} {} {} {}", p.input ? "input" : "output", name_of(p.kind), quoted(p.name), p.width);
    end_line(p.where);
    for (const field& f : p.fields)
      put("  field {} {} {}{}\n", quoted(f.name), quoted(f.signal), f.width, f.is_signed ? " signed" : "");
  }

  void print_register(const register_state& r) {
    put("register {} {}", quoted(r.name), r.width);
    if (r.initial) put(" initial {}", hex(*r.initial));
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
    if (!n.name.empty()) put(" {}", quoted(n.name));
    end_line(n.where);
  }

  const graph& g_;
  std::string text_;
};

// ----------------------------------------------------------------------------------------------------- parsing

/// Reads the pieces of one line. Every `need_` function throws when something else stands there.
class line_reader {
 public:
  line_reader(std::string_view line, unsigned number) : rest_(line), number_(number) { skip_blanks(); }

  [[noreturn]] void fail(const std::string& what) const { throw text_error(fmt::format("line {}: {}", number_, what)); }

  bool at_end() const { return rest_.empty() || rest_.front() == ';'; }

  /// Takes `piece` if it stands here. A word is taken only whole.
  bool take(std::string_view piece) {
    if (rest_.substr(0, piece.size()) != piece) return false;
    const bool is_word = is_word_character(piece.back());
    if (is_word && rest_.size() > piece.size() && is_word_character(rest_[piece.size()])) return false;
    rest_.remove_prefix(piece.size());
    skip_blanks();
    return true;
  }

  void need(std::string_view piece) {
    if (!take(piece)) unexpected(fmt::format("'{}'", piece));
  }

  std::string_view need_word(const char* expected) {
    std::size_t length = 0;
    while (length < rest_.size() && is_word_character(rest_[length])) ++length;
    if (length == 0) unexpected(expected);
    return advance(length);
  }

  std::uint32_t need_number(const char* expected, std::uint32_t least, std::uint32_t most) {
    std::uint64_t value = 0;
    const char* const first = rest_.data();
    const auto [end, error] = std::from_chars(first, first + rest_.size(), value);
    const auto length = static_cast<std::size_t>(end - first);
    if (error == std::errc::invalid_argument || (length < rest_.size() && is_word_character(rest_[length])))
      unexpected(expected);
    if (error != std::errc() || value < least || value > most)
      fail(fmt::format("found {}, expected {} from {} to {}", rest_.substr(0, std::min<std::size_t>(length, 20)),
                       expected, least, most));
    advance(length);
    return static_cast<std::uint32_t>(value);
  }

  unsigned need_width() { return need_number("a width", 1, max_width); }

  llvm::APInt need_value(unsigned width) {
    if (!rest_.starts_with("0x")) unexpected("a value 0x...");
    std::size_t length = 2;
    while (length < rest_.size() && llvm::isHexDigit(rest_[length])) ++length;
    if (length == 2 || (length < rest_.size() && is_word_character(rest_[length]))) unexpected("a value 0x...");
    std::string_view digits = rest_.substr(2, length - 2);
    digits.remove_prefix(std::min(digits.find_first_not_of('0'), digits.size() - 1));
    if (digits.size() > (width + 3) / 4) fail(fmt::format("the value does not fit, expected at most {} bits", width));
    // A little room, so that a first digit of more bits than the width can be seen.
    const llvm::APInt value(width + 4, llvm::StringRef(digits.data(), digits.size()), 16);
    if (value.getActiveBits() > width) fail(fmt::format("the value does not fit, expected at most {} bits", width));
    advance(length);
    return value.trunc(width);
  }

  node_id need_node() {
    if (rest_.empty() || rest_.front() != '%') unexpected("a node %N");
    rest_.remove_prefix(1);
    return need_number("a node number", 0, none - 1);
  }

  std::string need_string(const char* expected) {
    if (rest_.empty() || rest_.front() != '"') unexpected(expected);
    std::string result;
    std::size_t i = 1;
    for (;; ++i) {
      if (i >= rest_.size()) fail("the string has no end, expected '\"'");
      if (rest_[i] == '"') break;
      if (rest_[i] != '\\') {
        result += rest_[i];
        continue;
      }
      ++i;
      const char escape = i < rest_.size() ? rest_[i] : '\0';
      if (escape == '"' || escape == '\\') {
        result += escape;
      } else if (escape == 'n' || escape == 't') {
        result += escape == 'n' ? '\n' : '\t';
      } else if (escape == 'x' && i + 2 < rest_.size() && llvm::isHexDigit(rest_[i + 1]) &&
                 llvm::isHexDigit(rest_[i + 2])) {
        result += static_cast<char>(llvm::hexFromNibbles(rest_[i + 1], rest_[i + 2]));
        i += 2;
      } else {
        fail("unknown escape in a string, expected \\\" \\\\ \\n \\t or \\xNN");
      }
    }
    advance(i + 1);
    return result;
  }

  bool at_string() const { return !rest_.empty() && rest_.front() == '"'; }

  /// `@file:line`, if it stands here, and then the line's end.
  source_location need_place_and_end() {
    source_location where;
    if (take("@")) {
      where.file = need_number("a file number", 0, none);
      need(":");
      where.line = need_number("a line number", 0, none);
    }
    need_end();
    return where;
  }

  void need_end() {
    if (!at_end()) unexpected("the end of the line");
  }

  [[noreturn]] void unexpected(std::string_view expected) const {
    std::size_t length = 0;
    while (length < rest_.size() && length < 20 && is_word_character(rest_[length])) ++length;
    std::string found =
        at_end() ? "the end of the line" : fmt::format("'{}'", rest_.substr(0, std::max<std::size_t>(length, 1)));
    if (!at_end() && length == 0 && !llvm::isPrint(rest_.front()))
      found = fmt::format("byte 0x{:02x}", static_cast<unsigned>(static_cast<unsigned char>(rest_.front())));
    fail(fmt::format("found {}, expected {}", found, expected));
  }

 private:
  static bool is_word_character(char c) { return llvm::isAlnum(c) || c == '_'; }

  std::string_view advance(std::size_t length) {
    const std::string_view piece = rest_.substr(0, length);
    rest_.remove_prefix(length);
    skip_blanks();
    return piece;
  }

  void skip_blanks() {
    while (!rest_.empty() && (rest_.front() == ' ' || rest_.front() == '\t' || rest_.front() == '\r'))
      rest_.remove_prefix(1);
  }

  std::string_view rest_;
  unsigned number_;
};

class parser {
 public:
  explicit parser(std::string_view text) : text_(text) {
    for (int i = 0; i <= static_cast<int>(operation::extend_sign); ++i)
      operations_[name_of(static_cast<operation>(i))] = static_cast<operation>(i);
  }

  graph run() {
    unsigned number = 0;
    bool named = false;
    while (!text_.empty()) {
      const std::size_t length = std::min(text_.find('\n'), text_.size());
      line_reader line(text_.substr(0, length), ++number);
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
    if (!named) throw text_error(fmt::format("line {}: found the end of the text, expected 'graph'", number + 1));
    if (auto what = find_violation(g_); !what.empty())
      throw text_error(fmt::format("line {}: the graph breaks a rule: {}", number, what));
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
    if (line.take("input")) return parse_port(line, true);
    if (line.take("output")) return parse_port(line, false);
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

  void parse_port(line_reader& line, bool input) {
    port p;
    p.input = input;
    const auto* const found = std::find_if(std::begin(port_kinds), std::end(port_kinds),
                                           [&](port_kind kind) { return line.take(name_of(kind)); });
    if (found == std::end(port_kinds)) line.unexpected("stream, call or result");
    p.kind = *found;
    p.name = line.need_string("the port's name in quotes");
    p.width = line.need_width();
    p.where = line.need_place_and_end();
    g_.ports.push_back(std::move(p));
    owner_ = owner::port;
    next_offset_ = 0;
  }

  void parse_field(line_reader& line) {
    if (owner_ != owner::port) line.fail("a field stands here, expected it after input or output");
    field f;
    f.name = line.need_string("the field's name in quotes");
    f.signal = line.need_string("the signal's name in quotes");
    f.width = line.need_width();
    f.offset = next_offset_;
    f.is_signed = line.take("signed");
    line.need_end();
    next_offset_ += f.width;
    if (next_offset_ > max_width)
      line.fail(fmt::format("the fields have {} bits, expected at most {}", next_offset_, max_width));
    g_.ports.back().fields.push_back(std::move(f));
  }

  void parse_register(line_reader& line) {
    register_state r;
    r.name = line.need_string("the register's name in quotes");
    r.width = line.need_width();
    if (line.take("initial")) {
      count_bits(line, r.width);
      r.initial = line.need_value(r.width);
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
  graph g_;
  std::map<std::string_view, operation> operations_;
  owner owner_ = owner::nothing;
  unsigned next_offset_ = 0;
  std::uint64_t constant_bits_ = 0, memory_bits_ = 0;
};

}  // namespace

std::string print(const graph& g) { return printer(g).run(); }

graph parse(std::string_view text) { return parser(text).run(); }

}  // namespace epiline::dataflow
