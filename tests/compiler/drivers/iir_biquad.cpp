#include "../drive.hpp"
namespace kernel_iir_biquad {
#include "../kernels/iir_biquad.cpp"
}
using namespace kernel_iir_biquad;
EPILINE_LEAVES(section_t, v.b0, v.b1, v.b2, v.a1, v.a2);

EPILINE_DRIVER(iir_biquad) {
  auto& in = s.input<audio_t>("in");
  auto& out = s.output<audio_t>("out");
  // A low pass, a notch, and one that saturates.
  const int designs[3][2][5] = {{{400, 800, 400, -25576, 10792}, {1200, 2400, 1200, -20000, 8000}},
                                {{15000, -29000, 15000, -29000, 14000}, {16384, 0, 0, 0, 0}},
                                {{32767, 32767, 32767, -16384, 8192}, {32767, -32768, 32767, 16384, 4096}}};
  std::vector<int> wanted;
  for (const auto& design : designs) {
    section_t sections[2];
    for (int k = 0; k < 2; ++k) {
      const int* c = design[k];
      sections[k].b0 = c[0];
      sections[k].b1 = c[1];
      sections[k].b2 = c[2];
      sections[k].a1 = c[3];
      sections[k].a2 = c[4];
    }
    std::vector<std::vector<std::int64_t>> signal(3);  // what enters section 0, section 1, and what leaves
    const int samples = 60;
    for (int n = 0; n < samples; ++n) {
      audio_t beat = s.any<audio_t>();
      beat.data = n < 4 ? (n == 0 ? 32767 : 0) : n < 20 ? (n % 8 < 4 ? 32767 : -32768) : int(s.number(-20000, 20000));
      beat.last = n == samples - 1;
      in.push(beat);
      signal[0].push_back(int(beat.data));
      for (std::size_t k = 0; k < 2; ++k) {
        const auto at = [&](std::size_t which, int back) {
          return n < back ? std::int64_t{0} : signal[which][std::size_t(n - back)];
        };
        std::int64_t sum = 8192;
        for (int i = 0; i < 3; ++i) sum += design[k][i] * at(k, i);
        for (int i = 1; i < 3; ++i) sum -= design[k][2 + i] * at(k + 1, i);
        signal[k + 1].push_back(std::clamp<std::int64_t>(sum >> 14, -32768, 32767));
      }
    }
    wanted.insert(wanted.end(), signal[2].begin(), signal[2].end());
    s.call({{"first", sections[0]}, {"second", sections[1]}});
    iir_biquad(in.stream, out.stream, sections[0], sections[1]);
  }
  std::vector<int> found;
  for (const audio_t& beat : out.drain()) found.push_back(int(beat.data));
  s.expect_equal(found, wanted, "out");
}
