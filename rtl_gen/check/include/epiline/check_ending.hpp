#pragma once
// Why a run of calls stopped: told by the programs that --check builds, read by --check.

namespace epiline::check {

enum class ending {
  boundary,  // there was no further call
  blocked,   // a call lacked a token
  endless,   // it would go on for ever without further input
};

/// Calls that read nothing, one after another, before a top counts as one that goes on for ever, or waits if it asked
/// for a token.
constexpr unsigned most_idle_calls = 1000;
/// Questions for tokens, one after another in one call, before a top counts as one that waits.
constexpr unsigned most_empty_answers = 100000;

/// As it stands in a program's output, by ending.
inline constexpr const char* ending_names[] = {"boundary", "blocked", "endless"};

}  // namespace epiline::check
