#pragma once
// The token files written by drive.hpp: what one program read and wrote, by port.

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "cosim/token_list.hpp"

namespace epiline::compiler_test {

struct recorded_field {
  std::string signal;  // "tdata", ... or the name of a scalar
  unsigned width = 1;
};

struct recorded_port {
  std::string name;
  bool input = true;
  std::string kind;  // stream, call, result
  std::vector<recorded_field> fields;
  std::vector<std::vector<std::string>> tokens;  // one hexadecimal number a field
};

/// Throws std::runtime_error naming the file and the line.
[[nodiscard]] std::vector<recorded_port> read_token_file(const std::filesystem::path& file);

/// Where a level keeps a signal in its tokens.
struct placed_field {
  std::string signal;
  unsigned width = 1;
  unsigned offset = 0;
};

/// The tokens in a level's own layout. Throws std::runtime_error when the signals or their widths are not the same.
[[nodiscard]] cosim::token_list lay_out(const recorded_port& port, const std::vector<placed_field>& fields,
                                        unsigned width);

/// "tdata=1f tlast=1".
[[nodiscard]] std::string describe(const std::vector<placed_field>& fields, const cosim::token_list& tokens,
                                   std::size_t index);

/// Empty if equal; otherwise names the first difference.
[[nodiscard]] std::string compare(const std::string& port, const std::vector<placed_field>& fields,
                                  const cosim::token_list& found, const cosim::token_list& wanted);

}  // namespace epiline::compiler_test
