#include "../drive.hpp"
namespace kernel_dataflow_image {
#include "../kernels/dataflow_image.cpp"
}
using namespace kernel_dataflow_image;

EPILINE_DRIVER(dataflow_image) {
  auto& in = s.input<ap_uint<8>>("in");
  auto& out = s.output<ap_uint<10>>("out");
  const int sizes[][2] = {{3, 20}, {1, 0}, {0, 9}, {15, 3}};
  for (const auto& size : sizes) {
    std::vector<unsigned> wanted;
    for (int i = 0; i < size[0]; ++i) {
      unsigned first = 0;
      for (int j = 0; j <= size[1]; ++j) {
        const ap_uint<8> p = s.any<ap_uint<8>>();
        in.push(p);
        wanted.push_back(p.to_uint() / 2);
        if (j == 0) first = p.to_uint() / 2;
      }
      wanted.push_back((i == 0 ? 512u : 0u) | (i % 2 != 0 ? 256u : 0u) | first);
    }
    s.call({{"rows", ap_uint<4>(size[0])}, {"columns", ap_uint<5>(size[1])}});
    dataflow_image(in.stream, out.stream, size[0], size[1]);
    std::vector<unsigned> found;
    for (const ap_uint<10>& p : out.drain()) found.push_back(p.to_uint());
    s.expect_equal(found, wanted, "pixels");
  }
}
