#include "../drive.hpp"
namespace kernel_prbs_checker {
#include "../kernels/prbs_checker.cpp"
}
using namespace kernel_prbs_checker;
EPILINE_LEAVES(status_t, v.locked, v.errors, v.total);

// The pattern's bits one after the other from the recurrence; a wrong bit now and then, a burst, a slip of one bit.
EPILINE_DRIVER(prbs_checker) {
  auto& line = s.input<ap_uint<32>>("line");
  auto& status = s.output<status_t>("status");
  std::vector<int> bits;
  for (int i = 0; i < 31; ++i) bits.push_back(i % 3 == 0);
  while (bits.size() < 32 * 260) bits.push_back(bits[bits.size() - 31] ^ bits[bits.size() - 28]);
  bits.erase(bits.begin(), bits.begin() + 31);
  std::vector<std::vector<int>> wanted;
  int good = 0, in_window = 0, bad = 0, total = 0;
  bool locked = false;
  std::uint32_t before = 0x7fffffff;
  for (int n = 0; n < 240; ++n) {
    std::uint32_t word = 0;
    for (std::size_t i = 0; i < 32; ++i)
      word = word << 1 | std::uint32_t(bits[std::size_t(n) * 32 + i + (n >= 150 ? 1 : 0)]);
    if (n > 20 && n < 150 && s.chance(20)) word ^= 1u << s.number(0, 31);
    if (n == 3 || n == 190) word = std::uint32_t(s.number(0, 0xffffffff));
    line.push(word);
    // What follows the last 31 bits that the checker goes by.
    std::uint32_t expected = 0;
    std::uint64_t history = before & 0x7fffffff;
    for (int i = 0; i < 32; ++i) {
      const std::uint64_t bit = (history >> 30 ^ history >> 27) & 1;
      history = history << 1 | bit;
      expected = expected << 1 | std::uint32_t(bit);
    }
    const int errors = __builtin_popcount(word ^ expected);
    if (!locked) {
      before = word;
      good = errors == 0 && word != 0 ? good + 1 : 0;
      if (good == 8) {
        locked = true;
        good = total = in_window = bad = 0;
      }
    } else {
      before = expected;
      total += errors;
      if (in_window++ % 64 == 63) bad = 0;
      if (errors != 0 && ++bad == 16) locked = false;
    }
    wanted.push_back({int(locked), errors, total});
    prbs_checker(line.stream, status.stream);
  }
  std::vector<std::vector<int>> found;
  for (const status_t& y : status.drain()) found.push_back({int(y.locked), int(y.errors), int(y.total)});
  s.expect_equal(found, wanted, "status");
  s.expect(found[140][0] == 1 && found[185][0] == 1 && found[239][0] == 1, "locked between the faults");
}
