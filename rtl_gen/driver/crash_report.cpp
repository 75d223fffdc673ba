#include "driver/crash_report.hpp"

#include <fcntl.h>
#include <llvm/Support/ErrorHandling.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string_view>

namespace epiline::driver {

namespace {

constexpr int exit_code = 70;

// Made in time: a signal handler may neither allocate nor lock.
std::string folder, source_path, command_path, command, kept_source;

bool write_all(int file, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(file, text.data(), text.size());
    if (written <= 0) return false;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

bool write_new_file(const std::string& path, std::string_view text) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL, 0600);
  if (file < 0) return false;
  const bool written = write_all(file, text);
  return ::close(file) == 0 && written;
}

/// Calls nothing but system calls.
[[noreturn]] void finish(std::string_view what) {
  const bool saved = ::mkdir(folder.c_str(), 0700) == 0 && write_new_file(source_path, kept_source) &&
                     write_new_file(command_path, command);
  write_all(STDERR_FILENO, "error: this is an error of epiline-hls: ");
  write_all(STDERR_FILENO, what);
  if (saved) {
    write_all(STDERR_FILENO, ": please report it with the source and the command in ");
    write_all(STDERR_FILENO, folder);
  } else {
    write_all(STDERR_FILENO, ": please report it with the source");
  }
  write_all(STDERR_FILENO, "\n");
  ::_exit(exit_code);
}

extern "C" void on_signal(int number) {
  switch (number) {
    case SIGSEGV:
      finish("it touched memory that it does not have (SIGSEGV)");
    case SIGABRT:
      finish("it aborted (SIGABRT)");
    case SIGFPE:
      finish("an impossible operation (SIGFPE)");
    default:
      finish("it was stopped by a signal");
  }
}

void on_fatal_error(void*, const char* reason, bool) { finish(reason); }

std::string quoted(std::string_view word) {
  if (word.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-+=./:,") ==
          std::string_view::npos &&
      !word.empty())
    return std::string(word);
  std::string result = "'";
  for (const char c : word) result += c == '\'' ? "'\\''" : std::string(1, c);
  return result + "'";
}

unsigned use_up_the_stack(unsigned depth) {
  volatile char room[4096];
  room[depth % sizeof room] = 1;
  return depth == 0 ? 0 : use_up_the_stack(depth - 1) + static_cast<unsigned char>(room[depth % sizeof room]);
}

}  // namespace

void crash_report_of_this_process() {
  const char* temporary = std::getenv("TMPDIR");
  folder = std::string(temporary != nullptr && *temporary != '\0' ? temporary : "/tmp") + "/epiline-hls-crash-" +
           std::to_string(::getpid());
  source_path = folder + "/source.cpp";
  command_path = folder + "/command.txt";
}

void watch_for_crashes(int argc, char** argv) {
  crash_report_of_this_process();
  for (int i = 0; i < argc; ++i) command += (i == 0 ? "" : " ") + quoted(argv[i]);
  command += "\n";

  static std::array<char, 1 << 16> stack;  // the program's own may be what is used up
  stack_t alternative{};
  alternative.ss_sp = stack.data();
  alternative.ss_size = stack.size();
  ::sigaltstack(&alternative, nullptr);
  struct sigaction action{};
  action.sa_handler = on_signal;
  action.sa_flags = SA_ONSTACK | SA_RESETHAND;
  for (const int number : {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT}) ::sigaction(number, &action, nullptr);
  llvm::install_fatal_error_handler(on_fatal_error);
}

void keep_for_crash_report(std::string source) { kept_source = std::move(source); }

void report_crash(const std::string& what) {
  std::string line = what;
  for (char& c : line)
    if (c == '\n') c = ' ';
  finish(line);
}

void crash_on_purpose(const std::string& kind) {
  if (kind == "exception") throw std::logic_error("made on purpose");
  if (kind == "fatal") llvm::report_fatal_error("made on purpose", false);
  if (kind == "signal") ::raise(SIGSEGV);
  if (kind == "stack") (void)use_up_the_stack(1u << 30);
}

}  // namespace epiline::driver
