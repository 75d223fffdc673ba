#include "../drive.hpp"
namespace kernel_matrix_vector {
#include "../kernels/matrix_vector.cpp"
}
using namespace kernel_matrix_vector;

EPILINE_DRIVER(matrix_vector) {
  auto& x = s.input<ap_int<8>>("x");
  auto& y = s.output<ap_int<19>>("y");
  std::vector<int> wanted;
  for (int call = 0; call < 12; ++call) {
    int vector[N];
    for (int& v : vector) {
      const ap_int<8> element = s.any<ap_int<8>>();
      v = int(element);
      x.push(element);
    }
    for (int i = 0; i < N; ++i) {
      int sum = 0;
      for (int j = 0; j < N; ++j) sum += weights[i][j] * vector[j];
      wanted.push_back(sum);
    }
    matrix_vector(x.stream, y.stream);
  }
  s.expect_equal(y.drain(), wanted, "y");
}
