#include <cmath>
#include <complex>

#include "../drive.hpp"
namespace kernel_fft64 {
#include "../kernels/fft64.cpp"
}
using namespace kernel_fft64;
EPILINE_LEAVES(complex_t, v.re, v.im);

// The textbook's loops over an array, with the kernel's word lengths; besides, close to the sums of the definition.
EPILINE_DRIVER(fft64) {
  auto& samples = s.input<complex_t>("samples");
  auto& spectrum = s.output<complex_t>("spectrum");
  const double turn = 2 * std::acos(-1.0);
  std::vector<int> wanted(2 * 63, 0);
  for (int block = 0; block < 6; ++block) {
    std::vector<int> re(64), im(64);
    for (int i = 0; i < 64; ++i) {
      const auto ki = std::size_t(i);
      switch (block) {
        case 0:
          re[ki] = i == 0 ? 32767 : 0;
          break;
        case 1:
          re[ki] = im[ki] = 23000;
          break;
        case 2:
          re[ki] = int(std::lround(30000 * std::cos(turn * 5 * i / 64)));
          break;
        case 3:
          re[ki] = i % 2 ? -32768 : 32767, im[ki] = -32768;
          break;  // beyond the circle: it wraps
        default:
          re[ki] = int(s.number(-23000, 23000)), im[ki] = int(s.number(-23000, 23000));
      }
      complex_t c;
      c.re = re[ki];
      c.im = im[ki];
      samples.push(c);
      fft64(samples.stream, spectrum.stream);
    }
    std::vector<std::complex<double>> exact(64);
    for (int k = 0; k < 64; ++k) {
      for (int i = 0; i < 64; ++i) {
        exact[std::size_t(k)] +=
            std::complex<double>(re[std::size_t(i)], im[std::size_t(i)]) * std::polar(1 / 64.0, -turn * i * k / 64);
      }
    }
    const auto rounded = [](std::int64_t v) { return int(std::int16_t((v + 16384) >> 15)); };
    for (int span = 32; span >= 1; span /= 2) {
      for (int first = 0; first < 64; first += 2 * span) {
        for (int i = 0; i < span; ++i) {
          const auto a = std::size_t(first + i), b = a + std::size_t(span);
          const std::int64_t c = std::lround(32767 * std::cos(turn * i / (2 * span)));
          const std::int64_t w = std::lround(32767 * std::sin(turn * i / (2 * span)));
          const std::int64_t dr = (re[a] - re[b]) >> 1, di = (im[a] - im[b]) >> 1;
          re[a] = (re[a] + re[b]) >> 1;
          im[a] = (im[a] + im[b]) >> 1;
          re[b] = rounded(dr * c + di * w);
          im[b] = rounded(di * c - dr * w);
        }
      }
    }
    for (std::size_t i = 0; i < 64; ++i) {
      wanted.push_back(re[i]);
      wanted.push_back(im[i]);
      std::size_t reversed = 0;
      for (std::size_t bit = 0; bit < 6; ++bit) reversed |= (i >> bit & 1) << (5 - bit);
      s.expect(block == 3 || std::abs(exact[reversed] - std::complex<double>(re[i], im[i])) < 6,
               "the definition's sums");
    }
  }
  std::vector<int> found;
  for (const complex_t& c : spectrum.drain()) {
    found.push_back(int(c.re));
    found.push_back(int(c.im));
  }
  wanted.resize(2 * 6 * 64);  // the end of the last block is still inside
  s.expect_equal(found, wanted, "spectrum");
}
