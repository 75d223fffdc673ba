#include "check/program.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <llvm/Support/Program.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <stdexcept>
#include <thread>

namespace epiline::check {

namespace {

/// Waits for a process; false after `seconds`.
bool wait_for(pid_t child, unsigned seconds, int& status) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(seconds);
  // Short programs are not kept waiting, long ones are not asked all the time.
  auto pause = std::chrono::milliseconds(1);
  for (;;) {
    const pid_t done = waitpid(child, &status, WNOHANG);
    if (done == child) return true;
    if (done < 0) throw std::runtime_error("a program that was started cannot be waited for");
    if (std::chrono::steady_clock::now() >= end) return false;
    std::this_thread::sleep_for(pause);
    if (pause < std::chrono::milliseconds(20)) pause *= 2;
  }
}

}  // namespace

std::optional<std::string> find_program(const std::string& name) {
  const auto found = llvm::sys::findProgramByName(name);
  if (!found) return std::nullopt;
  return *found;
}

std::string missing_program(const std::string& name, const std::string& package) {
  return find_program(name) ? "" : fmt::format("{} is not installed (Debian package {})", name, package);
}

program_end run_program(const std::vector<std::string>& words, const std::filesystem::path& folder,
                        const std::string& log, unsigned seconds) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  // A group of its own, so that all it started can be ended with it.
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  posix_spawnattr_setpgroup(&attributes, 0);
  pid_t child = 0;
  const int failed = posix_spawn(&child, words.front().c_str(), &actions, &attributes, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  if (failed != 0) throw std::runtime_error(fmt::format("{} cannot be started", words.front()));
  int status = 0;
  if (!wait_for(child, seconds, status)) {
    kill(-child, SIGKILL);
    waitpid(child, &status, 0);
    return program_end::timed_out;
  }
  return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? program_end::succeeded : program_end::failed;
}

std::string what_went_wrong(const std::filesystem::path& log) {
  constexpr std::size_t most_lines = 3;
  std::ifstream in(log);
  std::vector<std::string> errors, all;
  for (std::string line; std::getline(in, line);) {
    if (line.empty()) continue;
    all.push_back(line);
    if (line.find("rror") != std::string::npos || line.find("ERROR") != std::string::npos) errors.push_back(line);
  }
  if (errors.size() > most_lines) errors.resize(most_lines);
  if (errors.empty()) errors.assign(all.size() > most_lines ? all.end() - most_lines : all.begin(), all.end());
  std::string text;
  for (const std::string& line : errors) text += (text.empty() ? "" : "; ") + line;
  return text.empty() ? "it says nothing" : text;
}

}  // namespace epiline::check
