#pragma once
// Token files, which people write and keep: stimulus for a top and, if they like, what it should answer.
//
//   # a comment
//   port in input stream tdata:12 tlast:1      # a port of the top, and its signals with their widths in bits
//   token fff 0                                # one token, one hexadecimal number a signal
//   port call input call width:11 height:11    # the scalars by value, one token a call
//   port out output stream tdata:8             # optional: what is expected
//   port found output result tdata:8           # a scalar by reference, one token a call

#include <filesystem>
#include <string>
#include <vector>

#include "check/answer.hpp"
#include "dataflow/network.hpp"

namespace epiline::check {

struct token_file {
  std::vector<token_list> tokens;  // by port of the network
  std::vector<bool> given;         // by port: it is in the file
};

/// Throws std::invalid_argument "FILE:LINE: error: ..." for what is no token file of this top.
[[nodiscard]] token_file read_token_file(const std::filesystem::path& file, const dataflow::network& n);

/// The same as a text.
[[nodiscard]] std::string to_text(const token_file& file, const dataflow::network& n);

}  // namespace epiline::check
