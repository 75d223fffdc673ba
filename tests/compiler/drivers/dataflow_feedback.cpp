#include "../drive.hpp"
namespace kernel_dataflow_feedback {
#include "../kernels/dataflow_feedback.cpp"
}
using namespace kernel_dataflow_feedback;

EPILINE_DRIVER(dataflow_feedback) {
  auto& in = s.input<sample_t>("in");
  auto& out = s.output<ap_uint<14>>("out");
  unsigned gain = 8;
  for (int packet = 0; packet < 12; ++packet) {
    std::vector<unsigned> wanted;
    unsigned most = 0;
    for (int i = 0; i < 16; ++i) {
      const sample_t sample(s.number(0, 1023 >> s.number(0, 4)));
      in.push(sample);
      wanted.push_back(sample.to_uint() * gain);
      most |= wanted.back();
    }
    gain = (most >> 13 & 1) != 0 ? 3 : (most >> 12 & 1) != 0 ? 6 : 13;
    dataflow_feedback(in.stream, out.stream);
    std::vector<unsigned> found;
    for (const ap_uint<14>& value : out.drain()) found.push_back(value.to_uint());
    s.expect_equal(found, wanted, "samples");
  }
}
