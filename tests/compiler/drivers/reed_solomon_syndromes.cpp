#include "../drive.hpp"
namespace kernel_reed_solomon_syndromes {
#include "../kernels/reed_solomon_syndromes.cpp"
}
using namespace kernel_reed_solomon_syndromes;
EPILINE_LEAVES(syndromes_t, v.s[0], v.s[1], v.s[2], v.s[3], v.s[4], v.s[5], v.s[6], v.s[7], v.s[8], v.s[9], v.s[10],
               v.s[11], v.s[12], v.s[13], v.s[14], v.s[15], v.error);

// Code words from a systematic encoder, intact or with some bytes changed; syndromes by powers of the field's
// generator.
EPILINE_DRIVER(reed_solomon_syndromes) {
  auto& in = s.input<byte_t>("in");
  auto& out = s.output<byte_t>("out");
  auto& syndromes = s.output<syndromes_t>("syndromes");
  std::vector<int> power = {1};
  for (int i = 1; i < 255; ++i) power.push_back(power.back() << 1 ^ (power.back() & 128 ? 0x11d : 0));
  const auto product = [&](int a, int b) {
    if (a == 0 || b == 0) return 0;
    const auto log = [&](int v) { return int(std::find(power.begin(), power.end(), v) - power.begin()); };
    return power[std::size_t((log(a) + log(b)) % 255)];
  };
  std::vector<int> generator = {1};  // highest power first: (x - a^0) ... (x - a^15)
  for (std::size_t i = 0; i < 16; ++i) {
    generator.push_back(0);
    for (std::size_t k = generator.size() - 1; k > 0; --k) generator[k] ^= product(generator[k - 1], power[i]);
  }
  std::vector<int> passed, wanted;
  for (const int data : {239, 1, 40, 40}) {
    std::vector<int> word;
    for (int i = 0; i < data; ++i) word.push_back(int(s.number(0, 255)));
    std::vector<int> rest = word;
    rest.resize(rest.size() + 16, 0);
    for (std::size_t i = 0; i < std::size_t(data); ++i) {
      const int factor = rest[i];
      for (std::size_t k = 0; k <= 16; ++k) rest[i + k] ^= product(generator[k], factor);
    }
    word.insert(word.end(), rest.end() - 16, rest.end());
    const bool broken = passed.size() > 260;
    for (int n = broken ? 3 : 0; n > 0; --n)
      word[std::size_t(s.number(0, int(word.size()) - 1))] ^= int(s.number(1, 255));
    bool any = false;
    for (std::size_t j = 0; j < 16; ++j) {
      int sum = 0;
      for (std::size_t i = 0; i < word.size(); ++i) sum ^= product(word[i], power[j * (word.size() - 1 - i) % 255]);
      wanted.push_back(sum);
      any = any || sum != 0;
    }
    wanted.push_back(any);
    s.expect(any == broken, "the reference itself");
    for (std::size_t i = 0; i < word.size(); ++i) {
      byte_t beat = s.any<byte_t>();
      beat.data = word[i];
      beat.last = i + 1 == word.size();
      in.push(beat);
      passed.push_back(word[i] * 2 + int(beat.last));
      reed_solomon_syndromes(in.stream, out.stream, syndromes.stream);
    }
  }
  std::vector<int> found;
  for (const byte_t& beat : out.drain()) found.push_back(int(beat.data) * 2 + int(beat.last));
  s.expect_equal(found, passed, "out");
  found.clear();
  for (const syndromes_t& y : syndromes.drain()) {
    for (const symbol_t& v : y.s) found.push_back(int(v));
    found.push_back(int(y.error));
  }
  s.expect_equal(found, wanted, "syndromes");
}
