// A small neural network as generators write it: two dense layers with ReLU between and the index of the largest
// output, 16 inputs of eight bits, weights in ROM. Layers are processes joined by streams of whole vectors; each layer
// reuses its multipliers over the outputs.
#include "ap_int.h"
#include "hls_stream.h"

namespace nnet {

template <class T, unsigned N>
struct array {
  typedef T value_type;
  static const unsigned size = N;
  T data[N];
  T& operator[](unsigned i) { return data[i]; }
  const T& operator[](unsigned i) const { return data[i]; }
};

struct config_1 {
  static const unsigned n_in = 16;
  static const unsigned n_out = 8;
  static constexpr int shift = 6;
  typedef ap_int<20> accum_t;
  static const signed char weights[n_out][n_in];
  static const short biases[n_out];
};
const signed char config_1::weights[n_out][n_in] = {
    {12, -7, 33, 0, 1, -60, 27, 5, -11, 8, 19, -3, 44, -21, 6, 2},
    {-1, -2, -3, -4, -5, -6, -7, -8, 8, 7, 6, 5, 4, 3, 2, 1},
    {50, 40, 30, 20, 10, 0, -10, -20, -30, -40, -50, -60, 60, 50, 40, 30},
    {9, -8, 7, -6, 5, -4, 3, -2, 1, 0, -1, 2, -3, 4, -5, 6},
    {-63, 63, -63, 63, -50, 50, -25, 25, -12, 12, -6, 6, -3, 3, -1, 1},
    {1, 0, 0, 0, 0, 0, 0, -1, 0, 1, 0, 0, -1, 0, 0, 0},
    {17, 23, -29, 31, -37, 41, -43, 47, -53, 59, -61, 2, -3, 5, -7, 11},
    {31, 31, 31, 31, 31, 31, 31, 31, -31, -31, -31, -31, -31, -31, -31, -31}};
const short config_1::biases[n_out] = {100, -200, 0, 512, 64, -64, 1000, -1000};

struct config_2 {
  static const unsigned n_in = 8;
  static const unsigned n_out = 4;
  static constexpr int shift = 4;
  typedef ap_int<20> accum_t;
  static const signed char weights[n_out][n_in];
  static const short biases[n_out];
};
const signed char config_2::weights[n_out][n_in] = {{20, -14, 9, 31, -6, 3, 17, -25},
                                                    {-20, 14, -9, -31, 6, -3, -17, 25},
                                                    {5, 5, 5, 5, 5, 5, 5, 5},
                                                    {-12, 30, 2, 8, -19, 27, -1, 4}};
const short config_2::biases[n_out] = {0, 32, -64, 7};

template <class data_T, class res_T, typename CONFIG_T>
void dense(hls::stream<data_T>& in, hls::stream<res_T>& out) {
  const data_T x = in.read();
  res_T y;
#pragma HLS ARRAY_PARTITION variable = y.data complete
Outputs:
  for (unsigned o = 0; o < CONFIG_T::n_out; o++) {
#pragma HLS PIPELINE II = 1
    typename CONFIG_T::accum_t acc = CONFIG_T::biases[o];
  Products:
    for (unsigned i = 0; i < CONFIG_T::n_in; i++) {
#pragma HLS UNROLL
      acc += x[i] * CONFIG_T::weights[o][i];
    }
    y[o] = acc >> CONFIG_T::shift;
    if (o == CONFIG_T::n_out - 1) out.write(y);
  }
}

template <class data_T, class res_T>
void relu(hls::stream<data_T>& in, hls::stream<res_T>& out) {
#pragma HLS PIPELINE II = 1
  const data_T x = in.read();
  res_T y;
  for (unsigned i = 0; i < data_T::size; i++) {
#pragma HLS UNROLL
    if (x[i] < 0)
      y[i] = 0;
    else if (x[i] > 127)
      y[i] = 127;
    else
      y[i] = x[i];
  }
  out.write(y);
}

}  // namespace nnet

typedef nnet::array<ap_int<8>, 16> input_t;
typedef nnet::array<ap_int<16>, 8> layer1_t;
typedef nnet::array<ap_int<8>, 8> layer2_t;
typedef nnet::array<ap_int<16>, 4> scores_t;

static void largest(hls::stream<scores_t>& in, hls::stream<ap_uint<2>>& out) {
  const scores_t s = in.read();
  ap_uint<2> best = 0;
  for (int i = 1; i < 4; i++) {
    if (s[i] > s[best]) best = i;
  }
  out.write(best);
}

void dense_layers(hls::stream<input_t>& features, hls::stream<ap_uint<2>>& classes) {
#pragma HLS INTERFACE axis port = features
#pragma HLS INTERFACE axis port = classes
#pragma HLS INTERFACE ap_ctrl_none port = return
#pragma HLS DATAFLOW
  hls::stream<layer1_t> layer1_out("layer1_out");
  hls::stream<layer2_t> layer2_out("layer2_out");
  hls::stream<scores_t> layer3_out("layer3_out");
  nnet::dense<input_t, layer1_t, nnet::config_1>(features, layer1_out);
  nnet::relu<layer1_t, layer2_t>(layer1_out, layer2_out);
  nnet::dense<layer2_t, scores_t, nnet::config_2>(layer2_out, layer3_out);
  largest(layer3_out, classes);
}
