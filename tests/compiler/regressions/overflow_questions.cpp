// Sums, differences and products that are compared with what their type holds, clamped to it, or asked for by
// compilers' builtins: the optimiser makes one instruction of each with a result and an overflow, which had no hardware
// form.
#include <cstdint>

#include "ap_int.h"
#include "hls_stream.h"

struct asked {
  std::uint8_t product_is_large;  // too large for 8 bits; any number but 0
  std::uint8_t sum_leaves;        // a + b does not fit 8 bits with a sign
  std::int8_t clamped_sum;
  std::int16_t clamped_difference;
  std::uint32_t flags;  // of the builtins: add, subtract, multiply; without and with a sign
  std::uint32_t sum, difference, product;
};

void overflow_questions(hls::stream<ap_uint<64>>& in, hls::stream<asked>& out) {
#pragma HLS PIPELINE
  const ap_uint<64> token = in.read();
  const ap_uint<8> first = token(7, 0), second = token(15, 8);
  const ap_uint<16> product = first * second;
  const auto a = static_cast<std::int8_t>(first.to_int()), b = static_cast<std::int8_t>(second.to_int());
  asked answer;
  answer.product_is_large = 255 < product ? 1 : 0;
  answer.sum_leaves = a + b > 127 || a + b < -128 ? 1 : 0;
  int sum = a + b;
  if (sum > 127) sum = 127;
  if (sum < -128) sum = -128;
  answer.clamped_sum = static_cast<std::int8_t>(sum);
  const auto c = static_cast<std::int16_t>(token(31, 16).to_int()),
             d = static_cast<std::int16_t>(token(47, 32).to_int());
  int difference = c - d;
  difference = difference > 32767 ? 32767 : difference < -32768 ? -32768 : difference;
  answer.clamped_difference = static_cast<std::int16_t>(difference);

  const auto low = static_cast<std::uint32_t>(token(31, 0).to_uint());
  const auto high = static_cast<std::uint32_t>(token(63, 32).to_uint());
  const auto signed_low = static_cast<std::int32_t>(low), signed_high = static_cast<std::int32_t>(high);
  std::int32_t ignored;
  answer.flags = __builtin_add_overflow(low, high, &answer.sum) ? 1 : 0;
  answer.flags |= __builtin_sub_overflow(low, high, &answer.difference) ? 2 : 0;
  answer.flags |= __builtin_mul_overflow(low, high, &answer.product) ? 4 : 0;
  answer.flags |= __builtin_add_overflow(signed_low, signed_high, &ignored) ? 8 : 0;
  answer.flags |= __builtin_sub_overflow(signed_low, signed_high, &ignored) ? 16 : 0;
  answer.flags |= __builtin_mul_overflow(signed_low, signed_high, &ignored) ? 32 : 0;
  answer.sum += static_cast<std::uint32_t>(ignored);
  out.write(answer);
}
