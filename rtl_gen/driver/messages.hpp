#pragma once
// Every error of the user's as one message on standard error.

#include <functional>

namespace epiline::driver {

/// Runs `work` and returns its exit code; or tells of usage_error, frontend::refused, schedule::infeasible,
/// std::invalid_argument, check::cannot_check and emit::unknown_signal, and returns 1. Every other exception is an
/// error of epiline-hls, and ends the program with its report.
[[nodiscard]] int with_messages(const std::function<int()>& work);

}  // namespace epiline::driver
