#include "../drive.hpp"
namespace regression_many_readers {
#include "../regressions/many_readers.cpp"
}

EPILINE_DRIVER(many_readers) {
  auto& left = s.input<ap_int<9>>("left");
  auto& right = s.input<ap_int<9>>("right");
  auto& out = s.output<ap_int<22>>("out");
  std::vector<int> wanted;
  for (int call = 0; call < 2; ++call) {
    int a[16][16], b[16][16];
    for (int i = 0; i < 256; ++i) {
      const auto x = s.any<ap_int<9>>(), y = s.any<ap_int<9>>();
      left.push(x);
      right.push(y);
      a[i / 16][i % 16] = x.to_int();
      b[i / 16][i % 16] = y.to_int();
    }
    for (int i = 0; i < 256; ++i) {
      int sum = 0;
      for (int k = 0; k < 16; ++k) sum += a[i / 16][k] * b[k][i % 16];
      wanted.push_back(sum);
    }
    regression_many_readers::many_readers(left.stream, right.stream, out.stream);
  }
  s.expect_equal(out.drain(), wanted, "out");
}
