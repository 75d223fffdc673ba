#include "dataflow/network_text.hpp"

#include <vector>

#include "dataflow/text_pieces.hpp"

namespace epiline::dataflow {

namespace {

/// One line without its end; `text` begins after it.
std::string_view take_line(std::string_view& text) {
  const std::size_t length = std::min(text.find('\n'), text.size());
  const std::string_view line = text.substr(0, length);
  text.remove_prefix(std::min(length + 1, text.size()));
  return line;
}

/// Whether the line begins with `process`: nothing else in a graph's text begins with this word.
bool begins_process(std::string_view line) {
  line_reader reader(line, 0);
  return reader.take("process");
}

class network_parser {
 public:
  explicit network_parser(std::string_view text) : text_(text) {}

  network run() {
    line_reader first = next();
    if (first.take("graph")) return network_of(parse(whole_));
    first.need("network");
    n_.name = first.need_string("the network's name in quotes");
    first.need_end();
    while (!text_.empty() && !begins_process(text_.substr(0, text_.find('\n')))) parse_item(next());
    while (!text_.empty()) parse_process();
    if (auto what = find_violation(n_); !what.empty())
      throw text_error(fmt::format("line {}: the network breaks a rule: {}", number_, what));
    return std::move(n_);
  }

 private:
  /// The next line that says something.
  line_reader next() {
    while (true) {
      line_reader line(take_line(text_), ++number_);
      if (!line.at_end() || text_.empty()) return line;
    }
  }

  void parse_item(line_reader line) {
    if (line.at_end()) return;
    if (line.take("file")) {
      n_.files.push_back(line.need_string("a file name in quotes"));
      return line.need_end();
    }
    if (line.take("input")) return n_.ports.push_back(parse_port(line, true));
    if (line.take("output")) return n_.ports.push_back(parse_port(line, false));
    if (line.take("field")) {
      if (n_.ports.empty()) line.fail("a field stands here, expected it after input or output");
      return append_field(line, n_.ports.back());
    }
    if (line.take("fifo")) {
      fifo f;
      f.name = line.need_string("the stream's name in quotes");
      f.width = line.need_width();
      line.need("depth");
      f.depth = line.need_number("a depth", 1, max_fifo_depth);
      f.where = line.need_place_and_end();
      return n_.fifos.push_back(f);
    }
    line.unexpected("file, input, output, field, fifo or process");
  }

  void parse_process() {
    line_reader line(take_line(text_), ++number_);
    line.need("process");
    n_.called.push_back(line.need_place_and_end());
    const unsigned before = number_;
    const std::string_view rest = text_;
    while (!text_.empty() && !begins_process(text_.substr(0, text_.find('\n')))) {
      take_line(text_);
      ++number_;
    }
    n_.processes.push_back(parse_part(rest.substr(0, rest.size() - text_.size()), before));
  }

  std::string_view text_;
  const std::string_view whole_ = text_;
  unsigned number_ = 0;
  network n_;
};

}  // namespace

std::string print(const network& n) {
  std::string text = fmt::format("network {}\n", in_quotes(n.name));
  for (const std::string& file : n.files) text += fmt::format("file {}\n", in_quotes(file));
  for (const port& p : n.ports) text += print_port(p);
  for (const fifo& f : n.fifos)
    text += fmt::format("fifo {} {} depth {}{}", in_quotes(f.name), f.width, f.depth, place_and_end(f.where));
  for (std::size_t i = 0; i < n.processes.size(); ++i)
    text += "process" + place_and_end(n.called[i]) + print(n.processes[i]);
  return text;
}

std::string print_design(const network& n) { return is_single(n) ? print(n.processes.front()) : print(n); }

network parse_network(std::string_view text) { return network_parser(text).run(); }

}  // namespace epiline::dataflow
