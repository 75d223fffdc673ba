#pragma once
// Runs other programs: compilers, simulators, synthesis. Never through a shell.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace epiline::check {

enum class program_end { succeeded, failed, timed_out };

/// Where a program of the user's PATH is; empty: not installed.
[[nodiscard]] std::optional<std::string> find_program(const std::string& name);

/// Empty if a program is installed, or else a sentence that names its Debian package.
[[nodiscard]] std::string missing_program(const std::string& name, const std::string& package);

/// Runs `words` (the first is the program, see find_program) inside `folder`, for at most `seconds`. What it prints
/// goes to the file `log` in that folder. Throws std::runtime_error when it cannot be started at all.
program_end run_program(const std::vector<std::string>& words, const std::filesystem::path& folder,
                        const std::string& log, unsigned seconds);

/// The first lines of a log that say what went wrong: those with "error", or else the last ones.
[[nodiscard]] std::string what_went_wrong(const std::filesystem::path& log);

}  // namespace epiline::check
