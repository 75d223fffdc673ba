#include "report/forked_tasks.hpp"

#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <exception>
#include <string_view>
#include <system_error>

namespace epiline::report {
namespace {

struct child {
  std::size_t task;
  pid_t process;
  int pipe;
  std::string bytes;
};

void write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) ::_exit(1);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

/// The first byte says whether the task succeeded.
[[noreturn]] void run_in_child(const std::function<std::string()>& task, int pipe) {
  std::string answer;
  try {
    answer = "+" + task();
  } catch (const std::exception& error) {
    answer = std::string("-") + error.what();
  }
  write_all(pipe, answer);
  ::_exit(0);  // no destructors: they belong to the process this one was copied from
}

child start(std::size_t index, const std::function<std::string()>& task) {
  int ends[2];
  if (::pipe(ends) != 0) throw std::system_error(errno, std::generic_category(), "cannot make a pipe");
  std::fflush(nullptr);
  const pid_t process = ::fork();
  if (process < 0) throw std::system_error(errno, std::generic_category(), "cannot make a process");
  if (process == 0) {
    ::close(ends[0]);
    run_in_child(task, ends[1]);
  }
  ::close(ends[1]);
  return {index, process, ends[0], {}};
}

/// Reads what is there. False at the end.
bool read_some(child& from) {
  char buffer[65536];
  const ssize_t count = ::read(from.pipe, buffer, sizeof buffer);
  if (count < 0) return errno == EINTR;
  from.bytes.append(buffer, static_cast<std::size_t>(count));
  return count > 0;
}

task_result finish(child& ended) {
  ::close(ended.pipe);
  int status = 0;
  while (::waitpid(ended.process, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFSIGNALED(status)) return {false, "its process was ended by signal " + std::to_string(WTERMSIG(status))};
  if (WEXITSTATUS(status) != 0 || ended.bytes.empty()) return {false, "its process ended without an answer"};
  return {ended.bytes.front() == '+', ended.bytes.substr(1)};
}

}  // namespace

std::vector<task_result> run_forked(const std::vector<std::function<std::string()>>& tasks, int jobs,
                                    const std::function<void(std::size_t)>& when_done) {
  std::vector<task_result> results(tasks.size());
  std::vector<child> running;
  std::size_t next = 0;
  while (next < tasks.size() || !running.empty()) {
    while (next < tasks.size() && running.size() < static_cast<std::size_t>(std::max(jobs, 1))) {
      running.push_back(start(next, tasks[next]));
      ++next;
    }
    std::vector<pollfd> waits;
    for (const auto& each : running) waits.push_back({each.pipe, POLLIN, 0});
    if (::poll(waits.data(), waits.size(), -1) < 0) continue;  // interrupted
    for (std::size_t i = waits.size(); i-- > 0;) {
      if (waits[i].revents == 0 || read_some(running[i])) continue;
      results[running[i].task] = finish(running[i]);
      when_done(running[i].task);
      running.erase(running.begin() + static_cast<std::ptrdiff_t>(i));
    }
  }
  return results;
}

}  // namespace epiline::report
