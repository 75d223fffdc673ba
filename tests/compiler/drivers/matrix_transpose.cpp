#include "../drive.hpp"
namespace kernel_matrix_transpose {
#include "../kernels/matrix_transpose.cpp"
}
using namespace kernel_matrix_transpose;

EPILINE_DRIVER(matrix_transpose) {
  auto& in = s.input<ap_uint<18>>("in");
  auto& out = s.output<ap_uint<18>>("out");
  const int total = 4 * 256 + 100;
  std::vector<int> words;
  for (int i = 0; i < total; ++i) {
    const auto word = s.any<ap_uint<18>>();
    words.push_back(int(word));
    in.push(word);
    matrix_transpose(in.stream, out.stream);
  }
  std::vector<int> wanted;
  for (int i = 0; i < total - 256; ++i) wanted.push_back(words[std::size_t(i / 256 * 256 + i % 16 * 16 + i / 16 % 16)]);
  s.expect_equal(out.drain(), wanted, "out");
}
