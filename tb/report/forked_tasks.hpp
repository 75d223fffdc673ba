#pragma once
// Work on several cores, in processes: the native tops keep their state in static variables, as hardware does, so two
// of them cannot run in one process; and a task that crashes takes nothing else with it.

#include <functional>
#include <string>
#include <vector>

namespace epiline::report {

struct task_result {
  bool succeeded = false;
  std::string value;  // what the task returned, or why there is none
};

/// Runs each task in a process of its own that begins as a copy of this one, at most `jobs` at a time (1 or more), and
/// returns their results in order. What a task throws becomes its failure. `when_done(i)` is called in this process as
/// tasks end. This process must have no other thread. Throws std::system_error when processes cannot be made.
[[nodiscard]] std::vector<task_result> run_forked(const std::vector<std::function<std::string()>>& tasks, int jobs,
                                                  const std::function<void(std::size_t)>& when_done);

}  // namespace epiline::report
