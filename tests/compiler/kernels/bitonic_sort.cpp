// Bitonic sorting network of sixteen 16-bit keys in a 256-bit beat, smallest lowest; ten levels of compare and exchange
// made by a class template that instantiates itself, a beat a clock.
#include "ap_axi_sdata.h"
#include "ap_int.h"
#include "hls_stream.h"

typedef ap_uint<16> key_type;
typedef ap_axiu<256, 1, 1, 1> beat_t;

template <int N, bool UP>
struct bitonic_merge {
  static void run(key_type* k) {
#pragma HLS INLINE
    for (int i = 0; i < N / 2; i++) {
#pragma HLS UNROLL
      if ((k[i] > k[i + N / 2]) == UP) {
        const key_type t = k[i];
        k[i] = k[i + N / 2];
        k[i + N / 2] = t;
      }
    }
    bitonic_merge<N / 2, UP>::run(k);
    bitonic_merge<N / 2, UP>::run(k + N / 2);
  }
};
template <bool UP>
struct bitonic_merge<1, UP> {
  static void run(key_type*) {}
};

template <int N, bool UP>
struct bitonic_sorter {
  static void run(key_type* k) {
#pragma HLS INLINE
    bitonic_sorter<N / 2, true>::run(k);
    bitonic_sorter<N / 2, false>::run(k + N / 2);
    bitonic_merge<N, UP>::run(k);
  }
};
template <bool UP>
struct bitonic_sorter<1, UP> {
  static void run(key_type*) {}
};

void bitonic_sort(hls::stream<beat_t>& in, hls::stream<beat_t>& out) {
#pragma HLS INTERFACE axis register both port = in
#pragma HLS INTERFACE axis register both port = out
#pragma HLS INTERFACE ap_ctrl_none port = return
#pragma HLS PIPELINE II = 1
  beat_t beat = in.read();
  key_type keys[16];
#pragma HLS ARRAY_PARTITION variable = keys complete dim = 0
  for (int i = 0; i < 16; i++) keys[i] = beat.data.range(16 * i + 15, 16 * i);
  bitonic_sorter<16, true>::run(keys);
  for (int i = 0; i < 16; i++) beat.data.range(16 * i + 15, 16 * i) = keys[i];
  out.write(beat);
}
