#include "check/token_file.hpp"

#include <fmt/format.h>
#include <llvm/ADT/StringRef.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>
#include <stdexcept>

namespace epiline::check {

namespace {

/// How a port of the top is written in a token file.
std::string line_of(const dataflow::port& port) {
  std::string text = fmt::format("port {} {} {}", port.name, port.input ? "input" : "output", name_of(port.kind));
  for (const dataflow::field& field : port.fields) text += fmt::format(" {}:{}", field.signal, field.width);
  return text;
}

class reader {
 public:
  reader(const std::filesystem::path& file, const dataflow::network& n) : file_(file), network_(n) {
    result_.tokens.resize(n.ports.size());
    result_.given.resize(n.ports.size());
  }

  token_file read() {
    std::ifstream in(file_);
    if (!in || std::filesystem::is_directory(file_))
      throw std::invalid_argument(fmt::format("--stimulus {}: cannot be read: is there such a file?", file_.string()));
    for (std::string line; std::getline(in, line);) {
      ++line_;
      std::istringstream stream(line.substr(0, line.find('#')));
      const std::vector<std::string> words{std::istream_iterator<std::string>(stream), {}};
      if (words.empty()) continue;
      if (words[0] == "port")
        read_port(words);
      else if (words[0] == "token")
        read_token(words);
      else
        fail(
            fmt::format("'{}' begins no line of a token file: write 'port NAME input stream SIGNAL:WIDTH ...' or "
                        "'token HEXADECIMAL ...'",
                        words[0]));
    }
    return std::move(result_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw std::invalid_argument(fmt::format("{}:{}: error: {}", file_.string(), line_, what));
  }

  void read_port(const std::vector<std::string>& words) {
    port_ = dataflow::none;
    for (dataflow::port_id id = 0; id < network_.ports.size(); ++id)
      if (words.size() > 1 && network_.ports[id].name == words[1]) port_ = id;
    if (port_ == dataflow::none) {
      std::string names;
      for (const dataflow::port& port : network_.ports) names += (names.empty() ? "" : ", ") + port.name;
      fail(fmt::format("the top has no port '{}': it has {}", words.size() > 1 ? words[1] : "", names));
    }
    if (result_.given[port_]) fail(fmt::format("the port '{}' stands here for the second time", words[1]));
    result_.given[port_] = true;
    const dataflow::port& port = network_.ports[port_];
    const std::string wanted = line_of(port);
    fields_.clear();
    // Signals may stand in any order.
    for (std::size_t i = 4; i < words.size(); ++i) {
      const std::string signal = words[i].substr(0, words[i].find(':'));
      const auto field = std::find_if(port.fields.begin(), port.fields.end(),
                                      [&](const dataflow::field& f) { return f.signal == signal; });
      if (field == port.fields.end() || words[i] != fmt::format("{}:{}", field->signal, field->width) ||
          std::find(fields_.begin(), fields_.end(), &*field) != fields_.end())
        fail(fmt::format("this port is '{}' in the top", wanted));
      fields_.push_back(&*field);
    }
    if (words.size() < 4 || words[2] != (port.input ? "input" : "output") || words[3] != name_of(port.kind) ||
        fields_.size() != port.fields.size())
      fail(fmt::format("this port is '{}' in the top", wanted));
  }

  void read_token(const std::vector<std::string>& words) {
    if (port_ == dataflow::none) fail("a token before the first port: write a line 'port ...' above it");
    if (words.size() != fields_.size() + 1)
      fail(fmt::format("{} numbers for the {} signals of port '{}'", words.size() - 1, fields_.size(),
                       network_.ports[port_].name));
    llvm::APInt token(network_.ports[port_].width, 0);
    for (std::size_t i = 0; i < fields_.size(); ++i) {
      llvm::StringRef digits = words[i + 1];
      (void)digits.consume_front("0x");
      if (digits.empty() || digits.find_first_not_of("0123456789abcdefABCDEF") != llvm::StringRef::npos)
        fail(fmt::format("'{}' is not a hexadecimal number", words[i + 1]));
      const std::optional<llvm::APInt> value = from_hexadecimal(digits, fields_[i]->width);
      if (!value)
        fail(fmt::format("'{}' has more than the {} bits of {}", words[i + 1], fields_[i]->width, fields_[i]->signal));
      token.insertBits(*value, fields_[i]->offset);
    }
    result_.tokens[port_].push_back(token);
  }

  std::filesystem::path file_;
  const dataflow::network& network_;
  token_file result_;
  std::size_t line_ = 0;
  dataflow::port_id port_ = dataflow::none;
  std::vector<const dataflow::field*> fields_;
};

}  // namespace

token_file read_token_file(const std::filesystem::path& file, const dataflow::network& n) {
  return reader(file, n).read();
}

std::string to_text(const token_file& file, const dataflow::network& n) {
  std::string text;
  for (dataflow::port_id id = 0; id < n.ports.size(); ++id) {
    const dataflow::port& port = n.ports[id];
    if (!file.given[id]) continue;
    text += line_of(port) + '\n';
    for (const llvm::APInt& token : file.tokens[id]) {
      text += "token";
      for (const dataflow::field& field : port.fields) {
        const std::string digits = to_hexadecimal(token.extractBits(field.width, field.offset));
        text += fmt::format(" {:0>{}}", digits, (field.width + 3) / 4);  // all digits, as the tests' files have them
      }
      text += '\n';
    }
  }
  return text;
}

}  // namespace epiline::check
