#include "../drive.hpp"
namespace kernel_dataflow_lanes {
#include "../kernels/dataflow_lanes.cpp"
}
using namespace kernel_dataflow_lanes;

EPILINE_DRIVER(dataflow_lanes) {
  auto& in = s.input<value_t>("in");
  auto& out = s.output<ap_uint<14 * LANES>>("out");
  for (const int rows : {30, 1, 0, 7}) {
    unsigned before[LANES] = {0, 1, 2, 3};
    std::vector<std::uint64_t> wanted;
    for (int row = 0; row < rows; ++row) {
      std::uint64_t word = 0;
      for (unsigned lane = 0; lane < LANES; ++lane) {
        const value_t v = s.any<value_t>();
        in.push(v);
        word |= std::uint64_t{(v.to_uint() ^ (before[lane] << lane)) & 0x3fff} << (14 * lane);
        before[lane] = v.to_uint();
      }
      wanted.push_back(word);
    }
    s.call({{"rows", ap_uint<6>(rows)}});
    dataflow_lanes(in.stream, out.stream, rows);
    std::vector<std::uint64_t> found;
    for (const auto& word : out.drain()) found.push_back(word.to_uint64());
    s.expect_equal(found, wanted, "words");
  }
}
