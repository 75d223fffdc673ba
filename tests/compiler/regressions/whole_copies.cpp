// Memories that are cleared, copied and assigned as a whole, beside registers that are.
#include <cstring>

#include "ap_int.h"
#include "hls_stream.h"

struct table {
  ap_uint<12> sum[100];
  ap_uint<7> used;
};

void whole_copies(hls::stream<ap_uint<8>>& in, hls::stream<ap_uint<16>>& out, ap_uint<5> count) {
  static ap_uint<16> before[128];
  ap_uint<16> now[128] = {0};
  unsigned char pattern[200];
  std::memset(pattern, 0x5a, sizeof pattern);
  ap_uint<4> grid[3][50] = {};
#pragma HLS ARRAY_PARTITION variable = grid complete dim = 1
  table first = {};

  for (int i = 0; i < count; ++i) {
#pragma HLS PIPELINE II = 2
    const ap_uint<8> value = in.read();
    now[value & 127] += value;
    ++pattern[value % 200];
    ++first.sum[value % 100];
    ++first.used;
    for (int row = 0; row < 3; ++row) grid[row][value % 50] += row;
  }
  table second = first;
  ap_uint<4> copied[3][50];
  std::memcpy(copied, grid, sizeof grid);
  ap_uint<16> reversed[128];
  for (int i = 0; i < 128; ++i) reversed[127 - i] = before[i];
  std::memcpy(before, now, sizeof now);  // what the next call finds

  for (int i = 0; i < 128; ++i) {
#pragma HLS PIPELINE
    out.write(now[i] + reversed[i] + pattern[i] + second.sum[i % 100] + copied[i % 3][i % 50]);
  }
  out.write(second.used);
}
