#include <algorithm>
#include <cstdint>

#include "../drive.hpp"
namespace regression_overflow_questions {
#include "../regressions/overflow_questions.cpp"
}
EPILINE_LEAVES(regression_overflow_questions::asked, v.product_is_large, v.sum_leaves, v.clamped_sum,
               v.clamped_difference, v.flags, v.sum, v.difference, v.product);

EPILINE_DRIVER(overflow_questions) {
  auto& in = s.input<ap_uint<64>>("in");
  auto& out = s.output<regression_overflow_questions::asked>("out");
  // The same in numbers that hold everything.
  const auto fits = [](auto exact, auto smallest, auto largest) { return exact >= smallest && exact <= largest; };
  for (int i = 0; i < 400; ++i) {
    std::uint64_t token = static_cast<std::uint64_t>(s.any<ap_uint<64>>());
    if (i % 4 == 1) token &= 0x0003ffff'0003000full;  // small factors: some products fit
    if (i % 4 == 2) token |= 0xffff8000'ffff8080ull;  // small negative ones
    in.push(token);
    regression_overflow_questions::overflow_questions(in.stream, out.stream);
    const auto answers = out.drain();
    s.expect(answers.size() == 1, "one answer");
    const auto& answer = answers.front();
    const std::int64_t a = static_cast<std::int8_t>(token), b = static_cast<std::int8_t>(token >> 8);
    s.expect(answer.product_is_large == ((token & 255) * (token >> 8 & 255) > 255), "product_is_large");
    s.expect(answer.sum_leaves == !fits(a + b, -128, 127), "sum_leaves");
    s.expect(answer.clamped_sum == std::clamp<std::int64_t>(a + b, -128, 127), "clamped_sum");
    const std::int64_t c = static_cast<std::int16_t>(token >> 16), d = static_cast<std::int16_t>(token >> 32);
    s.expect(answer.clamped_difference == std::clamp<std::int64_t>(c - d, -32768, 32767), "clamped_difference");
    const __int128 low = static_cast<std::uint32_t>(token), high = static_cast<std::uint32_t>(token >> 32);
    const __int128 lowest = static_cast<std::int32_t>(token), highest = static_cast<std::int32_t>(token >> 32);
    const __int128 all = 0xffffffffu, smallest = INT32_MIN, largest = INT32_MAX;
    unsigned flags = 0, bit = 1;
    for (const bool fitting : {fits(low + high, __int128{0}, all), fits(low - high, __int128{0}, all),
                               fits(low * high, __int128{0}, all), fits(lowest + highest, smallest, largest),
                               fits(lowest - highest, smallest, largest), fits(lowest * highest, smallest, largest)}) {
      if (!fitting) flags |= bit;
      bit *= 2;
    }
    s.expect(answer.flags == flags, "flags");
    const auto product_with_sign = static_cast<std::uint32_t>(lowest * highest);
    s.expect(answer.sum == static_cast<std::uint32_t>(low + high) + product_with_sign, "sum");
    s.expect(answer.difference == static_cast<std::uint32_t>(low - high), "difference");
    s.expect(answer.product == static_cast<std::uint32_t>(low * high), "product");
  }
}
