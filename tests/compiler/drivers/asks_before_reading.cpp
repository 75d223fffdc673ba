#include "../drive.hpp"
namespace regression_asks_before_reading {
#include "../regressions/asks_before_reading.cpp"
}

EPILINE_DRIVER(asks_before_reading) {
  using regression_asks_before_reading::word_t;
  auto& in = s.input<word_t>("in");
  auto& out = s.output<word_t>("out");
  auto& dropped = s.output<ap_uint<16>>("dropped");
  std::vector<int> forwarded, drops, lengths(32);
  for (int packet = 0; packet < 60; ++packet) {
    const int count = static_cast<int>(s.number(1, 9));
    bool is_kept = false;
    for (int i = 0; i < count; ++i) {
      word_t word = s.any<word_t>();
      word.last = i + 1 == count;
      in.push(word);
      int value = int(word.data(15, 0));
      if (i == 0) {
        is_kept = word.data[0];
        if (is_kept)
          value += ++lengths[std::size_t(int(word.data(12, 8)))] << 16;
        else
          drops.push_back(static_cast<int>(drops.size()) + 1);
      } else {
        value = word.data.to_int();
      }
      if (is_kept) forwarded.push_back(value);
      // Calls that find something and calls that find nothing.
      for (int calls = static_cast<int>(s.number(0, 3)); calls > 0; --calls)
        regression_asks_before_reading::asks_before_reading(in.stream, out.stream, dropped.stream);
    }
  }
  while (in.stream.size() > 0)
    regression_asks_before_reading::asks_before_reading(in.stream, out.stream, dropped.stream);
  for (int calls = 0; calls < 600; ++calls)
    regression_asks_before_reading::asks_before_reading(in.stream, out.stream, dropped.stream);
  std::vector<int> found;
  for (const word_t& word : out.drain()) found.push_back(word.data.to_int());
  s.expect_equal(found, forwarded, "out");
  s.expect_equal(dropped.drain(), drops, "dropped");
}
