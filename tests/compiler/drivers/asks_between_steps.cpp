#include "../drive.hpp"
namespace regression_asks_between_steps {
#include "../regressions/asks_between_steps.cpp"
}

EPILINE_DRIVER(asks_between_steps) {
  using regression_asks_between_steps::word_t;
  auto& in = s.input<word_t>("in");
  auto& out = s.output<word_t>("out");
  auto& is_good = s.output<ap_uint<1>>("is_good");
  std::vector<int> wanted;
  std::vector<int> wanted_good;
  for (int packet = 0; packet < 80; ++packet) {
    const int count = static_cast<int>(s.number(1, 20));
    unsigned sums[2] = {0, 0};
    for (int i = 0; i < count; ++i) {
      word_t word = s.any<word_t>();
      word.last = i + 1 == count;
      in.push(word);
      const unsigned value = word.data.to_uint();
      wanted.push_back(static_cast<int>(value));
      for (int half = 0; half < 2; ++half) {
        const unsigned two = value >> (16 * half) & 0xffff;
        sums[half] += (two >> 8 | two << 8) & 0xffff;
        sums[half] = (sums[half] + (sums[half] >> 16)) & 0xffff;
      }
      for (int calls = static_cast<int>(s.number(0, 2)); calls > 0; --calls)
        regression_asks_between_steps::asks_between_steps(in.stream, out.stream, is_good.stream);
    }
    unsigned sum = sums[0] + sums[1];
    sum = (sum + (sum >> 16)) & 0xffff;
    wanted_good.push_back(sum % 2 == 0 ? 1 : 0);
  }
  for (int calls = 0; calls < 4000; ++calls)
    regression_asks_between_steps::asks_between_steps(in.stream, out.stream, is_good.stream);
  std::vector<int> found;
  for (const word_t& word : out.drain()) found.push_back(word.data.to_int());
  s.expect_equal(found, wanted, "out");
  s.expect_equal(is_good.drain(), wanted_good, "is_good");
}
