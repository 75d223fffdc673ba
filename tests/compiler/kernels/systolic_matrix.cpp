// C = A B of 4x4 matrices in an array of sixteen multiply-accumulate cells: rows of A come from the left and columns of
// B from above, each a clock later than its neighbour, and every cell hands both on.
#include "ap_int.h"
#include "hls_stream.h"

#define SIZE 4

typedef ap_int<8> element_t;
typedef ap_int<24> sum_t;

struct column_t {
  element_t e[SIZE];
};
struct row_t {
  sum_t e[SIZE];
};

void systolic_matrix(hls::stream<column_t>& a_columns, hls::stream<column_t>& b_rows, hls::stream<row_t>& c_rows) {
#pragma HLS INTERFACE axis port = a_columns
#pragma HLS INTERFACE axis port = b_rows
#pragma HLS INTERFACE axis port = c_rows
#pragma HLS INTERFACE ap_ctrl_none port = return
  element_t a_reg[SIZE][SIZE], b_reg[SIZE][SIZE];
  sum_t c[SIZE][SIZE];
  element_t a_skew[SIZE][SIZE], b_skew[SIZE][SIZE];
#pragma HLS ARRAY_PARTITION variable = a_reg complete dim = 0
#pragma HLS ARRAY_PARTITION variable = b_reg complete dim = 0
#pragma HLS ARRAY_PARTITION variable = c complete dim = 0
#pragma HLS ARRAY_PARTITION variable = a_skew complete dim = 0
#pragma HLS ARRAY_PARTITION variable = b_skew complete dim = 0
  for (int i = 0; i < SIZE; i++) {
    for (int j = 0; j < SIZE; j++) {
      a_reg[i][j] = b_reg[i][j] = 0;
      a_skew[i][j] = b_skew[i][j] = 0;
      c[i][j] = 0;
    }
  }

systole:
  for (int t = 0; t < 3 * SIZE - 2; t++) {
#pragma HLS PIPELINE II = 1
    column_t a = {}, b = {};
    if (t < SIZE) {
      a = a_columns.read();
      b = b_rows.read();
    }
    // Backwards, so that every cell still sees what its neighbours had before.
    for (int i = SIZE - 1; i >= 0; i--) {
#pragma HLS UNROLL
      for (int j = SIZE - 1; j >= 0; j--) {
#pragma HLS UNROLL
        const element_t from_left = j == 0 ? (i == 0 ? a.e[0] : a_skew[i][i - 1]) : a_reg[i][j - 1];
        const element_t from_above = i == 0 ? (j == 0 ? b.e[0] : b_skew[j][j - 1]) : b_reg[i - 1][j];
        c[i][j] += from_left * from_above;
        a_reg[i][j] = from_left;
        b_reg[i][j] = from_above;
      }
    }
    for (int i = 1; i < SIZE; i++) {
      for (int k = i - 1; k > 0; k--) {
        a_skew[i][k] = a_skew[i][k - 1];
        b_skew[i][k] = b_skew[i][k - 1];
      }
      a_skew[i][0] = a.e[i];
      b_skew[i][0] = b.e[i];
    }
  }

result:
  for (int i = 0; i < SIZE; i++) {
#pragma HLS PIPELINE II = 1
    row_t r;
    for (int j = 0; j < SIZE; j++) r.e[j] = c[i][j];
    c_rows.write(r);
  }
}
