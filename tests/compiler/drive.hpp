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
#include <deque>
#include <fstream>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <tuple>
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

/// Specialise with EPILINE_LEAVES for a struct payload: its members in the order of declaration.
template <class T>
struct leaves_of;

// Use at global scope: EPILINE_LEAVES(rgb_t, v.r, v.g, v.b)
#define EPILINE_LEAVES(type, ...)                              \
  template <>                                                  \
  struct epiline::compiler_test::leaves_of<type> {             \
    static auto tie(type& v) { return std::tie(__VA_ARGS__); } \
  }

template <class T>
struct leaf;  // one value of a token: width(), get, set

template <int W>
struct leaf<ap_uint<W>> {
  static constexpr unsigned width = W;
  static bits get(const ap_uint<W>& value) {
    bits result(W);
    for (int i = 0; i < W; ++i) result[static_cast<std::size_t>(i)] = bool(value[i]);
    return result;
  }
  static void set(ap_uint<W>& value, const bits& pattern) {
    value = 0;
    for (int i = 0; i < W; ++i) value[i] = pattern[static_cast<std::size_t>(i)];
  }
};
template <int W>
struct leaf<ap_int<W>> {
  static constexpr unsigned width = W;
  static bits get(const ap_int<W>& value) { return leaf<ap_uint<W>>::get(ap_uint<W>(value)); }
  static void set(ap_int<W>& value, const bits& pattern) {
    ap_uint<W> unsigned_value = 0;
    leaf<ap_uint<W>>::set(unsigned_value, pattern);
    value = unsigned_value;
  }
};
template <class T>
  requires std::is_integral_v<T>
struct leaf<T> {
  // In a payload as in memory: a bool takes a byte, of which only the lowest bit is ever 1.
  static constexpr unsigned width = 8 * sizeof(T);
  static bits get(T value) {
    bits result(width);
    for (unsigned i = 0; i < width; ++i) result[i] = ((static_cast<std::uint64_t>(value) >> i) & 1) != 0;
    return result;
  }
  static void set(T& value, const bits& pattern) {
    std::uint64_t number = 0;
    for (unsigned i = 0; i < width; ++i) number |= static_cast<std::uint64_t>(pattern[i]) << i;
    value = static_cast<T>(std::is_same_v<T, bool> ? number & 1 : number);
  }
};

struct field_format {
  std::string signal;
  unsigned width;
};
using token = std::vector<bits>;  // one bit vector a field

/// A payload with AXI4-Stream sidebands.
template <class T>
concept axis_beat = requires(T t) {
  t.data;
  t.keep;
  t.strb;
  t.last;
};

template <class T>
struct payload {
  static std::vector<field_format> format() { return {{"tdata", leaf<T>::width}}; }
  static token get(const T& value) { return {leaf<T>::get(value)}; }
  static void set(T& value, const token& t) { leaf<T>::set(value, t[0]); }
};

template <class T>
  requires requires(T t) { leaves_of<T>::tie(t); }
struct payload<T> {
  static std::vector<field_format> format() {
    T value{};
    unsigned width = 0;
    std::apply([&](auto&... member) { ((width += leaf<std::remove_cvref_t<decltype(member)>>::width), ...); },
               leaves_of<T>::tie(value));
    return {{"tdata", width}};
  }
  static token get(T value) {
    bits all;
    const auto append = [&](auto& member) {
      const bits part = leaf<std::remove_cvref_t<decltype(member)>>::get(member);
      all.insert(all.end(), part.begin(), part.end());
    };
    std::apply([&](auto&... member) { (append(member), ...); }, leaves_of<T>::tie(value));
    return {all};
  }
  static void set(T& value, const token& t) {
    std::ptrdiff_t at = 0;
    const auto take = [&](auto& member) {
      using member_t = std::remove_cvref_t<decltype(member)>;
      const auto begin = t[0].begin() + at;
      at += leaf<member_t>::width;
      leaf<member_t>::set(member, bits(begin, t[0].begin() + at));
    };
    std::apply([&](auto&... member) { (take(member), ...); }, leaves_of<T>::tie(value));
  }
};

template <axis_beat T>
struct payload<T> {
  /// Calls `visit(signal, member)` for every side channel the type has.
  template <class Beat, class Visitor>
  static void for_each(Beat& v, Visitor&& visit) {
    visit("tdata", v.data);
    visit("tkeep", v.keep);
    visit("tstrb", v.strb);
    if constexpr (requires { v.user; }) visit("tuser", v.user);
    visit("tlast", v.last);
    if constexpr (requires { v.id; }) visit("tid", v.id);
    if constexpr (requires { v.dest; }) visit("tdest", v.dest);
  }
  static std::vector<field_format> format() {
    std::vector<field_format> result;
    T value{};
    for_each(value, [&](const char* signal, auto& member) {
      result.push_back({signal, payload<std::remove_cvref_t<decltype(member)>>::format()[0].width});
    });
    return result;
  }
  static token get(T value) {
    token result;
    for_each(value, [&](const char*, auto& member) {
      result.push_back(payload<std::remove_cvref_t<decltype(member)>>::get(member)[0]);
    });
    return result;
  }
  static void set(T& value, const token& t) {
    std::size_t i = 0;
    for_each(value,
             [&](const char*, auto& member) { payload<std::remove_cvref_t<decltype(member)>>::set(member, {t[i++]}); });
  }
};

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
  session(const session&) = delete;
  session& operator=(const session&) = delete;

  template <class T>
  class input_stream {
   public:
    input_stream(channel& c, const std::string& name) : stream(name.c_str()), channel_(c) {}
    void push(const T& value) {
      stream.write(value);
      channel_.tokens.push_back(payload<T>::get(value));
    }
    /// Takes the tokens that were not read out again: how many a program reads is sometimes known only afterwards.
    void take_back() {
      while (!stream.empty()) {
        static_cast<void>(stream.read());
        channel_.tokens.pop_back();
      }
    }
    hls::stream<T> stream;

   private:
    channel& channel_;
  };

  template <class T>
  class output_stream {
   public:
    output_stream(channel& c, const std::string& name) : stream(name.c_str()), channel_(c) {}
    /// Takes all tokens written since the last time.
    std::vector<T> drain() {
      std::vector<T> result;
      while (!stream.empty()) {
        result.push_back(stream.read());
        channel_.tokens.push_back(payload<T>::get(result.back()));
      }
      return result;
    }
    hls::stream<T> stream;

   private:
    channel& channel_;
  };

  template <class T>
  input_stream<T>& input(const std::string& name) {
    auto made = std::make_shared<input_stream<T>>(add(name, "input", "stream", payload<T>::format()), name);
    at_end_.push_back([this, made, name] { expect(made->stream.empty(), "unread tokens in " + name); });
    return *made;
  }
  template <class T>
  output_stream<T>& output(const std::string& name) {
    auto made = std::make_shared<output_stream<T>>(add(name, "output", "stream", payload<T>::format()), name);
    at_end_.push_back([made] { made->drain(); });
    return *made;
  }

  /// One scalar by value of a call; all of a call's scalars in one `call`.
  struct argument {
    std::string name;
    unsigned width;
    bits value;
    template <class T>
    argument(std::string n, const T& v) : name(std::move(n)), width(leaf<T>::width), value(leaf<T>::get(v)) {
      if (std::is_same_v<T, bool>) value.resize(width = 1);  // a scalar has exactly its bits
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
  void result(const std::string& name, const T& value) {
    channel* c = find(name);
    const argument a(name, value);
    if (c == nullptr) c = &add(name, "output", "result", {{"tdata", a.width}});
    c->tokens.push_back({a.value});
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
    token t;
    for (const field_format& f : payload<T>::format()) {
      const unsigned style = static_cast<unsigned>(random_() % 10);
      bits b(f.width);
      for (std::size_t i = 0; i < b.size(); ++i) {
        const bool top = i + 1 == b.size();
        b[i] = style == 0 ? false : style == 1 ? true : style == 2 ? top : style == 3 ? !top : (random_() & 1) != 0;
      }
      t.push_back(b);
    }
    T value{};
    payload<T>::set(value, t);
    return value;
  }

  void expect(bool condition, const std::string& what) {
    if (condition) return;
    std::fprintf(stderr, "%s: native: %s\n", name_.c_str(), what.c_str());
    failed_ = true;
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
    for (const auto& step : at_end_) step();
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
  channel* find(const std::string& name) {
    for (channel& c : channels_) {
      if (c.name == name) return &c;
    }
    return nullptr;
  }
  channel& add(const std::string& name, const char* direction, const char* kind, std::vector<field_format> fields) {
    channels_.push_back({name, direction, kind, std::move(fields), {}});
    return channels_.back();
  }

  std::string name_;
  std::mt19937_64 random_;
  std::deque<channel> channels_;  // a deque: the streams hold references
  std::vector<std::function<void()>> at_end_;
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
