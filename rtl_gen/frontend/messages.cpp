#include "frontend/messages.hpp"

#include <fmt/format.h>
#include <llvm/ADT/StringRef.h>

#include <algorithm>
#include <regex>
#include <set>
#include <vector>

#include "frontend/source.hpp"

namespace epiline::frontend {

namespace {

constexpr std::size_t most_errors = 10;

/// One of clang's messages with the lines below it.
struct message {
  std::string file;
  unsigned line = 0;
  std::string kind;  // error, fatal error, note
  std::string text;
  std::string excerpt;  // the source line and the mark below it
};

std::vector<message> parse(const std::string& text) {
  static const std::regex head("^(.*):([0-9]+):[0-9]+: (fatal error|error|warning|note): (.*)$");
  std::vector<message> result;
  llvm::StringRef rest = text;
  bool inside = false;
  while (!rest.empty()) {
    const auto [line, after] = rest.split('\n');
    rest = after;
    std::smatch found;
    const std::string whole = line.str();
    if (std::regex_match(whole, found, head)) {
      result.push_back({found[1], static_cast<unsigned>(std::stoul(found[2])), found[3], found[4], ""});
      inside = true;
    } else if (line.starts_with("In file included from") || line.ends_with("generated.")) {
      inside = false;
    } else if (inside) {
      result.back().excerpt += whole + "\n";
    }
  }
  return result;
}

/// What to do about what clang found.
std::string advice_for(const std::string& text) {
  static const std::pair<std::regex, const char*> known[] = {
      {std::regex("'hls_(streamofblocks|burst_maxi).*' file not found"),
       "streams of blocks and memory bursts are not supported: use functions over hls::stream"},
      {std::regex("'.*xf_.*' file not found"),
       "the vendor's libraries are not part of this: write the kernel with ap_int.h and hls_stream.h"},
      {std::regex("file not found"), "name its folder with -I"},
      {std::regex("with exceptions disabled"),
       "hardware cannot unwind a call: give errors out as values, and keep testbench code behind #ifndef "
       "__SYNTHESIS__"},
      {std::regex("requires -frtti"), "types must be known at compile time: use templates"},
      {std::regex("no member named '(size|capacity|empty_cnt|read_dep|write_dep)' in 'hls::stream"),
       "what depends on timing is not supported: count tokens in the kernel"},
      {std::regex("deleted (constructor|function) .*hls::stream|copy assignment operator .*hls::stream"),
       "a stream cannot be copied: pass it as hls::stream<T>&"},
      {std::regex("overload resolution selected deleted operator '='"),
       "a stream cannot be copied: pass it as hls::stream<T>&"},
      {std::regex("of bit sizes greater than"), "an ap_int or ap_uint has at most 65536 bits"},
      {std::regex("(division|remainder) by zero"),
       "no hardware has a value for it: guard it, or give the divisor a value"},
      {std::regex("shift count >= width"), "it has no value: make the operand wider first, for example an ap_int<64>"},
      {std::regex("shift count is negative"), "it has no value: shift the other way"},
      {std::regex("is uninitialized when used"), "give it a value where it is declared"},
      {std::regex("array index .* (past the end|before the beginning)"),
       "keep indices from 0 to the number of elements - 1"},
  };
  for (const auto& [pattern, advice] : known)
    if (std::regex_search(text, pattern)) return std::string(": ") + advice;
  return "";
}

/// Clang's words without those of compilers.
std::string plain_words(std::string text) {
  static const std::pair<std::regex, const char*> words[] = {
      {std::regex("^static assertion failed( due to requirement '.*')?: "), ""},
      {std::regex(" \\[-W[^\\]]*\\]$"), ""},
      {std::regex("^cannot use '(throw|try)' with exceptions disabled"), "'$1': exceptions are not supported"},
      {std::regex("^use of (dynamic_cast|typeid) requires -frtti"), "$1 is not supported"},
      {std::regex("(un)?signed _BitInt of bit sizes greater than .* not supported"), "an integer of too many bits"},
  };
  for (const auto& [pattern, plain] : words) text = std::regex_replace(text, pattern, plain);
  return text;
}

/// Of a call that stands for a pragma.
std::string pragma_words(const std::string& text) {
  static const std::regex unknown("use of undeclared identifier ('[^']*')(.*)");
  static const std::regex outside("a type specifier is required|expected|unknown type name");
  std::smatch found;
  if (std::regex_search(text, found, unknown))
    return fmt::format("there is no variable {} here{}", found[1].str(), found[2].str());
  if (std::regex_search(text, outside))
    return "stands outside of a function: put it into the function or loop that it speaks of";
  return text;
}

}  // namespace

std::string explain_messages(const std::string& messages, const pragma_places& pragmas) {
  const std::vector<message> all = parse(messages);
  std::string result;
  std::set<std::pair<std::string, unsigned>> told;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].kind == "note" || all[i].kind == "warning") continue;
    const message* at = &all[i];
    if (!is_users_file(at->file))  // the first note at a line of the user's is where it comes from
      for (std::size_t k = i + 1; k < all.size() && all[k].kind == "note"; ++k)
        if (is_users_file(all[k].file)) {
          at = &all[k];
          break;
        }
    if (!told.insert({at->file, at->line}).second) continue;  // what follows from the first error of a line
    if (told.size() > most_errors) break;
    const std::string place = fmt::format("{}:{}", shown_path(at->file), at->line);
    if (const auto pragma = pragmas.find({at->file, at->line}); pragma != pragmas.end()) {
      result += fmt::format("{}: error: #pragma HLS {}: {}\n", place, pragma->second, pragma_words(all[i].text));
      continue;
    }
    result += fmt::format("{}: error: {}{}\n{}", place, plain_words(all[i].text), advice_for(all[i].text), at->excerpt);
    for (std::size_t k = i + 1; k < all.size() && all[k].kind == "note"; ++k)
      if (const llvm::StringRef note = all[k].text; at == &all[i] && is_users_file(all[k].file) &&
                                                    !note.starts_with("in instantiation") &&
                                                    !note.ends_with("to silence this warning"))
        result += fmt::format("{}:{}: note: {}\n", shown_path(all[k].file), all[k].line, all[k].text);
  }
  if (result.empty()) result = "error: the source does not compile:\n" + messages;
  if (result.back() == '\n') result.pop_back();
  return result;
}

std::string explain_top(const std::string& top, const std::string& source, const std::string& listing) {
  // "Dumping NAME:" and on the next line "KIND 0x... <FILE:LINE:COLUMN, ...> ... 'TYPE'".
  static const std::regex head("^Dumping (.*):$");
  static const std::regex declaration(
      "^([A-Za-z]+)Decl 0x[0-9a-f]+ (?:parent 0x[0-9a-f]+ )?(?:prev 0x[0-9a-f]+ )?"
      "<([^>]*?):([0-9]+):[0-9]+[,>](.*)$");
  struct named {
    std::string name, kind, file, type;
    unsigned line;
  };
  std::vector<named> found;
  llvm::StringRef rest = listing;
  std::string name;
  while (!rest.empty()) {
    const auto [line, after] = rest.split('\n');
    rest = after;
    std::smatch parts;
    const std::string whole = line.str();
    if (std::regex_match(whole, parts, head)) {
      name = parts[1];
    } else if (!name.empty() && std::regex_match(whole, parts, declaration)) {
      const std::string type = llvm::StringRef(parts[4].str()).rsplit(" '").second.rsplit('\'').first.str();
      if (is_users_file(parts[2]))
        found.push_back({name, parts[1], parts[2], type, static_cast<unsigned>(std::stoul(parts[3]))});
      name.clear();
    }
  }
  const std::string wanted = llvm::StringRef(top).starts_with("::") ? top.substr(2) : top;
  const auto say = [&](const named& at, const std::string& text) {
    return fmt::format("{}:{}: error: '{}' {}", shown_path(at.file), at.line, top, text);
  };
  const named* exact = nullptr;
  for (const named& one : found) {
    if (one.name != wanted) continue;
    if (exact != nullptr && exact->kind == "Function" && one.kind == "Function" && one.type != exact->type)
      return say(one, "is overloaded: a top is one function: give it a name of its own");
    if (exact == nullptr || exact->kind != "Function") exact = &one;
  }
  if (exact != nullptr) {
    if (exact->kind == "FunctionTemplate")
      return say(*exact, "is a template: a top is one function: write a function that calls it with its arguments");
    if (exact->kind == "CXXMethod") return say(*exact, "is a member function: write a plain function that calls it");
    if (exact->kind != "Function")
      return say(*exact, fmt::format("is a {}, not a function: name the function to synthesize with --top",
                                     exact->kind == "Var" ? "variable" : "type"));
    if (const llvm::StringRef result = llvm::StringRef(exact->type).split('(').first.rtrim();
        result.ends_with("*") || result.ends_with("&"))
      return say(*exact, "returns a pointer or reference: return a value, or give results through an hls::stream");
    if (exact->type.find("...") != std::string::npos)
      return say(*exact, "takes a variable number of arguments: name every port");
    return say(*exact, "cannot be a top: a top is a function that takes hls::stream references and scalars");
  }
  for (const named& one : found) {
    if (!llvm::StringRef(one.name).ends_with("::" + wanted)) continue;
    if (one.kind == "CXXMethod") return say(one, "is a member function: write a plain function that calls it");
    if (one.kind == "Function")
      return say(one, fmt::format("is in a namespace: name it with that, --top {}", one.name));
  }
  return fmt::format("{}: error: there is no function '{}' in this file: name the function to synthesize with --top",
                     source, top);
}

}  // namespace epiline::frontend
