// Median of the last nine samples: the window is kept sorted; the oldest sample leaves and the new one enters in the
// same clock, every place looks only at its neighbours. one iteration a token of in
#include "ap_int.h"
#include "hls_stream.h"

#define WINDOW 9

typedef ap_int<12> data_t;

void moving_median(hls::stream<data_t>& in, hls::stream<data_t>& out) {
#pragma HLS INTERFACE axis port = in
#pragma HLS INTERFACE axis port = out
#pragma HLS INTERFACE ap_ctrl_none port = return
#pragma HLS PIPELINE II = 1
  static data_t sorted[WINDOW];
#pragma HLS ARRAY_PARTITION variable = sorted complete
  static data_t line[WINDOW];
#pragma HLS ARRAY_PARTITION variable = line complete

  const data_t x = in.read();
  const data_t oldest = line[WINDOW - 1];
  for (int i = WINDOW - 1; i > 0; i--) line[i] = line[i - 1];
  line[0] = x;

  // After the oldest is gone, everything above its place moves down.
  data_t rest[WINDOW - 1];
  bool gone = false;
  for (int i = 0; i < WINDOW - 1; i++) {
#pragma HLS UNROLL
    gone |= sorted[i] == oldest;
    rest[i] = gone ? sorted[i + 1] : sorted[i];
  }
  for (int i = 0; i < WINDOW; i++) {
#pragma HLS UNROLL
    const bool above = i < WINDOW - 1 && x > rest[i < WINDOW - 1 ? i : 0];
    const bool below = i > 0 && x < rest[i > 0 ? i - 1 : 0];
    sorted[i] = above ? rest[i < WINDOW - 1 ? i : 0] : below ? rest[i > 0 ? i - 1 : 0] : x;
  }
  out.write(sorted[WINDOW / 2]);
}
