#include "frontend/stream_arrays.hpp"

#include <llvm/ADT/StringExtras.h>
#include <llvm/ADT/StringRef.h>
#include <llvm/IR/Constants.h>
#include <llvm/IR/Instructions.h>

#include <set>

#include "frontend/calls.hpp"
#include "frontend/pragmas.hpp"

namespace epiline::frontend {

namespace {

bool is_of_name(char c) { return llvm::isAlnum(c) || c == '_'; }

/// Where the bracket that opens at `open` is closed; npos: nowhere.
std::size_t closing(llvm::StringRef text, std::size_t open) {
  int depth = 0;
  for (std::size_t at = open; at < text.size(); ++at) {
    if (llvm::StringRef("([{").contains(text[at])) ++depth;
    if (llvm::StringRef(")]}").contains(text[at]) && --depth == 0) return at;
  }
  return llvm::StringRef::npos;
}

/// Splits a parameter list at its own commas, not at those of templates' arguments or in brackets.
std::vector<llvm::StringRef> split_parameters(llvm::StringRef list) {
  std::vector<llvm::StringRef> parts;
  std::size_t begin = 0;
  int angles = 0;
  for (std::size_t at = 0; at < list.size(); ++at) {
    if (llvm::StringRef("([{").contains(list[at])) {
      at = closing(list, at);
      if (at == llvm::StringRef::npos) return {};
    } else if (list[at] == '<') {
      ++angles;
    } else if (list[at] == '>') {
      --angles;
    } else if (list[at] == ',' && angles == 0) {
      parts.push_back(list.slice(begin, at));
      begin = at + 1;
    }
  }
  if (!list.trim().empty()) parts.push_back(list.drop_front(begin));
  return parts;
}

/// The name and the first brackets' EXPRESSION of `TYPE NAME[EXPRESSION]`; both empty for everything else.
std::pair<std::string, std::string> name_and_size(llvm::StringRef parameter) {
  parameter = parameter.rtrim();
  const auto ends_with_brackets = [&](std::size_t at) {
    while (at < parameter.size() && parameter[at] == '[')
      at = parameter.find_first_not_of(" \t\n", closing(parameter, at) + 1);
    return at == llvm::StringRef::npos || at == parameter.size();
  };
  std::size_t open = parameter.find('[');
  while (open != llvm::StringRef::npos && !ends_with_brackets(open))
    open = parameter.find('[', closing(parameter, open));
  if (open == llvm::StringRef::npos) return {};
  const llvm::StringRef before = parameter.take_front(open).rtrim();
  if (before.empty() || !is_of_name(before.back())) return {};
  std::size_t start = before.size();
  while (start > 0 && is_of_name(before[start - 1])) --start;
  return {before.drop_front(start).str(), parameter.slice(open + 1, closing(parameter, open)).trim().str()};
}

std::string without_line_markers(const std::string& preprocessed) {
  std::string text;
  llvm::StringRef rest = preprocessed;
  while (!rest.empty()) {
    const auto [line, after] = rest.split('\n');
    rest = after;
    if (!line.starts_with("# ")) text += line.str() + "\n";
  }
  return text;
}

/// The parameters of the function of that name where it is defined, behind all headers, which may have one of that
/// name.
std::vector<array_parameter> in_definition(llvm::StringRef text, llvm::StringRef name) {
  for (std::size_t at = text.rfind(name); at != llvm::StringRef::npos; at = text.take_front(at).rfind(name)) {
    if (at > 0 && is_of_name(text[at - 1])) continue;
    const std::size_t open = text.find_first_not_of(" \t\n", at + name.size());
    if (open == llvm::StringRef::npos || text[open] != '(') continue;
    const std::size_t close = closing(text, open);
    if (close == llvm::StringRef::npos) continue;
    const llvm::StringRef body = text.drop_front(close + 1).ltrim();
    if (!body.starts_with("{")) continue;  // a declaration or a call
    const std::set<std::string> streams = stream_ports(body.take_front(closing(body, 0)).str());
    std::vector<array_parameter> parameters;
    for (const llvm::StringRef parameter : split_parameters(text.slice(open + 1, close))) {
      const auto [parameter_name, size] = name_and_size(parameter);
      parameters.push_back({size, streams.count(parameter_name) != 0});
    }
    return parameters;
  }
  return {};
}

/// The calls of a function of call_top.hpp, wherever they stand.
std::vector<const llvm::CallInst*> notes(const llvm::Module& module, llvm::StringRef name) {
  std::vector<const llvm::CallInst*> calls;
  if (const llvm::Function* const function = module.getFunction(name))
    for (const llvm::User* user : function->users())
      if (const auto* call = llvm::dyn_cast<llvm::CallInst>(user)) calls.push_back(call);
  return calls;
}

/// What the call of the top notes: a number by the position of a parameter.
std::map<unsigned, unsigned> counts_noted(const llvm::Module& module, llvm::StringRef name) {
  std::map<unsigned, unsigned> counts;
  for (const llvm::CallInst* call : notes(module, name)) counts[number_in(*call, 0)] = number_in(*call, 1);
  return counts;
}

}  // namespace

std::vector<std::vector<array_parameter>> find_array_parameters(const std::string& preprocessed,
                                                                const std::vector<std::string>& tops) {
  const std::string text = without_line_markers(preprocessed);
  std::vector<std::vector<array_parameter>> parameters;
  for (const std::string& top : tops) parameters.push_back(in_definition(text, top.substr(top.rfind(':') + 1)));
  return parameters;
}

std::map<unsigned, unsigned> stream_arrays(llvm::Module& module) { return counts_noted(module, "__epiline_array"); }

std::map<unsigned, unsigned> value_arrays(llvm::Module& module) { return counts_noted(module, "__epiline_values"); }

std::map<unsigned, unsigned> data_arrays(llvm::Module& module) { return counts_noted(module, "__epiline_data"); }

unsigned returned_position(llvm::Module& module) {
  const std::vector<const llvm::CallInst*> calls = notes(module, "__epiline_returned");
  return calls.empty() ? 0 : number_in(*calls.front(), 0);
}

unsigned flat_index(const std::map<unsigned, unsigned>& arrays, unsigned position) {
  unsigned index = position;
  for (const auto& [at, count] : arrays)
    if (at < position) index += count - 1;
  return index;
}

}  // namespace epiline::frontend
