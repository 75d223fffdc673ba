#include <hls_math.h>

#include <array>
#include <cmath>

#include "../drive.hpp"
namespace kernel_magnitude {
#include "../kernels/magnitude.cpp"
}
EPILINE_LEAVES(kernel_magnitude::complex_t, v.re, v.im);
EPILINE_LEAVES(kernel_magnitude::polar_t, v.length, v.larger, v.rounded, v.left);
using namespace kernel_magnitude;

EPILINE_DRIVER(magnitude) {
  auto& in = s.input<complex_t>("in");
  auto& out = s.output<polar_t>("out");
  const auto wrapped = [](long long v) {
    return static_cast<long long>(static_cast<unsigned long long>(v) << 46) >> 46;
  };
  for (int call = 0; call < 30; ++call) {
    const auto limit = static_cast<unsigned>(s.number(0, (1 << 18) - 1));
    std::vector<std::array<long long, 4>> wanted, found;
    for (int i = 0; i < 8; ++i) {
      const complex_t z = s.any<complex_t>();
      in.push(z);
      // In units of 2^-8; the magnitude of what 18 bits without a sign cannot hold wraps.
      const long long re = z.re.to_int64(), im = z.im.to_int64();
      const auto length = static_cast<long long>(std::sqrt(static_cast<long double>(re * re + im * im))) % (1LL << 18);
      const long long down = re >> 8 << 8, up = -(-im >> 8 << 8), half = re >> 1;
      const long long nearest = half < 0 ? -((-half + 128) >> 8 << 8) : (half + 128) >> 8 << 8;
      const auto magnitude_of = [&](long long v) { return wrapped(v < 0 ? -v : v); };
      wanted.push_back({std::min<long long>(length, limit), std::max(magnitude_of(re), magnitude_of(im)),
                        wrapped((down & 0x3ffff) + (up & 0x3ffff) + (nearest & 0x3ffff)), re < 0});
    }
    s.call({{"limit", ap_uint<18>(limit)}});
    magnitude(in.stream, out.stream, ap_uint<18>(limit));
    for (const polar_t& p : out.drain())
      found.push_back({p.length.to_int64(), p.larger.to_int64(), p.rounded.to_int64(), p.left.to_int64()});
    s.expect(found == wanted, "polar");
  }
}
