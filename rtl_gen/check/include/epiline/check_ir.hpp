#pragma once
// Runs LLVM IR whose accesses of streams --check has turned into the calls below: the run-time part of its programs.
//
//   INPUT OUTPUT                 are the program's arguments: files of check_tokens.hpp

#include <ucontext.h>

#include <memory>

#include "check_tokens.hpp"

namespace epiline::check {

/// Tokens of an output, beyond those of a run that was stopped, after which it is stopped here too.
constexpr std::uint64_t surplus_tokens = 1000;

inline token token_of(const std::uint64_t* words, unsigned width) {
  return token(std::vector<std::uint64_t>(words, words + (width + 63) / 64));
}
inline void fill(std::uint64_t* words, const token& from, unsigned width) {
  for (unsigned i = 0; i < (width + 63) / 64; ++i) words[i] = i < from.words().size() ? from.words()[i] : 0;
}
inline token part_of(const token& whole, unsigned position, unsigned width) {
  token part;
  for (unsigned left = width; left > 0;) {
    const unsigned piece = left < 64 ? left : 64;
    part.put(whole.take(position, piece), piece);
    left -= piece;
  }
  return part;
}

// ---- the top as clang gives it: one thread, the calls one after another ---------------------------------------------

struct parameter {
  int port;         // of the network
  unsigned offset;  // of a scalar in the call's token
};

class source_run {
 public:
  source_run(std::vector<parameter> parameters, int call_port, std::vector<unsigned> inputs, char** argv)
      : parameters_(std::move(parameters)), call_port_(call_port), output_(argv[2]) {
    exchange_.load(argv[1]);
    for (const unsigned port : inputs) reads_[port] = 0;
  }

  /// A call begins with its first parameter.
  void parameter_comes(int number) {
    if (number != 0) return;
    if (is_first_) {
      is_first_ = false;
    } else {
      ++exchange_.calls;
      const std::uint64_t sum = reads();
      idle_calls_ = call_port_ < 0 && sum == reads_before_ ? idle_calls_ + 1 : 0;
      reads_before_ = sum;
      exchange_.call_is_done();
      if (idle_calls_ == most_idle_calls)
        exchange_.finish(output_, is_waiting_ ? ending::blocked : ending::endless, reads_);
      is_waiting_ = false;
      empty_answers_ = 0;
    }
    if (call_port_ < 0) return;
    if (exchange_.inputs[static_cast<unsigned>(call_port_)].empty())
      exchange_.finish(output_, ending::boundary, reads_);
    call_ = next(static_cast<unsigned>(call_port_));
  }
  void bind(int number, const void* stream) { ports_[stream] = parameters_[static_cast<std::size_t>(number)].port; }
  [[nodiscard]] bool is_argument(int number) const {
    return static_cast<int>(parameters_[static_cast<std::size_t>(number)].port) == call_port_;
  }
  [[nodiscard]] bool is_input(int number) const {
    return reads_.count(static_cast<unsigned>(parameters_[static_cast<std::size_t>(number)].port)) != 0;
  }
  token argument(int number, unsigned width) {
    return part_of(call_, parameters_[static_cast<std::size_t>(number)].offset, width);
  }
  void result(int number, const token& value) {
    exchange_.written(static_cast<unsigned>(parameters_[static_cast<std::size_t>(number)].port), value);
  }
  token read(const void* stream) {
    const auto port = ports_.find(stream);
    if (port != ports_.end()) {
      const auto number = static_cast<unsigned>(port->second);
      if (exchange_.inputs[number].empty()) exchange_.finish(output_, ending::blocked, reads_);
      return next(number);
    }
    std::deque<token>& queue = inner_[stream];
    if (queue.empty()) exchange::stop("a stream inside of the top", "is read before it is written");
    const token value = queue.front();
    queue.pop_front();
    return value;
  }
  /// Hardware waits where a source asks, so a call with scalars must not be used up.
  bool is_empty(const void* stream) {
    const auto port = ports_.find(stream);
    const bool answer =
        (port == ports_.end() ? inner_[stream] : exchange_.inputs[static_cast<unsigned>(port->second)]).empty();
    empty_answers_ = answer ? empty_answers_ + 1 : 0;
    if (answer && ((port != ports_.end() && call_port_ >= 0) || empty_answers_ == most_empty_answers))
      exchange_.finish(output_, ending::blocked, reads_);
    is_waiting_ = is_waiting_ || answer;
    return answer;
  }
  void write(const void* stream, const token& value) {
    const auto port = ports_.find(stream);
    if (port != ports_.end())
      exchange_.written(static_cast<unsigned>(port->second), value);
    else
      inner_[stream].push_back(value);
  }

  static source_run*& current() {
    static source_run* only = nullptr;
    return only;
  }

 private:
  token next(unsigned port) {
    ++reads_[port];
    const token value = exchange_.inputs[port].front();
    exchange_.inputs[port].pop_front();
    return value;
  }
  std::uint64_t reads() const {
    std::uint64_t sum = 0;
    for (const auto& [port, count] : reads_) sum += count;
    return sum;
  }

  std::vector<parameter> parameters_;
  int call_port_;
  const char* output_;
  exchange exchange_;
  std::map<unsigned, std::uint64_t> reads_;
  std::map<const void*, int> ports_;
  std::map<const void*, std::deque<token>> inner_;
  token call_;
  bool is_first_ = true;
  std::uint64_t reads_before_ = 0;
  unsigned idle_calls_ = 0;
  bool is_waiting_ = false;  // the call asked for a token that was not there
  unsigned empty_answers_ = 0;
};

// ---- lowered processes: each a coroutine that runs until it lacks a token or a place -------------------------------

/// Where a port of a process leads.
struct port_end {
  enum { top_port, fifo, call } what;
  unsigned number;                                      // of the network's port or FIFO
  std::vector<std::pair<unsigned, unsigned>> fields{};  // of a call port: offsets and widths in the top's token
};

struct process {
  void (*function)();
  std::vector<port_end> ports;
};

class lowered_run {
 public:
  /// `limits`: by network port, tokens of an output after which the run may stop; 0: without limit.
  lowered_run(std::vector<process> processes, std::vector<unsigned> depths, std::map<unsigned, std::uint64_t> limits,
              char** argv)
      : processes_(std::move(processes)), depths_(std::move(depths)), limits_(std::move(limits)), output_(argv[2]) {
    exchange_.load(argv[1]);
    fifos_.resize(depths_.size());
    contexts_.resize(processes_.size());
    calls_taken_.resize(processes_.size());
    for (std::size_t i = 0; i < processes_.size(); ++i) {
      constexpr std::size_t stack_bytes = 64u << 20;  // as much as it wants: untouched pages cost nothing
      stacks_.emplace_back(new char[stack_bytes]);
      getcontext(&contexts_[i]);
      contexts_[i].uc_stack.ss_sp = stacks_.back().get();
      contexts_[i].uc_stack.ss_size = stack_bytes;
      contexts_[i].uc_link = &scheduler_;
      makecontext(&contexts_[i], processes_[i].function, 0);
    }
  }

  [[noreturn]] void run() {
    current() = this;
    do {
      moved_ = false;
      for (now_ = 0; now_ < processes_.size(); ++now_) swapcontext(&scheduler_, &contexts_[now_]);
    } while (moved_ && !all_limits_reached());
    exchange_.finish(output_, moved_ ? ending::endless : ending::blocked, {});
  }

  token read(unsigned port) {
    const port_end& end = processes_[now_].ports[port];
    if (end.what == port_end::call) return read_call(end);
    std::deque<token>& queue = end.what == port_end::fifo ? fifos_[end.number] : exchange_.inputs[end.number];
    while (queue.empty()) wait();
    moved_ = true;
    const token value = queue.front();
    queue.pop_front();
    return value;
  }
  void write(unsigned port, const token& value, unsigned line) {
    const port_end& end = processes_[now_].ports[port];
    if (end.what == port_end::fifo) {
      while (fifos_[end.number].size() >= depths_[end.number]) wait();
      fifos_[end.number].push_back(value);
    } else {
      const std::uint64_t limit = limits_[end.number];
      while (limit != 0 && exchange_.outputs[end.number] >= limit) wait();
      exchange_.written(end.number, value, line);
    }
    moved_ = true;
  }

  static lowered_run*& current() {
    static lowered_run* only = nullptr;
    return only;
  }

 private:
  void wait() { swapcontext(&contexts_[now_], &scheduler_); }

  bool all_limits_reached() {
    for (const auto& [port, limit] : limits_)
      if (limit == 0 || exchange_.outputs[port] < limit) return false;
    return true;
  }

  token read_call(const port_end& end) {
    std::deque<token>& calls = exchange_.inputs[end.number];  // of all processes: they stay
    while (calls_taken_[now_] >= calls.size()) wait();
    moved_ = true;
    const token whole = calls[calls_taken_[now_]++];
    token value;
    for (const auto& [offset, width] : end.fields) {
      const token part = part_of(whole, offset, width);
      unsigned position = 0;
      for (unsigned left = width; left > 0;) {
        const unsigned piece = left < 64 ? left : 64;
        value.put(part.take(position, piece), piece);
        left -= piece;
      }
    }
    return value;
  }

  std::vector<process> processes_;
  std::vector<unsigned> depths_;
  std::map<unsigned, std::uint64_t> limits_;
  const char* output_;
  exchange exchange_;
  std::vector<std::deque<token>> fifos_;
  std::vector<std::size_t> calls_taken_;
  std::vector<ucontext_t> contexts_;
  std::vector<std::unique_ptr<char[]>> stacks_;
  ucontext_t scheduler_{};
  std::size_t now_ = 0;
  bool moved_ = false;
};

}  // namespace epiline::check

// The calls of the IR. Tokens are words of 64 bits, the lowest first.
extern "C" {
inline __attribute__((used)) void epiline_check_port(int parameter, const void* stream) {
  epiline::check::source_run::current()->parameter_comes(parameter);
  epiline::check::source_run::current()->bind(parameter, stream);
}
inline __attribute__((used)) void epiline_check_argument(int parameter, std::uint64_t* words, unsigned width) {
  epiline::check::source_run::current()->parameter_comes(parameter);
  epiline::check::fill(words, epiline::check::source_run::current()->argument(parameter, width), width);
}
/// What the top may write or only read: 0 or what it is given.
inline __attribute__((used)) void epiline_check_unwritten(int parameter, std::uint64_t* words, unsigned width) {
  epiline::check::source_run& run = *epiline::check::source_run::current();
  run.parameter_comes(parameter);
  epiline::check::fill(words, run.is_argument(parameter) ? run.argument(parameter, width) : epiline::check::token{},
                       width);
}
inline __attribute__((used)) void epiline_check_result(int parameter, const std::uint64_t* words, unsigned width) {
  epiline::check::source_run& run = *epiline::check::source_run::current();
  if (!run.is_argument(parameter)) run.result(parameter, epiline::check::token_of(words, width));
}
inline __attribute__((used)) void epiline_check_read(const void* stream, std::uint64_t* words, unsigned width) {
  epiline::check::fill(words, epiline::check::source_run::current()->read(stream), width);
}
inline __attribute__((used)) bool epiline_check_is_given(int parameter) {
  return epiline::check::source_run::current()->is_input(parameter);
}
inline __attribute__((used)) bool epiline_check_is_taken(int parameter) {
  return !epiline::check::source_run::current()->is_input(parameter);
}
inline __attribute__((used)) bool epiline_check_empty(const void* stream) {
  return epiline::check::source_run::current()->is_empty(stream);
}
inline __attribute__((used)) void epiline_check_write(const void* stream, const std::uint64_t* words, unsigned width) {
  epiline::check::source_run::current()->write(stream, epiline::check::token_of(words, width));
}
inline __attribute__((used)) void epiline_check_port_read(unsigned port, std::uint64_t* words, unsigned width) {
  epiline::check::fill(words, epiline::check::lowered_run::current()->read(port), width);
}
inline __attribute__((used)) void epiline_check_port_write(unsigned port, const std::uint64_t* words, unsigned width,
                                                           unsigned line) {
  epiline::check::lowered_run::current()->write(port, epiline::check::token_of(words, width), line);
}
}
