#pragma once
// Random numbers without state: a number is a function of a seed and of where it is used, so that a pixel's value
// depends neither on the order of rendering nor on the standard library at hand.

#include <cmath>
#include <cstdint>
#include <initializer_list>

namespace epiline::scenes {

/// 64 bits out of a seed and any integers. The mixing is the finaliser of SplitMix64.
[[nodiscard]] constexpr std::uint64_t hash(std::uint64_t seed, std::initializer_list<std::int64_t> counters) {
  const auto mix = [](std::uint64_t value) {
    value = (value ^ (value >> 30)) * 0xbf58476d1ce4e5b9u;
    value = (value ^ (value >> 27)) * 0x94d049bb133111ebu;
    return value ^ (value >> 31);
  };
  std::uint64_t state = mix(seed + 0x9e3779b97f4a7c15u);
  for (const std::int64_t counter : counters) {
    state = mix(state + 0x9e3779b97f4a7c15u + static_cast<std::uint64_t>(counter));
  }
  return state;
}

/// 0 <= number < 1, a multiple of 2^-32.
[[nodiscard]] constexpr double uniform(std::uint64_t hashed) { return static_cast<double>(hashed >> 32) * 0x1p-32; }

/// Integer, `low` .. `high` inclusive.
[[nodiscard]] constexpr int between(std::uint64_t hashed, int low, int high) {
  return low + static_cast<int>((hashed >> 32) % static_cast<std::uint64_t>(high - low + 1));
}

/// Nearly normal, mean 0, deviation 1, within -6 .. 6: twelve numbers of 16 bits added up, which is exact on any
/// machine.
[[nodiscard]] constexpr double gaussian(std::uint64_t seed, std::initializer_list<std::int64_t> counters) {
  std::uint64_t bits = hash(seed, counters);
  std::int64_t sum = 0;
  for (int word = 0; word < 3; ++word) {
    for (int part = 0; part < 4; ++part) sum += static_cast<std::int64_t>((bits >> (16 * part)) & 0xffff);
    bits = hash(bits, {word});
  }
  return static_cast<double>(2 * sum - 12 * 0xffff) * 0x1p-17;
}

}  // namespace epiline::scenes
