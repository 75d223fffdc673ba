#include "check/answer.hpp"

#include <fmt/format.h>
#include <llvm/ADT/StringExtras.h>
#include <llvm/ADT/StringRef.h>

#include <algorithm>

namespace epiline::check {

reference make_reference(const dataflow::network& n, const answer& native, std::vector<token_list> inputs,
                         tolerance how) {
  reference result{.inputs = std::move(inputs), .outputs = native.outputs, .at_least = {}, .places = {}};
  for (dataflow::port_id port = 0; port < n.ports.size(); ++port) {
    std::size_t least = native.outputs[port].size();
    // Of the iteration that lacks a token nothing happens, and a stream has at most one access in it. A top made of
    // processes may have stopped natively in the first of them, while the others had more to do.
    if (how == tolerance::iteration && native.end == ending::blocked)
      least = dataflow::is_single(n) && least > 0 ? least - 1 : std::min<std::size_t>(least, native.done[port]);
    result.at_least.push_back(least);
  }
  result.may_give_more = native.end == ending::endless ||
                         (how == tolerance::iteration && native.end == ending::blocked && !dataflow::is_single(n));
  return result;
}

std::string to_hexadecimal(const llvm::APInt& value) { return llvm::toString(value, 16, false, false, false); }

std::optional<llvm::APInt> from_hexadecimal(std::string_view digits, unsigned width) {
  llvm::APInt value;
  if (llvm::StringRef(digits).getAsInteger(16, value) || value.getActiveBits() > width) return std::nullopt;
  return value.zextOrTrunc(width);
}

std::string describe(const dataflow::port& port, const llvm::APInt& token) {
  std::string text;
  for (const dataflow::field& field : port.fields)
    text += fmt::format("{}{}={}", text.empty() ? "" : " ", field.signal,
                        to_hexadecimal(token.extractBits(field.width, field.offset)));
  return text;
}

difference compare(const dataflow::network& n, const reference& wanted, const std::vector<token_list>& outputs) {
  difference lacking;
  for (dataflow::port_id id = 0; id < n.ports.size(); ++id) {
    const dataflow::port& port = n.ports[id];
    if (port.input) continue;
    const token_list& found = outputs[id];
    const token_list& right = wanted.outputs[id];
    for (std::size_t i = 0; i < std::min(found.size(), right.size()); ++i)
      if (found[i] != right[i])
        return {id, i,
                fmt::format("output '{}': token {} of {} is {}, native {}", port.name, i, right.size(),
                            describe(port, found[i]), describe(port, right[i]))};
    if (lacking.port != dataflow::none) continue;  // wrong tokens say more than missing ones
    if (found.size() < wanted.at_least[id])
      lacking = {id, found.size(),
                 fmt::format("output '{}': {} tokens, native {}; the first that lacks is {}", port.name, found.size(),
                             right.size(), describe(port, right[found.size()]))};
    else if (found.size() > right.size() && !wanted.may_give_more)
      lacking = {id, right.size(),
                 fmt::format("output '{}': {} tokens, native {}; the first too many is {}", port.name, found.size(),
                             right.size(), describe(port, found[right.size()]))};
  }
  return lacking;
}

}  // namespace epiline::check
