#pragma once
// Drives a top natively: part of the program that --check writes around the user's source. It comes before the source,
// which may define macros of any name.

#include <ap_axi_sdata.h>
#include <ap_int.h>
#include <detail/stream_arrays.h>
#include <hls_stream.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <exception>
#include <memory>
#include <tuple>
#include <type_traits>
#include <utility>

#include "check_tokens.hpp"

namespace epiline::check {

using ap::ap_int_base;

/// How parameter `Index` is made of numbers: `visit(value, f)` calls f for each of them. Written by --check.
template <int Index>
struct members;

template <int W, bool S>
constexpr unsigned width_of(const ap_int_base<W, S>*) {
  return W;
}
template <class T>
constexpr std::enable_if_t<std::is_integral_v<T> || std::is_enum_v<T>, unsigned> width_of(const T*) {
  return 8 * sizeof(T);  // a bool takes a byte, of which only the lowest bit is ever 1
}

struct packer {
  token result;
  template <int W, bool S>
  void operator()(const ap_int_base<W, S>& value) {
    const ap_int_base<W, false> pattern(value);
    for (int low = 0; low < W; low += 64) {
      const int high = low + 63 < W ? low + 63 : W - 1;
      result.put(pattern.range(high, low).to_uint64(), static_cast<unsigned>(high - low + 1));
    }
  }
  template <class T>
  std::enable_if_t<std::is_integral_v<T> || std::is_enum_v<T>> operator()(const T& value) {
    result.put(static_cast<std::uint64_t>(value), 8 * sizeof(T));
  }
};

struct unpacker {
  const token& from;
  unsigned position = 0;
  template <int W, bool S>
  void operator()(ap_int_base<W, S>& value) {
    ap_int_base<W, false> pattern(0);
    for (int low = 0; low < W; low += 64) {
      const int high = low + 63 < W ? low + 63 : W - 1;
      pattern.range(high, low) =
          static_cast<unsigned long long>(from.take(position, static_cast<unsigned>(high - low + 1)));
    }
    value = pattern;
  }
  template <class T>
  std::enable_if_t<std::is_integral_v<T> || std::is_enum_v<T>> operator()(T& value) {
    const std::uint64_t number = from.take(position, 8 * sizeof(T));
    value = static_cast<T>(std::is_same_v<T, bool> ? number & 1 : number);
  }
};

/// Random numbers, the same with every compiler.
class random_source {
 public:
  void restart(std::uint64_t a, std::uint64_t b, std::uint64_t c) {
    state_ = a * 0x9e3779b97f4a7c15u + b * 0xbf58476d1ce4e5b9u + c;
  }
  std::uint64_t next() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  unsigned below(unsigned limit) { return static_cast<unsigned>(next() % limit); }

 private:
  std::uint64_t state_ = 0;
};

/// Fills an object with random numbers of at most `bits` significant bits: small ones as often as large ones, since
/// many numbers count something, and often the extremes.
struct randomizer {
  random_source& source;
  unsigned bits;
  token result = {};
  template <class T>
  void operator()(const T& value) {
    unsigned width = width_of(&value);
    const unsigned significant = bits < width ? bits : width;
    const unsigned style = source.below(10);
    const unsigned length = style < 5 ? source.below(significant + 1) : significant;
    for (unsigned low = 0; low < width; low += 64) {
      std::uint64_t piece = source.next();
      if (style == 5) piece = 0;
      if (style == 6) piece = ~std::uint64_t{0};
      const unsigned left = length > low ? length - low : 0;
      if (left < 64) piece &= (std::uint64_t{1} << left) - 1;
      if (style == 7 && left > 0 && left <= 64) piece = std::uint64_t{1} << (left - 1);
      if (std::is_same_v<T, bool>) piece &= 1;
      result.put(piece, width - low < 64 ? width - low : 64);
    }
  }
};

class slot {
 public:
  virtual ~slot() = default;
  /// Gives an input its token: a stream one more, a scalar that of the call.
  virtual void give(const token&) {}
  virtual token make_up(random_source&, unsigned /*bits*/) const { return {}; }
  /// Takes what the top has written.
  virtual std::vector<token> take() { return {}; }
  virtual const hls::detail::stream_base* stream() const { return nullptr; }
  virtual unsigned width() const = 0;
  /// An array's elements come before a call, or go after it.
  virtual void before_call() {}
  virtual void after_call() {}
  virtual std::uint64_t tokens_of_call() const { return 0; }
};

/// Calls f for each element of an array, or for the value.
template <class T, class F>
void each(T& value, F&& f) {
  if constexpr (std::is_array_v<T>)
    for (auto& element : value) f(element);
  else
    f(value);
}

/// A scalar, or an array of them: given to the top or, by reference, a result.
template <class T, int Index>
class value_slot : public slot {
 public:
  static constexpr bool is_bit = std::is_same_v<T, bool>;
  void give(const token& given) override {
    if (is_bit) {
      unsigned position = 0;
      std::uint64_t bit = given.take(position, 1);
      std::memcpy(&value_, &bit, 1);
    } else {
      members<Index>::visit(value_, unpacker{given});
    }
  }
  token make_up(random_source& source, unsigned bits) const override {
    if (is_bit) return token({source.next() & 1});
    randomizer random{source, bits};
    members<Index>::visit(value_, random);
    return random.result;
  }
  std::vector<token> take() override {
    token result;
    if (is_bit) {
      result.put(static_cast<std::uint64_t>(is_true()), 1);
    } else {
      packer pack;
      members<Index>::visit(value_, pack);
      result = pack.result;
    }
    return {result};
  }
  unsigned width() const override {
    unsigned bits = 0;
    members<Index>::visit(value_, [&](const auto& number) { bits += width_of(&number); });
    return is_bit ? 1 : bits;
  }

 protected:
  T value_{};

 private:
  bool is_true() const {
    unsigned char byte = 0;
    std::memcpy(&byte, &value_, 1);
    return byte != 0;
  }
};

template <class P, int Index>
class slot_of : public value_slot<std::remove_const_t<std::remove_reference_t<P>>, Index> {
 public:
  auto& pass() { return this->value_; }
};
template <class T, int Index>
class slot_of<T*, Index> : public value_slot<std::remove_const_t<T>, Index> {
 public:
  auto* pass() { return &this->value_; }
};
template <class T, std::size_t Size, int Index>
class slot_of<const T (&)[Size], Index> : public value_slot<T[Size], Index> {
 public:
  const T (&pass() const)[Size] { return this->value_; }
};

template <class T, int Depth, int Index>
class stream_slot : public slot {
 public:
  explicit stream_slot(hls::stream<T, Depth>& stream) : stream_(stream) {}
  void give(const token& given) override {
    T value{};
    members<Index>::visit(value, unpacker{given});
    stream_.write(value);
  }
  token make_up(random_source& source, unsigned bits) const override {
    T value{};
    randomizer random{source, bits};
    members<Index>::visit(value, random);
    return random.result;
  }
  std::vector<token> take() override {
    std::vector<token> all;
    while (stream_.size() > 0) {
      T value = stream_.read();
      packer pack;
      members<Index>::visit(value, pack);
      all.push_back(pack.result);
    }
    return all;
  }
  const hls::detail::stream_base* stream() const override { return &stream_; }
  unsigned width() const override {
    T value{};
    unsigned bits = 0;
    members<Index>::visit(value, [&](const auto& number) { bits += width_of(&number); });
    return bits;
  }

 private:
  hls::stream<T, Depth>& stream_;
};

/// An array whose elements are tokens.
template <class T, std::size_t Size, int Index>
class slot_of<hls::detail::data_of<T[Size]>, Index>
    : public stream_slot<std::remove_cv_t<std::remove_all_extents_t<T>>, 0, Index> {
  using element = std::remove_cv_t<std::remove_all_extents_t<T>>;

 public:
  slot_of() : stream_slot<element, 0, Index>(elements_) {}
  auto& pass() { return values_; }
  void before_call() override {
    visit(values_, [&](element& value) { value = elements_.read(); });
  }
  void after_call() override {
    visit(values_, [&](const element& value) { elements_.write(value); });
  }
  std::uint64_t tokens_of_call() const override { return sizeof(values_) / sizeof(element); }

 private:
  template <class U, class F>
  static void visit(U& value, F&& f) {
    if constexpr (std::is_array_v<U>)
      for (auto& part : value) visit(part, f);
    else
      f(value);
  }
  hls::stream<element> elements_;
  std::remove_cv_t<T> values_[Size]{};
};

/// A parameter: what is passed, and its slots.
template <class P, int Index>
class passed {
 public:
  static constexpr int count = 1;
  decltype(auto) pass() { return slot_.pass(); }
  void add_slots(std::vector<slot*>& slots) { slots.push_back(&slot_); }

 private:
  slot_of<P, Index> slot_;
};

template <class T, int Depth, int Index>
class passed<hls::stream<T, Depth>&, Index> {
 public:
  static constexpr int count = 1;
  hls::stream<T, Depth>& pass() { return stream_; }
  void add_slots(std::vector<slot*>& slots) { slots.push_back(&slot_); }

 private:
  hls::stream<T, Depth> stream_;
  stream_slot<T, Depth, Index> slot_{stream_};
};

template <class T, int Depth, std::size_t Count, int Index>
class passed<hls::stream<T, Depth> (&)[Count], Index> {
 public:
  static constexpr int count = Count;
  hls::stream<T, Depth> (&pass())[Count] { return streams_; }
  void add_slots(std::vector<slot*>& slots) {
    for (auto& stream : streams_) {
      made_.push_back(std::make_unique<stream_slot<T, Depth, Index>>(stream));
      slots.push_back(made_.back().get());
    }
  }

 private:
  hls::stream<T, Depth> streams_[Count];
  std::vector<std::unique_ptr<slot>> made_;
};

enum class role { input, output, scalar, result };
struct parameter {
  role what;
  unsigned port;   // of the network; all scalars have the call port's
  unsigned width;  // of a token, or of the scalar
};

/// A random call that takes longer is not used: seconds of processor time.
constexpr unsigned most_trial_seconds = 2;
constexpr unsigned most_trials = 40;

/// One run of a top.
class session {
 public:
  session(std::vector<parameter> parameters, std::vector<slot*> slots, void (*call)(void*), void* context)
      : parameters_(std::move(parameters)), slots_(std::move(slots)), call_(call), context_(context) {
    for (std::size_t i = 0; i < slots_.size(); ++i) {
      if (slots_[i]->width() != parameters_[i].width) {
        std::fprintf(stderr, "error: parameter %zu has %u bits natively and %u in hardware\n", i + 1,
                     slots_[i]->width(), parameters_[i].width);
        std::_Exit(3);
      }
      if (parameters_[i].what == role::scalar) call_port_ = static_cast<int>(parameters_[i].port);
    }
  }

  /// `drive INPUT OUTPUT`, or `drive random SEED TOKENS OUTPUT`: random tokens, as the top asks for them, until a
  /// stream has given TOKENS or as many calls have been made.
  [[noreturn]] void run(int argc, char** argv) {
    current() = this;
    hls::on_empty_read = [](const hls::detail::stream_base& s) { current()->on_empty(s); };
    hls::on_empty_question = [](const hls::detail::stream_base& s) { current()->on_question(s); };
    std::set_terminate([] { current()->on_terminate(); });
    output_ = argv[argc - 1];
    if (argc == 5) {
      seed_ = std::strtoull(argv[2], nullptr, 10);
      wanted_ = std::strtoull(argv[3], nullptr, 10);
      run_random();
    }
    exchange_.load(argv[1]);
    for (std::size_t i = 0; i < slots_.size(); ++i)
      if (parameters_[i].what == role::input)
        for (const token& t : exchange_.inputs[parameters_[i].port]) slots_[i]->give(t);
    for (;;) {
      if (call_port_ >= 0) {
        std::deque<token>& calls = exchange_.inputs[static_cast<unsigned>(call_port_)];
        if (calls.empty()) finish(ending::boundary);
        give_call(calls.front());
        calls.pop_front();
      }
      call_once();
      end_if_idle();
    }
  }

 private:
  static session*& current() {
    static session* only = nullptr;
    return only;
  }

  void give_call(const token& call) {
    unsigned position = 0;
    for (std::size_t i = 0; i < slots_.size(); ++i) {
      if (parameters_[i].what != role::scalar) continue;
      token part;
      for (unsigned left = parameters_[i].width; left > 0;) {
        const unsigned width = left < 64 ? left : 64;
        part.put(call.take(position, width), width);
        left -= width;
      }
      slots_[i]->give(part);
    }
    ++calls_taken_;
  }

  void call_once() {
    const std::uint64_t before = reads();
    is_waiting_ = false;
    empty_answers_ = 0;
    try {
      for (std::size_t i = 0; i < slots_.size(); ++i)
        if (parameters_[i].what == role::input) slots_[i]->before_call();
      call_(context_);
      hls::run_tasks();
      for (std::size_t i = 0; i < slots_.size(); ++i)
        if (parameters_[i].what == role::output) slots_[i]->after_call();
    } catch (const hls::stream_error&) {
      end_of_input();
    }
    collect(true);
    exchange_.call_is_done();
    ++exchange_.calls;
    idle_calls_ = call_port_ < 0 && reads() == before ? idle_calls_ + 1 : 0;
  }

  void end_if_idle() {
    if (idle_calls_ == most_idle_calls) finish(is_waiting_ ? ending::blocked : ending::endless);
  }

  void collect(bool whole) {
    for (std::size_t i = 0; i < slots_.size(); ++i)
      if (parameters_[i].what == role::output || (whole && parameters_[i].what == role::result))
        for (const token& t : slots_[i]->take()) exchange_.written(parameters_[i].port, t);
  }

  std::uint64_t reads() const {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < slots_.size(); ++i)
      if (parameters_[i].what == role::input) sum += slots_[i]->stream()->tokens_read();
    return sum;
  }

  void on_terminate() {
    try {
      if (std::current_exception()) std::rethrow_exception(std::current_exception());
    } catch (const hls::stream_error&) {
      end_of_input();
    } catch (const std::exception& error) {
      std::fprintf(stderr, "error: %s\n", error.what());
    } catch (...) {
    }
    std::abort();
  }

  /// A read that cannot be served ends the run, if it is one of the top's inputs.
  [[noreturn]] void end_of_input() {
    if (lacking_ == nullptr) {
      std::fprintf(stderr, "error: a stream inside of the top is read before it is written\n");
      std::_Exit(3);
    }
    if (is_trial_) std::_Exit(1);
    collect(false);
    finish(ending::blocked);
  }

  [[noreturn]] void finish(ending why) {
    std::map<unsigned, std::uint64_t> counts;
    for (std::size_t i = 0; i < slots_.size(); ++i)
      if (parameters_[i].what == role::input) counts[parameters_[i].port] = slots_[i]->stream()->tokens_read();
    if (call_port_ >= 0) counts[static_cast<unsigned>(call_port_)] = calls_taken_;
    exchange_.finish(output_, why, counts);
  }

  void on_empty(const hls::detail::stream_base& s) {
    lacking_ = nullptr;
    for (std::size_t i = 0; i < slots_.size(); ++i) {
      if (slots_[i]->stream() != &s) continue;
      lacking_ = &s;
      if (wanted_ == 0 || s.tokens_written() >= most_tokens_) {
        is_waiting_ = true;  // should it be a task that reads
        return;
      }
      const token made = slots_[i]->make_up(random_, token_bits_);
      if (!is_trial_) exchange_.made_up(parameters_[i].port, made);
      slots_[i]->give(made);
    }
  }

  /// Hardware waits where a source asks, so a call with scalars must not be used up. Without them some questions are
  /// answered by "empty": the call does nothing then.
  void on_question(const hls::detail::stream_base& s) {
    if (call_port_ >= 0) {
      on_empty(s);
      if (lacking_ != nullptr && s.size() == 0) end_of_input();
    } else if (wanted_ > 0 && random_.below(4) > 0) {
      on_empty(s);
    }
    if (s.size() > 0) {
      empty_answers_ = 0;
      return;
    }
    is_waiting_ = true;
    if (++empty_answers_ < most_empty_answers) return;
    lacking_ = &s;  // a top that never returns
    end_of_input();
  }

  // ---- random stimulus ----------------------------------------------------------------------------------------
  [[noreturn]] void run_random() {
    for (const slot* one : slots_) wanted_ = std::max(wanted_, one->tokens_of_call());
    most_tokens_ = 2 * wanted_;
    while (exchange_.calls < wanted_ && most_read() < wanted_) {
      bool any_blocked = false, good = false;
      unsigned blocked_trial = 0;
      for (unsigned trial = 0; trial < most_trials && !good; ++trial) {
        const int code = try_call(trial);
        good = code == 0;
        if (code == 1) {
          any_blocked = true;
          blocked_trial = trial;
        }
        if (good) random_call(trial);
      }
      if (good) {
        end_if_idle();
        continue;
      }
      if (any_blocked) random_call(blocked_trial);  // which does not return: a call that is never done
      if (exchange_.calls > 0) break;
      std::fprintf(stderr, "error: no random input was found that the top can be called with\n");
      std::_Exit(4);
    }
    finish(ending::boundary);
  }

  std::uint64_t most_read() const {
    std::uint64_t most = 0;
    for (std::size_t i = 0; i < slots_.size(); ++i)
      if (parameters_[i].what == role::input && slots_[i]->stream()->tokens_read() > most)
        most = slots_[i]->stream()->tokens_read();
    return most;
  }

  /// The next call, in a process of its own. Returns 0 when it came to its end in time, 1 when it asked for too many
  /// tokens, something else when it failed.
  int try_call(unsigned trial) {
    std::fflush(nullptr);
    const pid_t child = fork();
    if (child == 0) {
      const rlimit seconds{most_trial_seconds, most_trial_seconds};
      setrlimit(RLIMIT_CPU, &seconds);
      if (std::freopen("/dev/null", "w", stderr) == nullptr) std::_Exit(3);
      is_trial_ = true;
      const std::uint64_t before = written();
      random_call(trial);
      std::_Exit(written() - before > 16 * wanted_ ? 2 : 0);
    }
    int status = 0;
    if (child < 0 || waitpid(child, &status, 0) != child) return 3;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 3;
  }

  std::uint64_t written() const {
    std::uint64_t sum = 0;
    for (const auto& [port, count] : exchange_.outputs) sum += count;
    return sum;
  }

  void random_call(unsigned trial) {
    random_.restart(seed_, exchange_.calls, trial);
    // What does not work with any numbers may work with smaller ones: scalars first, then the streams' tokens too.
    const unsigned scalar_bits = trial == 0 ? 64 : trial < 30 ? 1 + (30 - trial) / 2 : 1 + (most_trials - trial) / 2;
    token_bits_ = trial < 20 ? ~0u : 1 + (most_trials - trial) / 2;
    if (call_port_ >= 0) {
      token call;
      for (std::size_t i = 0; i < slots_.size(); ++i) {
        if (parameters_[i].what != role::scalar) continue;
        const token made = slots_[i]->make_up(random_, scalar_bits);
        unsigned position = 0;
        for (unsigned left = parameters_[i].width; left > 0;) {
          const unsigned width = left < 64 ? left : 64;
          call.put(made.take(position, width), width);
          left -= width;
        }
      }
      if (!is_trial_) exchange_.made_up(static_cast<unsigned>(call_port_), call);
      give_call(call);
    }
    call_once();
  }

  std::vector<parameter> parameters_;
  std::vector<slot*> slots_;
  void (*call_)(void*);
  void* context_;
  exchange exchange_;
  const char* output_ = "";
  int call_port_ = -1;
  std::uint64_t calls_taken_ = 0;
  unsigned idle_calls_ = 0;
  bool is_waiting_ = false;  // the last call asked for a token that was not there
  unsigned empty_answers_ = 0;
  const hls::detail::stream_base* lacking_ = nullptr;
  std::uint64_t seed_ = 0;
  std::uint64_t wanted_ = 0;  // tokens to make up; 0: none are
  std::uint64_t most_tokens_ = 0;
  unsigned token_bits_ = 64;
  bool is_trial_ = false;
  random_source random_;
};

/// The index of the first member of each parameter: every stream of an array has one.
template <class... P>
constexpr int index_of(int position) {
  const int counts[] = {passed<P, 0>::count..., 0};
  int index = 0;
  for (int i = 0; i < position; ++i) index += counts[i];
  return index;
}

template <auto Top, class Result, class... P, int... Position>
[[noreturn]] void drive(std::integer_sequence<int, Position...>, std::vector<parameter> parameters, int argc,
                        char** argv) {
  using all_passed = std::tuple<passed<P, index_of<P...>(Position)>...>;
  static all_passed given;
  std::vector<slot*> slots;
  (std::get<Position>(given).add_slots(slots), ...);
  if constexpr (std::is_void_v<Result>) {
    session run(
        std::move(parameters), std::move(slots),
        [](void* all) { Top(std::get<Position>(*static_cast<all_passed*>(all)).pass()...); }, &given);
    run.run(argc, argv);
  } else {
    static slot_of<Result&, index_of<P...>(sizeof...(P))> returned;
    slots.push_back(&returned);
    session run(
        std::move(parameters), std::move(slots),
        [](void* all) { returned.pass() = Top(std::get<Position>(*static_cast<all_passed*>(all)).pass()...); }, &given);
    run.run(argc, argv);
  }
}

template <auto Top, class Counts, class Result, class... P, int... Position>
[[noreturn]] void drive_written(std::integer_sequence<int, Position...> positions, std::vector<parameter> parameters,
                                int argc, char** argv) {
  drive<Top, Result, typename hls::detail::as_written<P, Counts::at(Position)>::type...>(
      positions, std::move(parameters), argc, argv);
}

/// `Counts`: of the elements of each parameter that is written as an array, or 0.
template <auto Top, int... Counts, class Result, class... P>
[[noreturn]] void drive(Result (*)(P...), std::vector<parameter> parameters, int argc, char** argv) {
  drive_written<Top, hls::detail::element_counts<Counts...>, Result, P...>(
      std::make_integer_sequence<int, sizeof...(P)>(), std::move(parameters), argc, argv);
}

}  // namespace epiline::check
