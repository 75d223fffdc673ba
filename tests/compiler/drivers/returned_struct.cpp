#include "../drive.hpp"
namespace regression_returned_struct {
#include "../regressions/returned_struct.cpp"
}

EPILINE_DRIVER(returned_struct) {
  auto& in = s.input<ap_uint<8>>("in");
  auto& out = s.output<ap_uint<40>>("out");
  std::vector<unsigned> ring(16, 0);
  std::vector<std::uint64_t> wanted;
  for (unsigned i = 0; i < 200; ++i) {
    const unsigned x = (i * 37 + 11) % 256;
    in.push(x);
    ring.erase(ring.begin());
    ring.push_back(x);
    std::uint64_t word = 0;
    for (const unsigned k : {0u, 5u, 9u, 15u}) word = word << 8 | ring[(k + x) % 16];
    wanted.push_back(word << 8 | x);
    regression_returned_struct::returned_struct(in.stream, out.stream);
  }
  std::vector<std::uint64_t> found;
  for (const auto& word : out.drain()) found.push_back(word.to_uint64());
  s.expect_equal(found, wanted, "out");
}
