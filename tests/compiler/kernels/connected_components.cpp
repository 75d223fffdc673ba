// The row pass of connected components labelling (8 neighbours): every foreground pixel gets a provisional label from
// the pixels to its left and above; where two labels meet, the pair goes out on a second stream for the resolving pass.
// Label 0 is background. A beat of pairs with `last` ends the frame's list.
#include "ap_axi_sdata.h"
#include "ap_int.h"
#include "hls_stream.h"

const int MAX_COLS = 128;

typedef ap_uint<10> label_t;

struct equivalence_t {
  label_t smaller;
  label_t larger;
  bool last;
};

static label_t min_label(label_t a, label_t b) {
  if (a == 0) return b;
  if (b == 0) return a;
  return a < b ? a : b;
}

void connected_components(hls::stream<ap_axiu<1, 1, 1, 1>>& mask, hls::stream<label_t>& labels,
                          hls::stream<equivalence_t>& equivalences, ap_uint<7> rows, ap_uint<7> cols) {
#pragma HLS INTERFACE axis port = mask
#pragma HLS INTERFACE axis port = labels
#pragma HLS INTERFACE axis port = equivalences
#pragma HLS INTERFACE s_axilite port = rows
#pragma HLS INTERFACE s_axilite port = cols
#pragma HLS INTERFACE s_axilite port = return
  static label_t row_buffer[MAX_COLS];
#pragma HLS BIND_STORAGE variable = row_buffer type = ram_2p
  label_t next_label = 1;

row_loop:
  for (int y = 0; y < rows; ++y) {
    label_t left = 0, above_left = 0, above = 0, above_right = 0;
    if (y > 0) above_right = row_buffer[0];
  col_loop:
    for (int x = 0; x < cols; ++x) {
#pragma HLS PIPELINE II = 1
      above_left = above;
      above = above_right;
      above_right = (y > 0 && x + 1 < cols) ? row_buffer[x + 1] : label_t(0);
      const bool foreground = mask.read().data != 0;
      label_t label = 0;
      if (foreground) {
        // Above touches all the others: nothing new meets there.
        if (above != 0) {
          label = above;
        } else {
          const label_t west = min_label(left, above_left);
          label = min_label(west, above_right);
          if (label == 0) label = next_label++;
          if (west != 0 && above_right != 0 && west != above_right) {
            equivalence_t e;
            e.smaller = label;
            e.larger = west == label ? above_right : west;
            e.last = false;
            equivalences.write(e);
          }
        }
      }
      row_buffer[x] = label;
      left = label;
      labels.write(label);
    }
  }
  equivalence_t end;
  end.smaller = 0;
  end.larger = next_label - 1;
  end.last = true;
  equivalences.write(end);
}
