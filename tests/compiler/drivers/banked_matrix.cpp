#include "../drive.hpp"
namespace kernel_banked_matrix {
#include "../kernels/banked_matrix.cpp"
}
using namespace kernel_banked_matrix;

EPILINE_DRIVER(banked_matrix) {
  auto& in = s.input<in_t>("in");
  auto& out = s.output<out_t>("out");
  std::vector<int> wanted;
  for (int call = 0; call < 3; ++call) {
    int m[2][8][8];
    for (auto& matrix : m)
      for (auto& row : matrix)
        for (int& element : row) {
          const in_t token = s.any<in_t>();
          in.push(token);
          element = token.to_int();
        }
    for (int i = 0; i < 8; ++i)
      for (int j = 0; j < 8; ++j) {
        int sum = 0;
        for (int k = 0; k < 8; ++k) sum += m[0][i][k] * m[1][k][j];
        wanted.push_back(sum);
      }
    banked_matrix(in.stream, out.stream);
  }
  s.expect_equal(out.drain(), wanted, "product");
}
