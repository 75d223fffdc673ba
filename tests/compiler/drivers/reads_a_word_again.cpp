#include "../drive.hpp"
namespace regression_reads_a_word_again {
#include "../regressions/reads_a_word_again.cpp"
}

EPILINE_DRIVER(reads_a_word_again) {
  auto& in = s.input<ap_int<33>>("in");
  auto& out = s.output<ap_uint<22>>("out");
  std::vector<unsigned> wanted;
  unsigned words[128] = {};
  for (int i = 0; i < 800; ++i) {
    // Often a word that is there already.
    const auto address = static_cast<unsigned>(s.number(0, 127));
    const auto token = s.chance(30) ? std::int64_t{words[address]} : s.number(0, 0x1ffff);
    in.push(ap_int<33>(token));
    unsigned& word = words[token & 127];
    unsigned now = word;
    if (now != token) {
      now = now << 8 & 0x3fffff;
    } else {
      unsigned steps[4];
      for (unsigned k = 0; k < 4; ++k) steps[k] = (now & 15) + k;
      steps[(now + token) & 3] ^= 1;
      now = (now + steps[token & 3]) & 0x3fffff;
    }
    if ((now >> 13 & 3) < (token & 3)) word |= (token >> 5) & 0xfff;
    wanted.push_back(now);
    regression_reads_a_word_again::reads_a_word_again(in.stream, out.stream);
  }
  s.expect_equal(out.drain(), wanted, "out");
}
