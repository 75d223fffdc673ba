#pragma once
// Why a run of calls stopped: told by the programs that --check builds, read by --check.

namespace epiline::check {

enum class ending {
  boundary,  // there was no further call
  blocked,   // a call lacked a token
  endless,   // it would go on for ever without further input
};

/// As it stands in a program's output, by ending.
inline constexpr const char* ending_names[] = {"boundary", "blocked", "endless"};

}  // namespace epiline::check
