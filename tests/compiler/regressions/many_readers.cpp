// A product of matrices, a whole row and a whole column a clock: sixteen words of one RAM at a time. Its Verilog was
// one array that sixteen ports read, for which synthesis took more memory than machines have.
#include "ap_int.h"
#include "hls_stream.h"

constexpr int size = 16;

void many_readers(hls::stream<ap_int<9>>& left, hls::stream<ap_int<9>>& right, hls::stream<ap_int<22>>& out) {
  ap_int<9> a[size][size], b[size][size];
  for (int i = 0; i < size; ++i) {
    for (int j = 0; j < size; ++j) {
#pragma HLS PIPELINE II = 1
      a[i][j] = left.read();
      b[i][j] = right.read();
    }
  }
  for (int i = 0; i < size; ++i) {
    for (int j = 0; j < size; ++j) {
#pragma HLS PIPELINE II = 1
      ap_int<22> sum = 0;
      for (int k = 0; k < size; ++k) sum += a[i][k] * b[k][j];
      out.write(sum);
    }
  }
}
