#include "../drive.hpp"
namespace kernel_systolic_matrix {
#include "../kernels/systolic_matrix.cpp"
}
using namespace kernel_systolic_matrix;
EPILINE_LEAVES(column_t, v.e[0], v.e[1], v.e[2], v.e[3]);
EPILINE_LEAVES(row_t, v.e[0], v.e[1], v.e[2], v.e[3]);

EPILINE_DRIVER(systolic_matrix) {
  auto& a_columns = s.input<column_t>("a_columns");
  auto& b_rows = s.input<column_t>("b_rows");
  auto& c_rows = s.output<row_t>("c_rows");
  std::vector<int> wanted;
  for (int n = 0; n < 15; ++n) {
    int a[4][4], b[4][4];
    for (int k = 0; k < 4; ++k) {
      const column_t column = s.any<column_t>(), row = s.any<column_t>();
      a_columns.push(column);
      b_rows.push(row);
      for (int i = 0; i < 4; ++i) {
        a[i][k] = int(column.e[i]);
        b[k][i] = int(row.e[i]);
      }
    }
    for (const auto& row : a) {
      for (int j = 0; j < 4; ++j) {
        int sum = 0;
        for (int k = 0; k < 4; ++k) sum += row[k] * b[k][j];
        wanted.push_back(sum);
      }
    }
    systolic_matrix(a_columns.stream, b_rows.stream, c_rows.stream);
  }
  std::vector<int> found;
  for (const row_t& row : c_rows.drain()) {
    for (const sum_t& v : row.e) found.push_back(int(v));
  }
  s.expect_equal(found, wanted, "c_rows");
}
