#include "../drive.hpp"
namespace kernel_bitonic_sort {
#include "../kernels/bitonic_sort.cpp"
}
using namespace kernel_bitonic_sort;

EPILINE_DRIVER(bitonic_sort) {
  auto& in = s.input<beat_t>("in");
  auto& out = s.output<beat_t>("out");
  std::vector<int> wanted;
  for (int n = 0; n < 80; ++n) {
    beat_t beat = s.any<beat_t>();
    std::vector<int> keys;
    for (int i = 0; i < 16; ++i) {
      // 0 and 1 alone already show whether a network sorts; besides ascending, descending, and anything.
      const int key = n < 50 ? int(s.chance(50)) * 65535 : n == 50 ? i : n == 51 ? 16 - i : int(s.number(0, 65535));
      keys.push_back(key);
      beat.data.range(16 * i + 15, 16 * i) = key;
    }
    std::sort(keys.begin(), keys.end());
    wanted.insert(wanted.end(), keys.begin(), keys.end());
    wanted.push_back(int(beat.last) * 2 + int(beat.user));
    in.push(beat);
    bitonic_sort(in.stream, out.stream);
  }
  std::vector<int> found;
  for (const beat_t& beat : out.drain()) {
    for (int i = 0; i < 16; ++i) found.push_back(int(beat.data.range(16 * i + 15, 16 * i)));
    found.push_back(int(beat.last) * 2 + int(beat.user));
  }
  s.expect_equal(found, wanted, "out");
}
