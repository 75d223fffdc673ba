#pragma once
// hls::task for native builds: coroutines in one thread.

#include <ucontext.h>

#include <algorithm>
#include <exception>
#include <functional>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#define hls_thread_local thread_local

namespace hls {
namespace detail {

/// Runs the tasks in turns, each for one call of its function or until that lacks a token.
class task_runner final : public tasks_beside {
 public:
  /// Never destroyed, as the streams' registry.
  static task_runner& instance() {
    static task_runner* const runner = new task_runner;
    return *runner;
  }

  const void* add(std::function<void()> call) {
    tasks_.push_back(std::make_unique<coroutine>());
    coroutine& task = *tasks_.back();
    task.call = std::move(call);
    task.stack.reset(new char[stack_bytes]);  // what is not touched costs nothing
    getcontext(&task.context);
    task.context.uc_stack.ss_sp = task.stack.get();
    task.context.uc_stack.ss_size = stack_bytes;
    task.context.uc_link = nullptr;
    makecontext(&task.context, &task_runner::run_for_ever, 0);
    return &task;
  }
  void remove(const void* task) {
    tasks_.erase(std::remove_if(tasks_.begin(), tasks_.end(), [&](const auto& one) { return one.get() == task; }),
                 tasks_.end());
  }

  void wait_for(const stream_base& s) override {
    if (now_ == nullptr) return run(&s);
    now_->awaited = &s;
    while (s.size() == 0) leave();
    now_->awaited = nullptr;
  }
  void let_run(const stream_base* s) override {
    if (now_ == nullptr)
      run(s);
    else
      leave();
  }

 private:
  struct coroutine {
    std::function<void()> call;
    std::unique_ptr<char[]> stack;
    ucontext_t context{};
    const stream_base* awaited = nullptr;
  };

  static constexpr std::size_t stack_bytes = 16u << 20;
  /// Tasks that get their tokens from one that reads nothing can go on for ever.
  static constexpr unsigned most_turns = 100000;

  /// Until `s` has a token, or no task can go on. A task that reads nothing always can: that does not count.
  void run(const stream_base* s) {
    unsigned idle_turns = 0;
    for (unsigned turn = 0; idle_turns < 2 && (s == nullptr ? turn < most_turns : s->size() == 0); ++turn) {
      const std::uint64_t before = stream_registry::instance().tokens_read();
      for (std::size_t i = 0; i < tasks_.size(); ++i) {
        now_ = tasks_[i].get();
        if (now_->awaited == nullptr || now_->awaited->size() > 0) swapcontext(&caller_, &now_->context);
      }
      now_ = nullptr;
      if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
      idle_turns = stream_registry::instance().tokens_read() == before ? idle_turns + 1 : 0;
    }
  }

  void leave() { swapcontext(&now_->context, &caller_); }

  static void run_for_ever() {
    task_runner& runner = instance();
    for (;;) {
      try {
        runner.now_->call();
      } catch (...) {
        runner.failure_ = std::current_exception();
      }
      runner.leave();
    }
  }

  std::vector<std::unique_ptr<coroutine>> tasks_;
  coroutine* now_ = nullptr;  // null: the program that uses the tasks
  ucontext_t caller_{};
  std::exception_ptr failure_;
};

}  // namespace detail

class task {
 public:
  task() = default;
  /// `function` is called with these streams again and again, until the task is destroyed. What it throws, the access
  /// of a stream throws that made it run.
  template <class... P, class... A>
  explicit task(void (*function)(P...), A&... streams) {
    (*this)(function, streams...);
  }
  /// The same for a task that was made without a function, one of an array. The calls that a top makes later, for the
  /// streams that the task has already, mean nothing.
  template <class... P, class... A>
  void operator()(void (*function)(P...), A&... streams) {
    static_assert((std::is_reference_v<P> && ...), "the function of a task takes streams by reference");
    if (task_ != nullptr) return;
    detail::tasks = &detail::task_runner::instance();
    task_ = detail::task_runner::instance().add([function, &streams...] { function(streams...); });
  }
  task(const task&) = delete;
  task& operator=(const task&) = delete;
  ~task() {
    if (task_ != nullptr) detail::task_runner::instance().remove(task_);
  }

 private:
  const void* task_ = nullptr;
};

}  // namespace hls
