#include "../drive.hpp"
namespace kernel_viterbi {
#include "../kernels/viterbi.cpp"
}
using namespace kernel_viterbi;

// Frames with errors far enough from each other must come back as they were sent; with any errors, no other frame may
// lie nearer to what was received than the decoder's answer (short frames, all of them tried).
EPILINE_DRIVER(viterbi) {
  auto& symbols = s.input<symbol_t>("symbols");
  auto& bits = s.output<bit_t>("bits");
  const auto encoded = [](const std::vector<int>& message) {
    std::vector<int> sent;
    int before = 0, before2 = 0;
    for (const int bit : message) {
      sent.push_back((bit ^ before ^ before2) * 2 + (bit ^ before2));
      before2 = before;
      before = bit;
    }
    return sent;
  };
  const auto decoded = [&](const std::vector<int>& received) {
    for (std::size_t i = 0; i < received.size(); ++i) {
      symbol_t symbol = s.any<symbol_t>();
      symbol.data = received[i];
      symbol.last = i + 1 == received.size();
      symbols.push(symbol);
    }
    viterbi(symbols.stream, bits.stream);
    std::vector<int> found;
    for (const bit_t& b : bits.drain()) {
      found.push_back(int(b.data));
      s.expect(b.last == (found.size() == received.size()), "last");
    }
    return found;
  };
  for (const int length : {64, 30, 2, 3, 50}) {
    std::vector<int> message;
    for (int i = 0; i < length; ++i) message.push_back(i < length - 2 && s.chance(50));
    std::vector<int> received = encoded(message);
    for (std::size_t i = 4; i + 4 < received.size(); i += 9) received[i] ^= s.chance(50) ? 1 : 2;
    s.expect_equal(decoded(received), message, "a correctable frame");
  }
  const auto distance = [](const std::vector<int>& a, const std::vector<int>& b) {
    int sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += __builtin_popcount(unsigned(a[i] ^ b[i]));
    return sum;
  };
  for (int trial = 0; trial < 6; ++trial) {
    std::vector<int> received;
    for (int i = 0; i < 10; ++i) received.push_back(int(s.number(0, 3)));
    const std::vector<int> found = decoded(received);
    s.expect(found.size() == 10 && found[8] == 0 && found[9] == 0, "ends in state 0");
    int smallest = 100;
    for (int all = 0; all < 256; ++all) {
      std::vector<int> message;
      for (int i = 0; i < 10; ++i) message.push_back(i < 8 && (all >> i & 1) != 0);
      smallest = std::min(smallest, distance(encoded(message), received));
    }
    s.expect(distance(encoded(found), received) == smallest, "the nearest frame");
  }
}
