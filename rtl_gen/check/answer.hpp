#pragma once
// What a level was given and what it answered, and the comparison of two answers.

#include <llvm/ADT/APInt.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "check/include/epiline/check_ending.hpp"
#include "dataflow/network.hpp"

namespace epiline::check {

using token_list = std::vector<llvm::APInt>;

struct answer {
  std::vector<token_list> outputs;           // by port of the network
  std::vector<std::vector<unsigned>> lines;  // by port and token: number of the source line; only of lowered IR
  std::vector<token_list> made_up;           // by port: input of random stimulus
  std::vector<std::uint64_t> reads;          // by port; empty: the level does not tell
  std::vector<std::uint64_t> done;           // by port: tokens of calls that came to their end
  std::uint64_t calls = 0;
  ending end = ending::blocked;
};

/// The answer that others are compared with.
struct reference {
  std::vector<token_list> inputs;                // by port
  std::vector<token_list> outputs;               // by port
  std::vector<std::size_t> at_least;             // by port: what a level has to give of an output
  bool may_give_more = false;                    // tokens beyond `outputs` are nobody's business
  std::vector<std::vector<std::string>> places;  // by port and token: "file:line" of the write, "" = not known
};

/// How far a level may be behind a native run that stopped in the middle of a call.
enum class tolerance {
  none,       // it stops at the same read
  iteration,  // iterations take place as a whole or not at all
};

[[nodiscard]] reference make_reference(const dataflow::network& n, const answer& native, std::vector<token_list> inputs,
                                       tolerance how);

struct difference {
  dataflow::port_id port = dataflow::none;
  std::size_t token = 0;
  std::string text;  // "output 'out': token 3 of 10 is tdata=1f, native tdata=1e"
};

/// The first difference; with an empty text there is none. `outputs` are by port.
[[nodiscard]] difference compare(const dataflow::network& n, const reference& wanted,
                                 const std::vector<token_list>& outputs);

/// "tdata=1f tlast=1".
[[nodiscard]] std::string describe(const dataflow::port& port, const llvm::APInt& token);
/// Without leading zeros.
[[nodiscard]] std::string to_hexadecimal(const llvm::APInt& value);
/// The number of up to `width` bits that hexadecimal digits write; empty: others are among them, or it has more bits.
[[nodiscard]] std::optional<llvm::APInt> from_hexadecimal(std::string_view digits, unsigned width);

}  // namespace epiline::check
