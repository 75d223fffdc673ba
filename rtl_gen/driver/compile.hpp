#pragma once
// The whole way from a C++ source to the files in the output folder.

#include "driver/command_line.hpp"

namespace epiline::driver {

/// Compiles, proves and checks as asked, and tells on standard output what became of it unless it is to be quiet.
/// Throws what with_messages tells of; then no file is left half written. Several tops are compiled each in a process
/// of its own, which tells of its errors itself. Returns the exit code.
[[nodiscard]] int compile(const command_line& given);

}  // namespace epiline::driver
