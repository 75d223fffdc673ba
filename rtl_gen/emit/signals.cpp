#include "emit/signals.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <llvm/ADT/StringExtras.h>
#include <llvm/ADT/StringRef.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <regex>
#include <set>
#include <tuple>

namespace epiline::emit {

using nlohmann::json;

namespace {

namespace fs = std::filesystem;

constexpr const char* schema = "epiline-signals/1";
constexpr const char* suffix_of_files = ".signals.json";

std::string read_file(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The identifiers of a Verilog text, without those in comments and strings.
std::set<std::string> identifiers_of(llvm::StringRef text) {
  std::set<std::string> names;
  while (!text.empty()) {
    if (text.starts_with("//")) {
      text = text.drop_until([](char c) { return c == '\n'; });
    } else if (text.starts_with("/*")) {
      const std::size_t end = text.find("*/");
      text = end == llvm::StringRef::npos ? llvm::StringRef() : text.drop_front(end + 2);
    } else if (text.front() == '"') {
      text = text.drop_front().drop_until([](char c) { return c == '"'; }).drop_front(1);
    } else if (llvm::isAlpha(text.front()) || text.front() == '_') {
      const llvm::StringRef name = text.take_while([](char c) { return llvm::isAlnum(c) || c == '_'; });
      names.insert(name.str());
      text = text.drop_front(name.size());
    } else if (llvm::isDigit(text.front()) || text.front() == '\'' || text.front() == '`') {
      text = text.drop_front();  // a number (8'hff) or a directive is no name
      text = text.drop_while([](char c) { return llvm::isAlnum(c) || c == '_' || c == '\''; });
    } else {
      text = text.drop_front();
    }
  }
  return names;
}

/// The text from `module NAME` to its `endmodule`; empty when there is none.
llvm::StringRef text_of_module(llvm::StringRef text, const std::string& module) {
  for (std::size_t at = 0; (at = text.find("\nmodule " + module, at)) != llvm::StringRef::npos; ++at) {
    const llvm::StringRef from = text.drop_front(at + 1);
    const char next = from.drop_front(7 + module.size()).empty() ? ' ' : from[7 + module.size()];
    if (!llvm::isAlnum(next) && next != '_') return from.take_front(from.find("\nendmodule"));
  }
  return "";
}

/// One suffix, and what the name with it is.
struct meaning {
  std::regex suffix;
  const char* text;  // {0}: the name without the suffix, {1}: the suffix's number
};

const std::vector<meaning>& meanings() {
  static const std::vector<meaning> known = [] {
    std::vector<meaning> list;
    const std::pair<const char*, const char*> table[] = {
        {"_register", "the instance of the flip-flops '{0}'"},
        {"_copy([0-9]+)", "copy {1} of the flip-flops '{0}', for some of their readers"},
        {"_s([0-9]+)", "flip-flops that hold '{0}' in stage {1}"},
        {"_enable_([0-9]+)", "1 when '{0}' is true in the iteration that stage {1} holds"},
        {"_q", "the word of '{0}' as the RAM gives it, one clock before '{0}'"},
        {"_pending", "the next value of '{0}', put by until the pipeline has drained"},
        {"_exact", "the result of '{0}' unless the divisor is zero"},
        {"_adder(_[0-9]+)?", "the instance that computes '{0}'"},
        {"_contents(_[0-9]+)?", "the block that fills '{0}'"},
        {"_write(_[0-9]+)?", "1 when a word of '{0}' is written"},
        {"_write_address(_[0-9]+)?", "the address at which '{0}' is written"},
        {"_write_data(_[0-9]+)?", "the word that is written into '{0}'"},
        // Around a port.
        {"_token", "the token that the next iteration takes from '{0}'"},
        {"_there", "1 when there is a token of '{0}'"},
        {"_served", "1 when the next iteration need not wait for a token of '{0}'"},
        {"_(first|second)", "one of the two registers that take tokens of '{0}' in turn"},
        {"_fills_second", "1 when the next token of '{0}' goes into the second register"},
        {"_reads_second", "1 when the next token of '{0}' comes from the second register"},
        {"_ready", "tready of '{0}'"},
        {"_take", "1 when an iteration takes a token of '{0}'"},
        {"_push", "1 when a token comes into the buffer of '{0}'"},
        {"_fifo", "the FIFO of '{0}'"},
        {"_in", "the FIFO of '{0}': where the next token goes"},
        {"_out", "the FIFO of '{0}': where the next token comes from"},
        {"_after_out", "the FIFO of '{0}': where the token after the next one comes from"},
        {"_waits", "1 when the FIFO of '{0}' holds a token"},
        {"_word", "the FIFO of '{0}': the token that has left it last"},
        {"_word_there", "1 when the token that has left the FIFO of '{0}' waits for the output"},
        {"_load", "1 when the FIFO of '{0}' gives a token to its output"},
        {"_leaves", "in which of the last clocks a token has left the FIFO of '{0}'"},
        {"_holds_(one|another)", "whether the FIFO of '{0}' holds {1} token"},
        {"_left", "1 when the credits of '{0}' hear of a token that has left its FIFO"},
        {"_end_(first|second|fills_second|reads_second|there|ready|take|push|token)",
         "the two registers through which '{0}' gives out its tokens"},
        {"_skipped", "1 when an iteration wrote nothing to '{0}'"},
        {"_data", "the token that is written to '{0}'"},
        {"_credits(_next)?", "places in the FIFO of '{0}' that nothing in flight may need"},
        {"_(fewer|change)", "how many places more '{0}' will have, or whether it has one fewer"},
        {"_room", "1 when '{0}' has room for another iteration"},
        {"_(registers|wanted|sample|start|hold|keep|slave)", "control of the arguments behind the AXI4-Lite slave"},
    };
    for (const auto& [suffix, text] : table) list.push_back({std::regex(std::string("^(.+)") + suffix + "$"), text});
    return list;
  }();
  return known;
}

/// Answers for one module.
class explainer {
 public:
  explainer(module_signals signals, std::set<std::string> names)
      : module_(std::move(signals.module)), files_(std::move(signals.files)), names_(std::move(names)) {
    for (signal& s : signals.signals) signals_[s.name] = std::move(s);
  }

  [[nodiscard]] const std::string& module() const { return module_; }
  [[nodiscard]] const std::set<std::string>& names() const { return names_; }

  /// Nothing when the module has no such name.
  [[nodiscard]] std::optional<std::string> explain(const std::string& name) const {
    if (names_.count(name) == 0) return std::nullopt;
    std::string result;
    return describe(name, result) ? std::optional(result) : std::nullopt;
  }

 private:
  /// Takes suffixes off until a signal is left.
  bool describe(const std::string& name, std::string& result) const {
    if (const auto found = signals_.find(name); found != signals_.end()) {
      describe_signal(found->second, result);
      return true;
    }
    for (const meaning& one : meanings()) {
      std::smatch parts;
      if (!std::regex_match(name, parts, one.suffix)) continue;
      const std::string stem = parts[1];
      std::string inner;
      if (!describe(stem, inner)) continue;
      const std::string number = parts.size() > 2 ? parts[2].str() : "";
      result += fmt::format("{}: {}\n{}", name, fmt::format(fmt::runtime(one.text), stem, number), inner);
      return true;
    }
    return false;
  }

  void describe_signal(const signal& s, std::string& result) const {
    result += fmt::format("{}: {}", s.name, s.kind);
    if (!s.what.empty()) result += ", " + s.what;
    if (s.width > 0) result += fmt::format(", {} bit{}", s.width, s.width == 1 ? "" : "s");
    if (s.stage >= 0) result += fmt::format(", stage {}", s.stage);
    result += '\n';
    for (const dataflow::source_location& where : s.where) {
      if (where.line == 0 || where.file >= files_.size()) continue;
      result += fmt::format("  {}:{}{}\n", files_[where.file], where.line, source_line(files_[where.file], where.line));
    }
  }

  static std::string source_line(const std::string& file, unsigned line) {
    std::ifstream in(file);
    std::string text;
    for (unsigned number = 0; number < line; ++number)
      if (!std::getline(in, text)) return "";
    return ": " + llvm::StringRef(text).trim().str();
  }

  std::string module_;
  std::vector<std::string> files_;
  std::set<std::string> names_;  // that the Verilog has
  std::map<std::string, signal> signals_;
};

/// The modules of one file's signals, read back.
std::vector<explainer> read_modules(const fs::path& file, const std::string& verilog) {
  const json text = json::parse(read_file(file), nullptr, false);
  if (text.is_discarded() || !text.is_object() || !text.contains("schema") || text["schema"] != schema)
    throw std::invalid_argument(fmt::format("{}: not a file of epiline-hls: compile again", file.string()));
  std::vector<explainer> result;
  try {
    for (const json& one : text.at("modules")) {
      module_signals module{one.at("module"), one.at("files"), {}};
      for (const json& s : one.at("signals")) {
        module.signals.push_back({s.at("name"), s.at("kind"), s.at("what"), s.at("width"), s.at("stage"), {}});
        for (const json& place : s.at("where")) module.signals.back().where.push_back({place.at(0), place.at(1)});
      }
      std::set<std::string> names = identifiers_of(text_of_module(verilog, module.module));
      names.merge(identifiers_of(text_of_module(verilog, module.module + "_registers")));  // the AXI4-Lite slave
      result.emplace_back(std::move(module), std::move(names));
    }
  } catch (const json::exception&) {
    throw std::invalid_argument(fmt::format("{}: damaged: compile again", file.string()));
  }
  return result;
}

/// "x" of "top.part.x[3]", the way simulators, synthesis and timing reports name it.
std::string plain_name(llvm::StringRef wanted) {
  wanted = wanted.trim().take_until([](char c) { return c == '['; }).rtrim();
  return wanted.drop_front(std::min(wanted.find_last_of("./\\") + 1, wanted.size())).str();
}

/// The names that are like `name` and can be explained.
std::string nearest(const std::string& name, const std::vector<explainer>& modules) {
  constexpr std::size_t most = 3;
  std::set<std::tuple<unsigned, std::string, std::size_t>> order;
  for (std::size_t i = 0; i < modules.size(); ++i)
    for (const std::string& other : modules[i].names())
      order.emplace(llvm::StringRef(name).edit_distance(other), other, i);
  std::vector<std::string> found;
  for (const auto& [distance, other, i] : order)
    if (found.size() < most && modules[i].explain(other)) found.push_back(fmt::format("'{}'", other));
  return fmt::format("{}", fmt::join(found, ", "));
}

}  // namespace

std::vector<signal> interface_signals(const std::string& module, const std::vector<rtl_port>& ports) {
  std::vector<signal> all = {{"clk", "control", "the clock", 1, -1, {}},
                             {"rst", "control", "the reset, active high", 1, -1, {}},
                             {module, "control", "the module", 0, -1, {}}};
  for (const rtl_port& port : ports) {
    const auto add = [&](const std::string& name, unsigned width) {
      all.push_back({name, "port signal", fmt::format("of '{}'", port.name), width, -1, {port.where}});
    };
    for (const rtl_field& f : port.fields) add(f.rtl, f.width);
    add(port.valid, 1);
    add(port.ready, 1);
  }
  return all;
}

std::string signals_text(const std::vector<module_signals>& modules) {
  std::string text = fmt::format("{{\"schema\": {}, \"modules\": [", json(schema).dump());
  for (std::size_t m = 0; m < modules.size(); ++m) {
    text += fmt::format("{}\n{{\"module\": {}, \"files\": {}, \"signals\": [", m == 0 ? "" : ",",
                        json(modules[m].module).dump(), json(modules[m].files).dump());
    for (std::size_t i = 0; i < modules[m].signals.size(); ++i) {
      const signal& s = modules[m].signals[i];
      json where = json::array();
      for (const dataflow::source_location& place : s.where) where.push_back({place.file, place.line});
      const json one = {{"name", s.name},   {"kind", s.kind},   {"what", s.what},
                        {"width", s.width}, {"stage", s.stage}, {"where", where}};
      text += (i == 0 ? "\n" : ",\n") + one.dump();
    }
    text += "\n]}";
  }
  return text + "\n]}\n";
}

std::string explain_signal(const std::string& wanted, const std::string& folder) {
  std::error_code failed;
  std::vector<fs::path> files;
  for (fs::directory_iterator at(folder, failed), end; !failed && at != end; at.increment(failed))
    if (llvm::StringRef(at->path().filename().string()).ends_with(suffix_of_files)) files.push_back(at->path());
  if (failed) throw std::invalid_argument(fmt::format("{}: cannot be read: {}", folder, failed.message()));
  if (files.empty())
    throw std::invalid_argument(
        fmt::format("{}: no *{} in it: name the folder that epiline-hls wrote with -o", folder, suffix_of_files));
  std::sort(files.begin(), files.end());
  const std::string name = plain_name(wanted);
  std::vector<explainer> modules;
  for (const fs::path& file : files) {
    const std::string base = file.filename().string();
    const fs::path verilog =
        file.parent_path() / (base.substr(0, base.size() - llvm::StringRef(suffix_of_files).size()) + ".v");
    const std::string text = read_file(verilog);
    if (text.empty())
      throw std::invalid_argument(
          fmt::format("{}: {}, which it speaks of, is missing: compile again", file.string(), verilog.string()));
    for (explainer& module : read_modules(file, text)) modules.push_back(std::move(module));
  }
  std::vector<std::pair<std::string, std::string>> found;  // processes use the same names
  for (const explainer& module : modules)
    if (std::optional<std::string> text = module.explain(name)) found.emplace_back(module.module(), std::move(*text));
  if (found.size() == 1) return found.front().second;
  std::string result;
  for (const auto& [module, text] : found) result += fmt::format("in module {}\n{}", module, text);
  if (!result.empty()) return result;
  throw unknown_signal(
      fmt::format("there is no signal '{}' in {}; the nearest are {}", name, folder, nearest(name, modules)));
}

}  // namespace epiline::emit
