#include <hls_np_channel.h>

#include <cmath>

#include "../drive.hpp"
namespace regression_channels_in_turn {
#include "../regressions/channels_in_turn.cpp"
}

EPILINE_DRIVER(channels_in_turn) {
  using regression_channels_in_turn::number_t;
  auto& in = s.input<number_t>("in");
  auto& out = s.output<number_t>("out");
  // Tasks keep their streams for good: these outlive the session.
  static hls::stream<number_t> given("given"), taken("taken");
  std::vector<unsigned> wanted;
  for (unsigned i = 0; i < 300; ++i) {
    const number_t value = s.any<number_t>();
    in.push(value);
    given.write(in.stream.read());
    const std::uint64_t x = (value.to_uint64() + 1) & 0xffffff;
    const auto root = static_cast<std::uint64_t>(std::sqrt(static_cast<double>(x & 0x3ff)));
    wanted.push_back(static_cast<unsigned>((x * x + root) & 0xffffff) ^ 1);
  }
  regression_channels_in_turn::channels_in_turn(given, taken);
  while (!taken.empty()) out.stream.write(taken.read());
  s.expect_equal(out.drain(), wanted, "out");
}
