#include "../drive.hpp"
namespace kernel_transform8 {
#include "../kernels/transform8.cpp"
}
using namespace kernel_transform8;

EPILINE_DRIVER(transform8) {
  auto& src = s.input<in_t>("src");
  auto& dst = s.output<out_t>("dst");
  std::vector<int> wanted;
  for (int call = 0; call < 20; ++call) {
    int v[8];
    for (int& e : v) {
      const in_t value = s.any<in_t>();
      src.push(value);
      e = int(value);
    }
    for (int k = 0; k < 8; ++k) {
      int sum = 0;
      for (int i = 0; i < 8; ++i) sum += __builtin_parity(unsigned(i & k)) ? -v[i] : v[i];
      wanted.push_back(sum);
    }
    transform8(src.stream, dst.stream);
  }
  s.expect_equal(dst.drain(), wanted, "dst");
}
