#include "../drive.hpp"
namespace kernel_dense_layers {
#include "../kernels/dense_layers.cpp"
}
using namespace kernel_dense_layers;
EPILINE_LEAVES(input_t, v.data[0], v.data[1], v.data[2], v.data[3], v.data[4], v.data[5], v.data[6], v.data[7],
               v.data[8], v.data[9], v.data[10], v.data[11], v.data[12], v.data[13], v.data[14], v.data[15]);

EPILINE_DRIVER(dense_layers) {
  auto& features = s.input<input_t>("features");
  auto& classes = s.output<ap_uint<2>>("classes");
  std::vector<int> wanted;
  int votes[4] = {};
  for (int n = 0; n < 80; ++n) {
    const input_t x = s.any<input_t>();
    features.push(x);
    int hidden[8], best = 0, scores[4];
    for (int o = 0; o < 8; ++o) {
      int sum = nnet::config_1::biases[o];
      for (unsigned i = 0; i < 16; ++i) sum += int(x[i]) * nnet::config_1::weights[o][i];
      hidden[o] = std::clamp(sum >> 6, 0, 127);
    }
    for (int o = 0; o < 4; ++o) {
      scores[o] = nnet::config_2::biases[o];
      for (int i = 0; i < 8; ++i) scores[o] += hidden[i] * nnet::config_2::weights[o][i];
      scores[o] >>= 4;
      if (scores[o] > scores[best]) best = o;
    }
    ++votes[best];
    wanted.push_back(best);
    dense_layers(features.stream, classes.stream);
  }
  s.expect(votes[0] > 0 && votes[1] > 0 && votes[2] + votes[3] > 0, "several classes occur");
  s.expect_equal(classes.drain(), wanted, "classes");
}
