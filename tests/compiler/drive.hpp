#pragma once
// Runs a top function natively and writes down what went in and what came out, token by token. The files
// ("NAME.tokens") are the stimulus and the expected answer for the other levels: the dataflow graph's interpreter and
// the RTL.
//
//   port x input stream tdata:12        a port and its signals with their widths in bits
//   token fff                           one token, one hexadecimal number a signal
//
// A driver is a function `EPILINE_DRIVER(name) { ... }`: `s` is its session. It pushes tokens into inputs, calls the
// top, and drains outputs; it may check what came out against an independent computation with `s.expect`.

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <fstream>
#include <memory>
#include <random>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "ap_axi_sdata.h"
#include "ap_int.h"
#include "hls_stream.h"

namespace epiline::compiler_test {

/// A bit vector, lowest bit first.
using bits = std::vector<bool>;

inline std::string to_hex(const bits& value) {
  std::string text;
  for (std::size_t nibble = (value.size() + 3) / 4; nibble-- > 0;) {
    unsigned digit = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      if (4 * nibble + i < value.size() && value[4 * nibble + i]) digit |= 1u << i;
    }
    text += "0123456789abcdef"[digit];
  }
  return text;
}

struct field_format {
  std::string signal;
  unsigned width;
};
using token = std::vector<bits>;  // one bit vector a field

/// Goes through the values of a payload, in the order of the hardware's signals, and notes their widths, writes them
/// into a token or takes them from one. One class for all of this, and code that depends on a value's C++ type in as
/// few and as short functions as possible: random programs have thousands of types, and each has to be compiled.
class token_visitor {
 public:
  enum class mode { format, get, set };
  token_visitor(mode m, token* t) : mode_(m), token_(t) {}

  /// The values that follow belong to the signal of this name.
  void begin_field(const char* signal) {
    if (mode_ == mode::format) format_.push_back({signal, 0});
    if (mode_ == mode::get) token_->emplace_back();
    ++field_;
    at_ = 0;
  }
  /// A value of `width` bits in the lowest bits of a built-in type; `is_signed` when it extends by its highest one.
  template <class Raw>
  void raw_value(Raw& value, unsigned width, bool is_signed) {
    if (mode_ == mode::format) format_.back().width += width;
    if (mode_ == mode::set) value = Raw(0);
    if (mode_ != mode::format) {
      const unsigned all = mode_ == mode::set && is_signed ? 8 * sizeof(Raw) : width;
      bits& field = (*token_)[field_];
      for (unsigned i = 0; i < all; ++i) {
        if (mode_ == mode::get) {
          field.push_back(test(value, i));
        } else if (field[at_ + std::min(i, width - 1)]) {
          set_bit(value, i);
        }
      }
    }
    at_ += width;
  }
  [[nodiscard]] const std::vector<field_format>& format() const { return format_; }
  [[nodiscard]] bool gets() const { return mode_ == mode::get; }
  [[nodiscard]] bool sets() const { return mode_ == mode::set; }
  /// One that replaces the token by what the values are now.
  [[nodiscard]] token_visitor reading_back() const {
    token_->clear();
    return {mode::get, token_};
  }

 private:
  template <class Raw>
  static bool test(const Raw& value, unsigned index) {
    if constexpr (std::is_class_v<Raw>) {
      return ((value.word(static_cast<int>(index / 64)) >> (index % 64)) & 1) != 0;
    } else {
      return ((value >> index) & 1) != 0;
    }
  }
  template <class Raw>
  static void set_bit(Raw& value, unsigned index) {
    if constexpr (std::is_class_v<Raw>) {
      const int word = static_cast<int>(index / 64);
      value.set_word(word, value.word(word) | std::uint64_t{1} << (index % 64));
    } else {
      value = static_cast<Raw>(value | static_cast<Raw>(Raw{1} << index));
    }
  }

  mode mode_;
  token* token_;
  std::vector<field_format> format_;
  std::size_t field_ = static_cast<std::size_t>(-1);
  std::size_t at_ = 0;
};

/// Specialise with EPILINE_LEAVES for a struct payload: its members in the order of declaration.
template <class T>
struct leaves_of;

// Use at global scope: EPILINE_LEAVES(rgb_t, v.r, v.g, v.b)
#define EPILINE_LEAVES(type, ...)                                           \
  template <>                                                               \
  struct epiline::compiler_test::leaves_of<type> {                          \
    static void visit(type& v, epiline::compiler_test::token_visitor& to) { \
      epiline::compiler_test::visit_values(to, __VA_ARGS__);                \
    }                                                                       \
  }

template <int W, bool S>
void visit_value(ap::ap_int_base<W, S>& value, token_visitor& to) {
  auto raw = value.to_raw();
  to.raw_value(raw, W, S);
  value = ap::ap_int_base<W, S>::from_raw(raw);
}
// In a payload as in memory: a bool takes a byte, of which only the lowest bit is ever 1.
inline void visit_value(bool& value, token_visitor& to) {
  std::uint8_t byte = value ? 1 : 0;
  to.raw_value(byte, 8, false);
  value = (byte & 1) != 0;
}
template <class T>
  requires std::is_integral_v<T>
void visit_value(T& value, token_visitor& to) {
  to.raw_value(value, 8 * sizeof(T), std::is_signed_v<T>);
}
template <class T>
  requires requires(T t, token_visitor v) { leaves_of<T>::visit(t, v); }
void visit_value(T& value, token_visitor& to) {
  leaves_of<T>::visit(value, to);
}
template <class... T>
void visit_values(token_visitor& to, T&... values) {
  (visit_value(values, to), ...);
}

/// A payload with AXI4-Stream sidebands.
template <class T>
concept axis_beat = requires(T t) {
  t.data;
  t.keep;
  t.strb;
  t.last;
};

/// All values of a payload, signal by signal.
template <class T>
void visit_payload(T& value, token_visitor& to) {
  to.begin_field("tdata");
  if constexpr (axis_beat<T>) {
    const auto side_channel = [&](const char* signal, auto& member) {
      to.begin_field(signal);
      visit_value(member, to);
    };
    visit_value(value.data, to);
    side_channel("tkeep", value.keep);
    side_channel("tstrb", value.strb);
    if constexpr (requires { value.user; }) side_channel("tuser", value.user);
    side_channel("tlast", value.last);
    if constexpr (requires { value.id; }) side_channel("tid", value.id);
    if constexpr (requires { value.dest; }) side_channel("tdest", value.dest);
  } else {
    visit_value(value, to);
  }
}
/// visit_payload of a type, so that what follows need not be compiled for each type.
using payload_visit = void (*)(void* value, token_visitor& to);
template <class T>
void visit_erased(void* value, token_visitor& to) {
  visit_payload(*static_cast<T*>(value), to);
}
inline std::vector<field_format> format_of(payload_visit visit, void* value) {
  token_visitor to(token_visitor::mode::format, nullptr);
  visit(value, to);
  return to.format();
}
inline token token_of(payload_visit visit, void* value) {
  token result;
  token_visitor to(token_visitor::mode::get, &result);
  visit(value, to);
  return result;
}

/// Goes through a token of a stream: reads one (mode get), writes one (mode set, after which the token is what was
/// written), or neither (mode format). All that random programs need of a type of token is in this function.
using stream_exchange = void (*)(hls::detail::stream_base* stream, token_visitor& to);
template <class T>
void exchange_tokens(hls::detail::stream_base* stream, token_visitor& to) {
  T value{};
  if (to.gets()) value = static_cast<hls::stream<T>*>(stream)->read();
  visit_payload(value, to);
  if (!to.sets()) return;
  token_visitor back = to.reading_back();
  visit_payload(value, back);
  static_cast<hls::stream<T>*>(stream)->write(value);
}

/// One port as written to the file.
struct channel {
  std::string name;
  std::string direction;  // input, output
  std::string kind;       // stream, call, result
  std::vector<field_format> fields;
  std::vector<token> tokens;
};

class session {
 public:
  explicit session(std::string name, std::uint64_t seed) : name_(std::move(name)), random_(seed) {}
  ~session() {
    for (port* made : ports_) made->destroy();
  }
  session(const session&) = delete;
  session& operator=(const session&) = delete;

  /// What does not depend on the type of the tokens.
  class port {
   public:
    port(session& s, channel& c, hls::detail::stream_base& stream, stream_exchange exchange, void (*destroy)(port*))
        : session_(s), channel_(c), stream_(stream), exchange_(exchange), destroy_(destroy) {}
    port(const port&) = delete;
    port& operator=(const port&) = delete;
    void destroy() { destroy_(this); }

    /// Writes random tokens into an input until it holds `count`.
    void fill_up(std::size_t count) {
      while (stream_.size() < count) {
        token t = session_.any_token(channel_.fields);
        token_visitor to(token_visitor::mode::set, &t);
        exchange_(&stream_, to);
        channel_.tokens.push_back(std::move(t));
      }
    }
    /// Takes the tokens of an input that were not read out again: how many a program reads is sometimes known only
    /// afterwards.
    void take_back() {
      for (; !stream_.empty(); channel_.tokens.pop_back()) static_cast<void>(take());
    }
    void finish() {
      if (channel_.direction == "input") session_.expect_drained(stream_);
      while (channel_.direction == "output" && !stream_.empty()) channel_.tokens.push_back(take());
    }

   protected:
    void record(payload_visit visit, void* value) { channel_.tokens.push_back(token_of(visit, value)); }

   private:
    token take() {
      token t;
      token_visitor to(token_visitor::mode::get, &t);
      exchange_(&stream_, to);
      return t;
    }
    session& session_;
    channel& channel_;
    hls::detail::stream_base& stream_;
    stream_exchange exchange_;
    void (*destroy_)(port*);
  };

  template <class T>
  class typed_port final : public port {
   public:
    typed_port(session& s, channel& c)
        : port(s, c, stream, exchange_tokens<T>, [](port* p) { delete static_cast<typed_port*>(p); }),
          stream(c.name.c_str()) {}
    void push(T value) {
      stream.write(value);
      this->record(visit_erased<T>, &value);
    }
    /// Takes all tokens written since the last time.
    std::vector<T> drain() {
      static_assert(!std::is_same_v<T, bool>, "a vector of bools has no elements to look at: use ap_uint<1>");
      std::vector<T> result;
      while (!stream.empty()) {
        result.push_back(stream.read());
        this->record(visit_erased<T>, &result.back());
      }
      return result;
    }
    hls::stream<T> stream;
  };

  template <class T>
  typed_port<T>& input(const char* name) {
    auto* made = new typed_port<T>(*this, add(name, "input", exchange_tokens<T>));
    ports_.push_back(made);
    return *made;
  }
  template <class T>
  typed_port<T>& output(const char* name) {
    auto* made = new typed_port<T>(*this, add(name, "output", exchange_tokens<T>));
    ports_.push_back(made);
    return *made;
  }

  /// One scalar by value of a call; all of a call's scalars in one `call`.
  struct argument {
    std::string name;
    unsigned width;
    bits value;
    template <class T>
    argument(const char* n, T v) : argument(n, visit_erased<T>, &v, std::is_same_v<T, bool>) {}

   private:
    argument(const char* n, payload_visit visit, void* v, bool is_bool) : name(n), value(token_of(visit, v)[0]) {
      if (is_bool) value.resize(1);  // a scalar has exactly its bits
      width = static_cast<unsigned>(value.size());
    }
  };
  void call(const std::vector<argument>& arguments) {
    channel* c = find("call");
    if (c == nullptr) {
      std::vector<field_format> fields;
      for (const argument& a : arguments) fields.push_back({a.name, a.width});
      c = &add("call", "input", "call", fields);
    }
    token t;
    for (const argument& a : arguments) t.push_back(a.value);
    c->tokens.push_back(t);
  }
  /// A scalar by reference after a call.
  template <class T>
  void result(const char* name, const T& value) {
    add_result(argument(name, value));
  }

  /// Uniform in [low, high].
  std::int64_t number(std::int64_t low, std::int64_t high) {
    return low + static_cast<std::int64_t>(random_() % static_cast<std::uint64_t>(high - low + 1));
  }
  bool chance(unsigned percent) { return random_() % 100 < percent; }
  /// A random token: uniform bits, or often one of the extremes (all zero, all one, only the top bit, all but the top
  /// bit).
  template <class T>
  T any() {
    T value{};
    fill(visit_erased<T>, &value);
    return value;
  }

  void expect(bool condition, const std::string& what) {
    if (condition) return;
    std::fprintf(stderr, "%s: native: %s\n", name_.c_str(), what.c_str());
    failed_ = true;
  }
  void expect_drained(const hls::detail::stream_base& stream) {
    expect(stream.empty(), "unread tokens in " + stream.name());
  }
  /// Compares a drained output with what an independent computation says.
  template <class T, class U>
  void expect_equal(const std::vector<T>& found, const std::vector<U>& wanted, const std::string& what) {
    expect(found.size() == wanted.size(),
           what + ": " + std::to_string(found.size()) + " tokens, expected " + std::to_string(wanted.size()));
    for (std::size_t i = 0; i < std::min(found.size(), wanted.size()); ++i) {
      if (found[i] == wanted[i]) continue;
      expect(false, what + ": token " + std::to_string(i) + " differs");
      return;
    }
  }

  /// Checks that nothing is left unread and writes the file. False if anything was wrong.
  bool finish(const std::string& directory) {
    for (port* made : ports_) made->finish();
    std::ofstream file(directory + "/" + name_ + ".tokens");
    for (const channel& c : channels_) {
      file << "port " << c.name << ' ' << c.direction << ' ' << c.kind;
      for (const field_format& f : c.fields) file << ' ' << f.signal << ':' << f.width;
      file << '\n';
      for (const token& t : c.tokens) {
        file << "token";
        for (const bits& b : t) file << ' ' << to_hex(b);
        file << '\n';
      }
    }
    file.close();
    expect(static_cast<bool>(file), "cannot write into " + directory);
    return !failed_;
  }

 private:
  void add_result(const argument& a) {
    channel* c = find(a.name);
    if (c == nullptr) c = &add(a.name, "output", "result", {{"tdata", a.width}});
    c->tokens.push_back({a.value});
  }
  void fill(payload_visit visit, void* value) {
    token t = any_token(format_of(visit, value));
    token_visitor to(token_visitor::mode::set, &t);
    visit(value, to);
  }
  token any_token(const std::vector<field_format>& format) {
    token t;
    for (const field_format& f : format) {
      const unsigned style = static_cast<unsigned>(random_() % 10);
      bits b(f.width);
      for (std::size_t i = 0; i < b.size(); ++i) {
        const bool top = i + 1 == b.size();
        b[i] = style == 0 ? false : style == 1 ? true : style == 2 ? top : style == 3 ? !top : (random_() & 1) != 0;
      }
      t.push_back(b);
    }
    return t;
  }
  channel* find(const std::string& name) {
    for (channel& c : channels_) {
      if (c.name == name) return &c;
    }
    return nullptr;
  }
  channel& add(const char* name, const char* direction, stream_exchange exchange) {
    token_visitor to(token_visitor::mode::format, nullptr);
    exchange(nullptr, to);
    return add(name, direction, "stream", to.format());
  }
  channel& add(const std::string& name, const char* direction, const char* kind, std::vector<field_format> fields) {
    channels_.push_back({name, direction, kind, std::move(fields), {}});
    return channels_.back();
  }

  std::string name_;
  std::mt19937_64 random_;
  std::deque<channel> channels_;  // a deque: the streams hold references
  std::vector<port*> ports_;
  bool failed_ = false;
};

using driver = void (*)(session&);
inline std::vector<std::pair<std::string, driver>>& drivers() {
  static std::vector<std::pair<std::string, driver>> all;
  return all;
}
struct registration {
  registration(const char* name, driver d) { drivers().emplace_back(name, d); }
};

#define EPILINE_DRIVER(name)                                                                \
  static void drive_##name(epiline::compiler_test::session& s);                             \
  static const epiline::compiler_test::registration registered_##name{#name, drive_##name}; \
  static void drive_##name([[maybe_unused]] epiline::compiler_test::session& s)

}  // namespace epiline::compiler_test
