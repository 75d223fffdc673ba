#pragma once
// The subcommand `epiline board`.

#include <CLI/CLI.hpp>

#include "eval/engine.hpp"

namespace epiline::board {

/// `epiline board identify` and `epiline board self-test`. `exit_code` becomes 1 when the self-test finds a difference.
void add_board_command(CLI::App& application, const eval::engine_registry& registry, int& exit_code);

}  // namespace epiline::board
