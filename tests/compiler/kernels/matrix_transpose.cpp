// Transposes 16x16 blocks of a stream: while one half of a ping-pong RAM fills by rows, the other is read by columns. A
// word a clock; the first block comes out while the second goes in.
// one iteration a token of in
#include "ap_int.h"
#include "hls_stream.h"

template <typename T, int N>
class ping_pong {
 public:
  T exchange(T x) {
#pragma HLS INLINE
    const T y = memory[!half][column][row];
    memory[half][row][column] = x;
    if (column == N - 1) {
      column = 0;
      if (row == N - 1) {
        row = 0;
        half = !half;
        primed = true;
      } else {
        row++;
      }
    } else {
      column++;
    }
    return y;
  }
  bool ready() const { return primed; }

 private:
  T memory[2][N][N];
  ap_uint<4> row = 0, column = 0;
  bool half = false;
  bool primed = false;
};

void matrix_transpose(hls::stream<ap_uint<18>>& in, hls::stream<ap_uint<18>>& out) {
#pragma HLS INTERFACE axis port = in
#pragma HLS INTERFACE axis port = out
#pragma HLS INTERFACE ap_ctrl_none port = return
#pragma HLS PIPELINE II = 1
  static ping_pong<ap_uint<18>, 16> buffer;
  const bool valid = buffer.ready();
  const ap_uint<18> y = buffer.exchange(in.read());
  if (valid) out.write(y);
}
