#pragma once
// The subcommands of `epiline`. Each adds itself to the application and sets `exit_code` when it has run.

#include <CLI/CLI.hpp>

#include "eval/engine.hpp"

namespace epiline::eval {

/// `epiline match`: one engine on one pair.
void add_match_command(CLI::App& application, const engine_registry& registry);

/// `epiline compare`: several engines on one pair, compared bit for bit. `exit_code` becomes 1 when maps differ.
void add_compare_command(CLI::App& application, const engine_registry& registry, int& exit_code);

/// `epiline evaluate`: designs and OpenCV's matchers on a list of pairs, as a page and files of figures. `exit_code`
/// becomes 1 when a pair or a map could not be evaluated.
void add_evaluate_command(CLI::App& application, const engine_registry& registry, int& exit_code);

/// `epiline scene`: renders a synthetic stereo pair with its truth.
void add_scene_command(CLI::App& application);

}  // namespace epiline::eval
