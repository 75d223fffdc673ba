#include "../drive.hpp"
namespace regression_computed_table {
#include "../regressions/computed_table.cpp"
}

EPILINE_DRIVER(computed_table) {
  auto& index = s.input<ap_uint<5>>("index");
  auto& word = s.output<ap_int<20>>("word");
  std::vector<int> wanted;
  for (int i = 0; i < 64; ++i) {
    index.push(i % 32);
    wanted.push_back((i % 8) * (i % 8) + 3 * (i % 32) - 40);
    regression_computed_table::computed_table(index.stream, word.stream);
  }
  s.expect_equal(word.drain(), wanted, "word");
}
