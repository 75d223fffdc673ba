#include <cmath>

#include "../drive.hpp"
namespace kernel_down_converter {
#include "../kernels/down_converter.cpp"
}
using namespace kernel_down_converter;
EPILINE_LEAVES(baseband_t, v.i, v.q);

// The CIC filter as what it is: three moving sums of sixteen samples, every sixteenth of them kept. The integrators'
// chain delays by two samples.
EPILINE_DRIVER(down_converter) {
  auto& samples = s.input<sample_t>("samples");
  auto& baseband = s.output<baseband_t>("baseband");
  std::vector<int> response = {1};
  for (int order = 0; order < 3; ++order) {
    std::vector<int> longer(response.size() + 15, 0);
    for (std::size_t i = 0; i < response.size(); ++i) {
      for (std::size_t k = 0; k < 16; ++k) longer[i + k] += response[i];
    }
    response = longer;
  }
  std::vector<int> wanted;
  for (int call = 0; call < 3; ++call) {
    const int count = 14;
    const int frequency = call == 0 ? 1 << 22 : int(s.number(0, (1 << 24) - 1));
    std::vector<std::int64_t> mixed[2];
    std::int64_t phase = 0;
    for (int n = 0; n < 16 * count; ++n) {
      const int x = call == 0 ? int(std::lround(2000 * std::cos(std::acos(-1.0) / 2 * n))) : int(s.any<sample_t>());
      samples.push(x);
      const auto sine = [&](std::int64_t turn) {
        return std::int64_t(std::lround(2047 * std::sin((double(turn & 255) + 0.5) / 128 * std::acos(-1.0))));
      };
      mixed[0].push_back(x * sine((phase >> 16) + 64));
      mixed[1].push_back(-x * sine(phase >> 16));
      phase += frequency;
    }
    for (int n = 15; n < 16 * count; n += 16) {
      for (const auto& signal : mixed) {
        std::int64_t sum = 0;
        for (int k = 0; k < int(response.size()); ++k) {
          if (n - 2 - k >= 0) sum += response[std::size_t(k)] * signal[std::size_t(n - 2 - k)];
        }
        wanted.push_back(int(std::int16_t(sum >> 20)));
      }
    }
    s.call({{"frequency", ap_uint<24>(frequency)}, {"count", ap_uint<16>(count)}});
    down_converter(samples.stream, baseband.stream, frequency, count);
  }
  std::vector<int> found;
  for (const baseband_t& b : baseband.drain()) {
    found.push_back(int(b.i));
    found.push_back(int(b.q));
  }
  s.expect_equal(found, wanted, "baseband");
}
