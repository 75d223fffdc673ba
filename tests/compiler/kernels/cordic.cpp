// CORDIC, sixteen rotations in a pipeline: rotates a vector by an angle, or turns it onto the x axis and tells its
// angle and length, chosen by every token. Angles are fractions of a turn, 2^16 a turn; lengths grow by 1.6468 as ever
// with CORDIC. one iteration a token of in
#include "ap_int.h"
#include "hls_stream.h"

const int ITERATIONS = 16;

typedef ap_int<20> length_t;  // 16 bits of input, growth by 1.6468 * sqrt(2), two guard bits
typedef ap_int<18> angle_t;   // a turn is 2^18 inside

struct request_t {
  bool vectoring;
  ap_int<16> x, y;
  ap_uint<16> angle;  // of the rotation
};

struct answer_t {
  ap_int<18> x, y;
  ap_uint<16> angle;  // what is left to rotate by, or the vector's direction
};

// atan(2^-i) / (2 pi) * 2^18
static const int arctangent[ITERATIONS] = {32768, 19344, 10221, 5188, 2604, 1303, 652, 326,
                                           163,   81,    41,    20,   10,   5,    3,   1};

void cordic(hls::stream<request_t>& in, hls::stream<answer_t>& out) {
#pragma HLS INTERFACE axis port = in
#pragma HLS INTERFACE axis port = out
#pragma HLS INTERFACE ap_ctrl_none port = return
#pragma HLS PIPELINE II = 1
  const request_t r = in.read();
  length_t x = r.x, y = r.y;
  x <<= 1;
  y <<= 1;
  angle_t z = r.vectoring ? ap_uint<18>(0) : ap_uint<18>(r.angle) << 2;

  // Half a turn first where the iterations do not reach.
  const bool turn = r.vectoring ? x < 0 : (z[17] ^ z[16]) == 1;
  if (turn) {
    x = -x;
    y = -y;
    z = z + (1 << 17);
  }
  for (int i = 0; i < ITERATIONS; i++) {
#pragma HLS UNROLL
    const length_t dx = y >> i;
    const length_t dy = x >> i;
    const bool positive = r.vectoring ? y < 0 : z >= 0;
    if (positive) {
      x -= dx;
      y += dy;
      z -= arctangent[i];
    } else {
      x += dx;
      y -= dy;
      z += arctangent[i];
    }
  }
  answer_t a;
  a.x = x >> 1;
  a.y = y >> 1;
  a.angle = z >> 2;
  out.write(a);
}
