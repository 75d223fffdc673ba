#include "frontend/pragmas.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <llvm/ADT/StringExtras.h>
#include <llvm/ADT/StringRef.h>

#include <algorithm>
#include <initializer_list>
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
  std::string normal;  // no blanks around '=' and ','
  for (const char c : text) {
    if (c == '=' || c == ',') {
      while (!normal.empty() && normal.back() == ' ') normal.pop_back();
      normal += c;
    } else if (llvm::isSpace(c)) {
      if (!normal.empty() && normal.back() != '=' && normal.back() != ',' && normal.back() != ' ') normal += ' ';
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

/// Whether a line is `#pragma HLS WORDS`; of it the words are left.
bool is_of_flow(llvm::StringRef& line) {
  line = line.trim();
  if (!line.consume_front("#pragma")) return false;
  line = line.ltrim();
  return line.consume_front_insensitive("HLS");
}

/// One pragma for each name of a list, `port=a, b` or `variable=a, b`. Commas within brackets belong to an expression.
std::vector<pragma_line> one_each(const pragma_line& pragma, const source_place& place) {
  for (const char* key : {"port", "variable"}) {
    const std::string names = pragma.get(key);
    if (names.find(',') == std::string::npos) continue;
    std::vector<pragma_line> result(1, pragma);
    result.back().options[key].clear();
    int depth = 0;
    for (const char c : names) {
      depth += llvm::StringRef("([<").contains(c) ? 1 : llvm::StringRef(")]>").contains(c) ? -1 : 0;
      if (c != ',' || depth != 0) {
        result.back().options[key] += c;
        continue;
      }
      result.push_back(pragma);
      result.back().options[key].clear();
    }
    for (const pragma_line& one : result)
      if (one.get(key).empty() || llvm::StringRef(one.get(key)).contains('='))
        refuse(place, fmt::format("#pragma HLS {}: a name is missing in '{}': put one between the commas",
                                  llvm::StringRef(pragma.name).upper(), names));
    return result;
  }
  return {pragma};
}

/// `type=inter` or the bare flag `inter`.
bool has_kind(const pragma_line& pragma, const std::string& kind) {
  return pragma.has(kind) || llvm::StringRef(pragma.get("type")).lower() == kind;
}

/// What stands after `key=`, a number or a constant expression of the source; `otherwise` when it is not there.
std::string number_of(const pragma_line& pragma, const std::string& key, int otherwise, int least,
                      const source_place& place) {
  if (!pragma.has(key)) return std::to_string(otherwise);
  const std::string text = pragma.get(key);
  int number = least;
  const bool is_number = !llvm::StringRef(text).getAsInteger(10, number);
  if (text.empty() || number < least || (!is_number && llvm::isDigit(text.front())))
    refuse(place, fmt::format("#pragma HLS {} {}={}: give a number from {} on", llvm::StringRef(pragma.name).upper(),
                              llvm::StringRef(key).upper(), text, least));
  return text;
}

/// A word that the pragma does not have would be ignored in silence: a slip of the pen most of the time.
void check_options(const pragma_line& pragma, std::initializer_list<const char*> known, const source_place& place) {
  for (const auto& [key, value] : pragma.options)
    if (std::find(known.begin(), known.end(), key) == known.end())
      refuse(place, fmt::format("#pragma HLS {}: the option '{}' is not known: it takes {}",
                                llvm::StringRef(pragma.name).upper(), key, fmt::join(known, ", ")));
}

std::string dependence_call(const pragma_line& pragma, const source_place& place, std::vector<std::string>& notes) {
  const std::string variable = pragma.get("variable");
  check_options(pragma,
                {"variable", "type", "intra", "inter", "direction", "raw", "war", "waw", "distance", "dependent",
                 "true", "false", "class", "array", "pointer"},
                place);
  if (variable.empty()) refuse(place, "#pragma HLS DEPENDENCE without variable=NAME: name the array it speaks of");
  if (has_kind(pragma, "intra")) return "";  // order within an iteration is always kept here
  // Vendors' sources say `false` of line buffers, whose words are read again a row later. It promises no distance that
  // hardware could count on for every row.
  if ((has_kind(pragma, "false") || pragma.get("dependent") == "false") && !pragma.has("distance"))
    notes.push_back(
        fmt::format("{}:{}: note: DEPENDENCE false of '{}' has no effect: what is written can be read in the next "
                    "iteration, as it can natively: where no word is read within N iterations of its writing, "
                    "distance=N true saves the logic for that",
                    place.file, place.line, variable));
  const std::string distance = number_of(pragma, "distance", 1, 1, place);
  return fmt::format("__epiline_pragma_dependence((const void*)&({}), {});", variable, distance);
}

/// Vendors' `RESET variable=x` asks for a reset, which every static variable has here; `off` takes it away.
std::string reset_call(const pragma_line& pragma, const source_place& place) {
  const std::string variable = pragma.get("variable");
  check_options(pragma, {"variable", "off"}, place);
  if (variable.empty()) refuse(place, "#pragma HLS RESET without variable=NAME: name the static variable");
  if (!pragma.has("off")) return fmt::format("(void)sizeof({});", variable);
  return fmt::format("__epiline_pragma_reset((const void*)&({}));", variable);
}

/// Elements of a dimension that ARRAY_PARTITION cyclic or block takes apart.
constexpr unsigned longest_banked = 64;

std::string partition_call(const pragma_line& pragma, const source_place& place, std::vector<std::string>& notes) {
  const std::string variable = pragma.get("variable");
  check_options(pragma, {"variable", "type", "complete", "cyclic", "block", "factor", "dim"}, place);
  if (const std::string type = llvm::StringRef(pragma.get("type", "complete")).lower();
      type != "complete" && type != "cyclic" && type != "block")
    refuse(place, fmt::format("#pragma HLS ARRAY_PARTITION type={}: it is complete, cyclic or block", type));
  if (variable.empty()) refuse(place, "#pragma HLS ARRAY_PARTITION without variable=NAME: name the array");
  const std::string dimension = number_of(pragma, "dim", 1, 0, place);
  if (has_kind(pragma, "cyclic") || has_kind(pragma, "block")) {
    static_cast<void>(number_of(pragma, "factor", 1, 1, place));
    notes.push_back(fmt::format(
        "{}:{}: note: ARRAY_PARTITION cyclic/block of '{}': a dimension of up to {} elements is taken apart "
        "as by 'complete'; a longer one stays in memory, which gets as many read ports as the code needs "
        "and takes one write an iteration",
        place.file, place.line, variable, longest_banked));
    return fmt::format("__epiline_banks<{}, {}>({});", dimension, longest_banked, variable);
  }
  return fmt::format("__epiline_partition({}, {});", variable, dimension);
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
  if (mode.empty()) refuse(place, "#pragma HLS INTERFACE without a mode: name it, for example axis");
  refuse(place, "#pragma HLS INTERFACE " + mode +
                    ": only stream and scalar interfaces exist here (axis, s_axilite, ap_none, "
                    "ap_ctrl_none ...): pass data through hls::stream parameters instead of memory interfaces");
}

std::string replacement(const pragma_line& pragma, const source_place& place, std::vector<std::string>& notes) {
  if (pragma.name == "pipeline") {
    check_options(pragma, {"ii", "off", "rewind", "enable_flush", "style"}, place);
    if (pragma.has("off")) return "";
    return fmt::format("__epiline_pragma_pipeline({});", number_of(pragma, "ii", 1, 1, place));
  }
  if (pragma.name == "unroll") {
    check_options(pragma, {"factor", "skip_exit_check", "region", "off"}, place);
    if (pragma.has("off")) return "";
    return fmt::format("__epiline_pragma_unroll({});", number_of(pragma, "factor", 0, 1, place));
  }
  if (pragma.name == "dependence") return dependence_call(pragma, place, notes);
  if (pragma.name == "reset") return reset_call(pragma, place);
  if (pragma.name == "array_partition") return partition_call(pragma, place, notes);
  if (pragma.name == "interface") {
    check_interface(pragma, place);
    // Clang finds out whether the parameter exists; no code comes of it.
    const std::string port = pragma.get("port");
    return port.empty() || llvm::StringRef(port).lower() == "return" ? "" : fmt::format("(void)sizeof({});", port);
  }
  if (pragma.name == "dataflow") {
    check_options(pragma, {"disable_start_propagation"}, place);
    return "__epiline_pragma_dataflow();";
  }
  if (pragma.name == "stream") {
    const std::string variable = pragma.get("variable");
    if (variable.empty()) refuse(place, "#pragma HLS STREAM without variable=NAME: name the stream it speaks of");
    check_options(pragma, {"variable", "depth", "type", "dim", "off"}, place);
    return fmt::format("__epiline_pragma_stream((const void*)&({}), {});", variable,
                       number_of(pragma, "depth", 0, 1, place));
  }
  // What these ask for is what this flow always does (everything is inlined and pipelined, trees are balanced, loop
  // nests are flattened), or they only inform.
  static const char* const natural[] = {"inline",  "loop_tripcount", "loop_flatten", "expression_balance",
                                        "latency", "aggregate",      "disaggregate", "data_pack",
                                        "top",     "protocol",       "performance"};
  for (const char* name : natural)
    if (pragma.name == name) return "";
  static const char* const advisory[] = {
      "bind_storage",  "bind_op", "resource",  "allocation", "loop_merge", "function_instantiate",
      "array_reshape", "stable",  "array_map", "occurrence", "clock",      "shared",
      "cache"};
  for (const char* name : advisory)
    if (pragma.name == name) {
      notes.push_back(fmt::format("{}:{}: note: #pragma HLS {} has no effect: the flow chooses this itself", place.file,
                                  place.line, llvm::StringRef(pragma.name).upper()));
      return "";
    }
  if (pragma.name.empty()) refuse(place, "#pragma HLS without a name: remove it");
  static const char* const honoured[] = {"pipeline",  "unroll", "dependence", "array_partition",
                                         "interface", "inline", "dataflow",   "stream"};
  for (const char* name : honoured)
    if (llvm::StringRef(name).edit_distance(pragma.name) <= 2)
      refuse(place, fmt::format("#pragma HLS {}: not known: did you mean {}?", llvm::StringRef(pragma.name).upper(),
                                llvm::StringRef(name).upper()));
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

/// What pragmas become, in one line: an array that is a function's parameter is a pointer, and the pragma speaks of
/// what it points at. Streams in an array are apart by nature.
constexpr const char* declarations =
    "extern \"C\" { void __epiline_pragma_pipeline(int) noexcept; void __epiline_pragma_unroll(int) noexcept; "
    "void __epiline_pragma_dependence(const void*, int) noexcept; void __epiline_pragma_reset(const void*) noexcept; "
    "void __epiline_pragma_partition(const void*, int) noexcept; void __epiline_pragma_dataflow() noexcept; "
    "void __epiline_pragma_stream(const void*, long) noexcept; } "
    "template <class T> struct __epiline_element { using type = T; }; "
    "template <class T> struct __epiline_element<T*> : __epiline_element<T> {}; "
    "template <class T, unsigned long N> struct __epiline_element<T[N]> : __epiline_element<T> {}; "
    "template <class T> constexpr bool __epiline_is_stream(decltype(T::is_stream_of_tokens)*) { return true; } "
    "template <class T> constexpr bool __epiline_is_stream(...) { return false; } "
    "template <class T> inline void __epiline_partition(const T& object, int dimension) { "
    "if constexpr (__epiline_is_stream<typename __epiline_element<T>::type>(nullptr)) {} "
    "else if constexpr (__is_pointer(T)) __epiline_pragma_partition((const void*)object, dimension); "
    "else __epiline_pragma_partition((const void*)&object, dimension); } "
    "template <class T, int D> struct __epiline_length { static constexpr unsigned long value = 0; }; "
    "template <class T, unsigned long N, int D> struct __epiline_length<T[N], D> : __epiline_length<T, D - 1> {}; "
    "template <class T, unsigned long N> struct __epiline_length<T[N], 1> { static constexpr auto value = N; }; "
    "template <class T, unsigned long N> struct __epiline_length<T[N], 0> { static constexpr auto value = "
    "sizeof(T[N]) / sizeof(typename __epiline_element<T>::type); }; "
    "template <int D, unsigned long longest, class T> inline void __epiline_banks(const T& object) { "
    "if constexpr (__is_pointer(T)) { if constexpr (D > 1) "
    "if constexpr (__epiline_length<__remove_pointer(T), D - 1>::value <= longest) __epiline_partition(object, D); } "
    "else if constexpr (__epiline_length<T, D>::value <= longest) __epiline_partition(object, D); }\n";

}  // namespace

std::set<std::string> stream_ports(const std::string& body) {
  std::set<std::string> names;
  llvm::StringRef rest = body;
  while (!rest.empty()) {
    const auto [line, after] = rest.split('\n');
    rest = after;
    llvm::StringRef text = line;
    if (!is_of_flow(text)) continue;
    const pragma_line pragma = parse(text);
    if (pragma.name != "interface") continue;
    const std::string mode = llvm::StringRef(pragma.get("mode")).lower();
    if (!pragma.has("axis") && !pragma.has("ap_fifo") && mode != "axis" && mode != "ap_fifo") continue;
    llvm::SmallVector<llvm::StringRef> ports;
    const std::string list = pragma.get("port");
    llvm::StringRef(list).split(ports, ',');
    for (const llvm::StringRef port : ports) names.insert(port.str());
  }
  return names;
}

pragma_rewrite rewrite_pragmas(const std::string& preprocessed) {
  pragma_rewrite result;
  result.source = fmt::format("# 1 \"<pragmas>\"\n{}", declarations);
  source_place place;
  llvm::StringRef rest = preprocessed;
  while (!rest.empty()) {
    const auto [line, after] = rest.split('\n');
    rest = after;
    if (!follow_marker(line, place)) {
      llvm::StringRef text = line;
      if (is_of_flow(text)) {
        const pragma_line pragma = parse(text);
        const source_place near = {shown_path(place.file), place.line};
        result.places[{place.file, place.line}] = llvm::StringRef(pragma.name).upper();
        for (const pragma_line& one : one_each(pragma, near)) result.source += replacement(one, near, result.notes);
        result.source += '\n';
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
