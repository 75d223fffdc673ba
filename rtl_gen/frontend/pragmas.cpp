#include "frontend/pragmas.hpp"

#include <fmt/format.h>
#include <llvm/ADT/StringExtras.h>
#include <llvm/ADT/StringRef.h>

#include <map>

#include "frontend/source.hpp"

namespace epiline::frontend {

namespace {

/// The words of one pragma: a name, options "key=value" and flags without a value, in lower case but for values.
struct pragma_line {
  std::string name;
  std::map<std::string, std::string> options;

  [[nodiscard]] bool has(const std::string& key) const { return options.count(key) != 0; }
  [[nodiscard]] std::string get(const std::string& key, const std::string& otherwise = "") const {
    const auto found = options.find(key);
    return found == options.end() ? otherwise : found->second;
  }
};

pragma_line parse(llvm::StringRef text) {
  pragma_line result;
  std::string normal;  // no blanks around '='
  for (const char c : text) {
    if (c == '=') {
      while (!normal.empty() && normal.back() == ' ') normal.pop_back();
      normal += '=';
    } else if (llvm::isSpace(c)) {
      if (!normal.empty() && normal.back() != '=' && normal.back() != ' ') normal += ' ';
    } else {
      normal += c;
    }
  }
  llvm::SmallVector<llvm::StringRef> words;
  llvm::StringRef(normal).split(words, ' ', -1, false);
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i == 0) {
      result.name = words[i].lower();
      continue;
    }
    const auto [key, value] = words[i].split('=');
    result.options[key.lower()] = value.str();
  }
  return result;
}

/// `type=inter` or the bare flag `inter`.
bool has_kind(const pragma_line& pragma, const std::string& kind) {
  return pragma.has(kind) || llvm::StringRef(pragma.get("type")).lower() == kind;
}

std::string dependence_call(const pragma_line& pragma, const source_place& place) {
  const std::string variable = pragma.get("variable");
  if (variable.empty()) refuse(place, "#pragma HLS DEPENDENCE without variable=NAME: name the array it speaks of");
  if (has_kind(pragma, "intra")) return "";  // order within an iteration is always kept here
  const bool none = has_kind(pragma, "false") || pragma.get("dependent") == "false";
  const std::string distance = pragma.get("distance", none ? "1000000" : "1");
  return fmt::format("__epiline_pragma_dependence((const void*)&({}), {});", variable, distance);
}

std::string partition_call(const pragma_line& pragma, const source_place& place, std::vector<std::string>& notes) {
  const std::string variable = pragma.get("variable");
  if (variable.empty()) refuse(place, "#pragma HLS ARRAY_PARTITION without variable=NAME: name the array");
  if (has_kind(pragma, "cyclic") || has_kind(pragma, "block")) {
    notes.push_back(
        fmt::format("{}:{}: note: ARRAY_PARTITION cyclic/block of '{}' has no effect: memories get as many "
                    "read ports as the code needs; use 'complete' for registers",
                    place.file, place.line, variable));
    return "";
  }
  return fmt::format("__epiline_pragma_partition((const void*)&({}), {});", variable, pragma.get("dim", "1"));
}

void check_interface(const pragma_line& pragma, const source_place& place) {
  static const char* const accepted[] = {"axis",       "s_axilite", "ap_none", "ap_ctrl_none",
                                         "ap_ctrl_hs", "ap_stable", "ap_fifo", "ap_vld",
                                         "ap_hs",      "ap_ovld",   "ap_ack",  "ap_ctrl_chain"};
  for (const char* mode : accepted)
    if (pragma.has(mode) || llvm::StringRef(pragma.get("mode")).lower() == mode) return;
  std::string mode = pragma.get("mode");
  for (const auto& [key, value] : pragma.options)
    if (mode.empty() && value.empty()) mode = key;
  refuse(place, "#pragma HLS INTERFACE " + mode +
                    ": only stream and scalar interfaces exist here (axis, s_axilite, ap_none, "
                    "ap_ctrl_none ...): pass data through hls::stream parameters instead of memory interfaces");
}

std::string replacement(const pragma_line& pragma, const source_place& place, std::vector<std::string>& notes) {
  if (pragma.name == "pipeline") {
    if (pragma.has("off")) return "";
    return fmt::format("__epiline_pragma_pipeline({});", pragma.get("ii", "1"));
  }
  if (pragma.name == "unroll") {
    if (pragma.has("factor"))
      refuse(place,
             "#pragma HLS UNROLL factor=N: only full unrolling is supported: drop the factor, or write the "
             "partly unrolled loop out as two nested loops");
    return "__epiline_pragma_unroll();";
  }
  if (pragma.name == "dependence") return dependence_call(pragma, place);
  if (pragma.name == "array_partition") return partition_call(pragma, place, notes);
  if (pragma.name == "interface") {
    check_interface(pragma, place);
    return "";
  }
  // What these ask for is what this flow always does (everything is inlined and pipelined, trees are balanced, loop
  // nests are flattened), or they only inform.
  static const char* const natural[] = {
      "inline",    "loop_tripcount", "loop_flatten", "expression_balance", "latency",    "aggregate", "disaggregate",
      "data_pack", "reset",          "top",          "protocol",           "performance"};
  for (const char* name : natural)
    if (pragma.name == name) return "";
  static const char* const advisory[] = {"bind_storage",         "bind_op",       "resource",
                                         "allocation",           "stream",        "loop_merge",
                                         "function_instantiate", "array_reshape", "stable"};
  for (const char* name : advisory)
    if (pragma.name == name) {
      notes.push_back(fmt::format("{}:{}: note: #pragma HLS {} has no effect: the flow chooses this itself", place.file,
                                  place.line, llvm::StringRef(pragma.name).upper()));
      return "";
    }
  if (pragma.name == "dataflow")
    refuse(place,
           "#pragma HLS DATAFLOW: concurrent functions joined by internal streams are not supported: call "
           "kernels one after another inside one loop, or generate one module a function");
  refuse(place, fmt::format("#pragma HLS {}: not known: remove it", llvm::StringRef(pragma.name).upper()));
}

/// Follows clang's line markers: `# 12 "file.cpp" 2`.
bool follow_marker(llvm::StringRef line, source_place& place) {
  if (!line.consume_front("# ")) return false;
  unsigned number = 0;
  if (line.consumeInteger(10, number)) return false;
  const std::size_t open = line.find('"');
  const std::size_t close = line.rfind('"');
  if (open == llvm::StringRef::npos || close <= open) return false;
  place.file = line.slice(open + 1, close).str();
  place.line = number;
  return true;
}

}  // namespace

pragma_rewrite rewrite_pragmas(const std::string& preprocessed) {
  pragma_rewrite result;
  result.source =
      "extern \"C\" void __epiline_pragma_pipeline(int) noexcept; extern \"C\" void __epiline_pragma_unroll() "
      "noexcept; "
      "extern \"C\" void __epiline_pragma_dependence(const void*, int) noexcept; "
      "extern \"C\" void __epiline_pragma_partition(const void*, int) noexcept;\n";
  source_place place;
  llvm::StringRef rest = preprocessed;
  while (!rest.empty()) {
    const auto [line, after] = rest.split('\n');
    rest = after;
    if (!follow_marker(line, place)) {
      llvm::StringRef text = line.trim();
      if (text.consume_front("#pragma") && (text = text.ltrim(), text.take_front(3).equals_insensitive("HLS"))) {
        result.source += replacement(parse(text.drop_front(3)), place, result.notes) + "\n";
        ++place.line;
        continue;
      }
      ++place.line;
    }
    result.source += line.str();
    result.source += '\n';
  }
  return result;
}

}  // namespace epiline::frontend
