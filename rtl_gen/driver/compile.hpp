#pragma once
// The whole way from a C++ source to the files in the output folder.

#include "driver/command_line.hpp"

namespace epiline::driver {

/// Compiles, proves and checks as asked, and tells on standard output what became of it unless it is to be quiet.
/// Throws usage_error, frontend::refused, schedule::infeasible, std::invalid_argument and check::cannot_check, with
/// what the user is to read; then no file is left half written.
void compile(const command_line& given);

}  // namespace epiline::driver
