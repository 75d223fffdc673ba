#include "../drive.hpp"
namespace kernel_scrambler {
#include "../kernels/scrambler.cpp"
}
using namespace kernel_scrambler;

EPILINE_DRIVER(scrambler) {
  auto& plain = s.input<block_t>("plain");
  auto& scrambled = s.output<block_t>("scrambled");
  std::vector<bool> history(58, true);  // newest last
  for (int i = 0; i < 100; ++i) {
    const block_t block = s.any<block_t>();
    plain.push(block);
    scrambler(plain.stream, scrambled.stream);
    const block_t found = scrambled.drain().at(0);
    s.expect(found.range(1, 0) == block.range(1, 0), "header");
    for (int b = 0; b < 64; ++b) {
      const bool bit = bool(block[2 + b]) ^ history[history.size() - 58] ^ history[history.size() - 39];
      history.push_back(bit);
      s.expect(bool(found[2 + b]) == bit, "bit");
    }
  }
}
