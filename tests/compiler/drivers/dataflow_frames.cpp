#include "../drive.hpp"
namespace kernel_dataflow_frames {
#include "../kernels/dataflow_frames.cpp"
}
using namespace kernel_dataflow_frames;

EPILINE_DRIVER(dataflow_frames) {
  auto& in = s.input<pixel_t>("in");
  auto& rest = s.input<ap_uint<16>>("rest");
  auto& out = s.output<pixel_t>("out");
  auto& means = s.output<ap_uint<16>>("means");
  auto& spare = s.output<ap_uint<16>>("spare");
  unsigned before = 0;
  const int calls[][4] = {{3, 20, 1, 0}, {1, 1, 0, 1}, {0, 9, 1, 2}, {7, 4, 1, 1}, {2, 0, 1, 0}, {5, 31, 0, 3}};
  for (const auto& call : calls) {
    std::vector<unsigned> wanted, wanted_means, wanted_spare;
    for (int frame = 0; frame < call[0]; ++frame) {
      unsigned sum = 0;
      for (int i = 0; i < call[1]; ++i) {
        const pixel_t p = s.any<pixel_t>();
        in.push(p);
        sum += p.to_uint();
        wanted.push_back(~(call[2] != 0 ? (p.to_uint() + before + 1) / 2 : p.to_uint()) & 0xff);
        before = p.to_uint();
      }
      if (frame % (call[3] + 1) == 0) wanted_means.push_back(sum / 4);
      if (call[2] != 0 && frame < 2) {
        const ap_uint<16> value = s.any<ap_uint<16>>();
        rest.push(value);
        wanted_spare.push_back(value.to_uint());
      }
    }
    s.call({{"frames", ap_uint<3>(call[0])},
            {"length", ap_uint<5>(call[1])},
            {"on", call[2] != 0},
            {"rate", ap_uint<2>(call[3])}});
    dataflow_frames(in.stream, out.stream, means.stream, rest.stream, spare.stream, call[0], call[1], call[2] != 0,
                    call[3]);
    const auto numbers = [](const auto& tokens) {
      std::vector<unsigned> found;
      for (const auto& token : tokens) found.push_back(token.to_uint());
      return found;
    };
    s.expect_equal(numbers(out.drain()), wanted, "pixels");
    s.expect_equal(numbers(means.drain()), wanted_means, "means");
    s.expect_equal(numbers(spare.drain()), wanted_spare, "spare");
  }
}
