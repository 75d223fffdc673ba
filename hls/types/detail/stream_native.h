#pragma once
// hls::stream for native builds: a named, counted ring buffer.

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <mutex>
#include <stdexcept>
#include <string>
#include <vector>

namespace hls {

/// A stream access that can never be served.
class stream_error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A stream that still holds tokens, or held some when it was destroyed.
struct leftover_stream {
  std::string name;
  std::size_t tokens = 0;
};

namespace detail {

class stream_base;

/// Every living stream, and the leftovers of the dead ones.
class stream_registry {
 public:
  // Never destroyed: streams of static storage duration outlive every other object.
  static stream_registry& instance() {
    static stream_registry* const registry = new stream_registry;
    return *registry;
  }
  std::uint64_t add(const stream_base* s) {
    const std::lock_guard<std::mutex> lock(mutex_);
    living_.push_back(s);
    return ++created_;
  }
  inline void remove(const stream_base* s);
  inline std::vector<leftover_stream> leftovers() const;
  /// From all living streams.
  inline std::uint64_t tokens_read() const;
  void forget() {
    const std::lock_guard<std::mutex> lock(mutex_);
    dead_.clear();
  }

 private:
  mutable std::mutex mutex_;
  std::vector<const stream_base*> living_;
  std::vector<leftover_stream> dead_;
  std::uint64_t created_ = 0;
};

/// What hls_task.h adds: functions that run beside the one that finds a stream empty, and may write a token into it.
class tasks_beside {
 public:
  /// Until the stream has a token, or nobody can go on.
  virtual void wait_for(const stream_base& s) = 0;
  /// In a task, which finds the stream empty or full: the others once. Outside: all, until the stream has a token
  /// (null: until nobody can go on).
  virtual void let_run(const stream_base* s) = 0;

 protected:
  ~tasks_beside() = default;
};
inline tasks_beside* tasks = nullptr;

}  // namespace detail

/// Called when a read finds a stream empty: a testbench that makes tokens up as they are asked for may write one into
/// it now. Null: there is none.
inline void (*on_empty_read)(const detail::stream_base& empty) = nullptr;
/// The same when a question, empty() or read_nb(), finds a stream empty.
inline void (*on_empty_question)(const detail::stream_base& empty) = nullptr;

/// Lets tasks (hls_task.h) run until none can go on.
inline void run_tasks() {
  if (detail::tasks != nullptr) detail::tasks->let_run(nullptr);
}

namespace detail {

/// What does not depend on the token type: name, counts, errors.
class stream_base {
 public:
  stream_base(const stream_base&) = delete;
  stream_base& operator=(const stream_base&) = delete;

  const std::string& name() const { return name_; }
  void set_name(const char* name) { name_ = name; }
  /// Tokens now in the stream.
  std::size_t size() const { return static_cast<std::size_t>(written_ - read_); }
  /// The depth; of a stream that says none, the largest std::size_t.
  std::size_t capacity() const { return depth_ == 0 ? std::numeric_limits<std::size_t>::max() : depth_; }
  bool empty() const { return written_ == read_; }
  bool full() const {
    if (is_full() && tasks != nullptr) tasks->let_run(this);
    return is_full();
  }
  std::uint64_t tokens_written() const { return written_; }
  std::uint64_t tokens_read() const { return read_; }
  /// The largest fill so far.
  std::size_t peak() const { return peak_; }

 protected:
  stream_base(std::size_t depth, const char* name) : depth_(depth) {
    const std::uint64_t number = stream_registry::instance().add(this);
    name_ = name != nullptr && *name != '\0' ? std::string(name) : "stream " + std::to_string(number);
  }
  ~stream_base() {
    if (!empty()) {
      std::fprintf(stderr, "hls::stream: '%s' is destroyed with %zu unread tokens (written %llu, read %llu)\n",
                   name_.c_str(), size(), static_cast<unsigned long long>(written_),
                   static_cast<unsigned long long>(read_));
    }
    stream_registry::instance().remove(this);
  }

  bool is_full() const { return depth_ != 0 && size() >= depth_; }
  /// Somebody else may write a token now.
  void find_token(bool reads) const {
    if (const auto hook = reads ? on_empty_read : on_empty_question; hook != nullptr) hook(*this);
    if (!empty() || tasks == nullptr) return;
    if (reads)
      tasks->wait_for(*this);
    else
      tasks->let_run(this);
  }
  void count_write() {
    ++written_;
    if (size() > peak_) peak_ = size();
  }
  void count_read() { ++read_; }
  [[noreturn]] void fail(const char* operation) const {
    const std::string depth = depth_ == 0 ? "unbounded" : "depth " + std::to_string(depth_);
    throw stream_error("hls::stream: " + std::string(operation) + " '" + name_ + "' can never be served: it holds " +
                       std::to_string(size()) + " tokens (" + depth + ", written " + std::to_string(written_) +
                       ", read " + std::to_string(read_) + ")");
  }

  std::uint64_t written_ = 0;
  std::uint64_t read_ = 0;

 private:
  std::string name_;
  std::size_t depth_;
  std::size_t peak_ = 0;
};

inline void stream_registry::remove(const stream_base* s) {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (std::size_t i = living_.size(); i-- > 0;) {
    if (living_[i] == s) {
      living_.erase(living_.begin() + static_cast<std::ptrdiff_t>(i));
      break;
    }
  }
  if (!s->empty()) dead_.push_back({s->name(), s->size()});
}

inline std::vector<leftover_stream> stream_registry::leftovers() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::vector<leftover_stream> result = dead_;
  for (const stream_base* s : living_) {
    if (!s->empty()) result.push_back({s->name(), s->size()});
  }
  return result;
}

inline std::uint64_t stream_registry::tokens_read() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::uint64_t sum = 0;
  for (const stream_base* s : living_) sum += s->tokens_read();
  return sum;
}

}  // namespace detail

/// Streams with tokens nobody read: those already destroyed, then the living ones, each in the order of creation.
inline std::vector<leftover_stream> leftover_streams() { return detail::stream_registry::instance().leftovers(); }

/// Forgets the leftovers of streams already destroyed, so that the next run of a top starts with a clean record.
inline void forget_leftover_streams() { detail::stream_registry::instance().forget(); }

/// Throws stream_error with every leftover's name and count, if there are any: the last line of a testbench.
inline void require_streams_drained() {
  std::string message;
  for (const leftover_stream& s : leftover_streams()) {
    message += (message.empty() ? "" : ", ") + ("'" + s.name + "' (" + std::to_string(s.tokens) + ")");
  }
  if (!message.empty()) throw stream_error("hls::stream: tokens left unread at the end in " + message);
}

template <class T, int DEPTH = 0>
class stream;

template <class T>
class stream<T, 0> : public detail::stream_base {
 public:
  using value_type = T;

  stream() : stream_base(0, nullptr) {}
  explicit stream(const char* name) : stream_base(0, name) {}
  explicit stream(const std::string& name) : stream_base(0, name.c_str()) {}
  ~stream() { delete[] slots_; }

  bool empty() const {
    if (stream_base::empty()) find_token(false);
    return stream_base::empty();
  }

  /// Takes the oldest token. Throws stream_error if there is none.
  T read() {
    if (stream_base::empty()) {
      find_token(true);
      if (stream_base::empty()) fail("read of");
    }
    T value = static_cast<T&&>(slots_[read_ & mask_]);
    count_read();
    return value;
  }
  void read(T& value) { value = read(); }
  void operator>>(T& value) { value = read(); }
  /// Takes a token if there is one; otherwise returns false and changes nothing.
  bool read_nb(T& value) {
    if (empty()) return false;
    value = read();
    return true;
  }

  /// Appends a token, whatever the depth: natively the reader runs when the writer has returned.
  void write(const T& value) {
    if (size() == slot_count_) grow();
    slots_[written_ & mask_] = value;
    count_write();
  }
  void operator<<(const T& value) { write(value); }
  /// Appends a token if there is room; otherwise returns false and changes nothing.
  bool write_nb(const T& value) {
    if (full()) return false;
    write(value);
    return true;
  }

 protected:
  stream(std::size_t depth, const char* name) : stream_base(depth, name) {}

 private:
  // A power of two, so that counts map to slots by a mask.
  void grow() {
    const std::size_t count = slot_count_ == 0 ? 16 : 2 * slot_count_;
    T* const bigger = new T[count];
    for (std::uint64_t i = read_; i != written_; ++i) bigger[i & (count - 1)] = static_cast<T&&>(slots_[i & mask_]);
    delete[] slots_;
    slots_ = bigger;
    slot_count_ = count;
    mask_ = count - 1;
  }

  // Not a std::unique_ptr, whose fifty functions a compiler would have to make for every type of token.
  T* slots_ = nullptr;
  std::size_t slot_count_ = 0;
  std::uint64_t mask_ = 0;
};

template <class T, int DEPTH>
class stream : public stream<T, 0> {
  static_assert(DEPTH > 0, "the depth of a stream is positive");

 public:
  stream() : stream(nullptr) {}
  explicit stream(const char* name) : stream<T, 0>(static_cast<std::size_t>(DEPTH), name) {}
  explicit stream(const std::string& name) : stream(name.c_str()) {}
};

}  // namespace hls
