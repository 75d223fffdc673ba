// A short loop around loops that stay loops is no reason to make copies of them; a nest of constant loops outside of
// all others takes turns when it is long.
#include "ap_int.h"
#include "hls_stream.h"

void loops_in_loops(hls::stream<ap_uint<16>>& in, hls::stream<ap_uint<16>>& out) {
  const int size = 32;
  ap_uint<16> values[size];
  for (int i = 0; i < size; ++i) values[i] = in.read();
  for (int i = 0; i < size - 1; ++i)
    for (int j = 0; j < size - 1 - i; ++j)
      if (values[j] > values[j + 1]) {
        const ap_uint<16> kept = values[j];
        values[j] = values[j + 1];
        values[j + 1] = kept;
      }
  ap_uint<16> products[8][8];
  for (int row = 0; row < 8; ++row)
    for (int column = 0; column < 8; ++column) {
      ap_uint<16> sum = 0;
      for (int k = 0; k < 4; ++k) {
#pragma HLS PIPELINE
        sum += values[row * 4 + k] * values[k * 8 + column];
      }
      products[row][column] = sum;
    }
  for (int row = 0; row < 8; ++row)
    for (int column = 0; column < 8; ++column) out.write(products[row][column] + values[row]);
}
