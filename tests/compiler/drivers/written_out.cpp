#include "../drive.hpp"
namespace regression_written_out {
#include "../regressions/written_out.cpp"
}

EPILINE_DRIVER(written_out) {
  auto& in = s.input<int>("in");
  auto& out = s.output<int>("out");
  auto& weights = s.input<int>("weights");
  auto& sums = s.output<int>("sums");
  int negative = 0;
  const int sizes[][2] = {{4, 5}, {1, 1}, {3, 40}, {0, 7}, {6, 2}};
  for (const auto& size : sizes) {
    const int rows = size[0], columns = size[1];
    std::vector<int> image, wanted;
    int sum = 0;
    for (int i = 0; i < rows * columns; ++i) {
      image.push_back(int(s.number(0, 200)) - 100);
      in.push(image.back());
      const int above = i >= columns ? image[std::size_t(i - columns)] : 0;
      const int value = (image.back() + above) * 12 + i;
      sum += value;
      wanted.push_back(value + 1 + i % 2);
    }
    const int weight = int(s.number(0, 10)) - 5;
    weights.push(weight);
    negative += weight <= 0;
    s.call({{"rows", rows}, {"columns", columns}});
    regression_written_out::written_out(in.stream, out.stream, weights.stream, sums.stream, rows, columns);
    s.expect_equal(out.drain(), wanted, "out");
    s.expect_equal(sums.drain(), std::vector<int>{weight > 0 ? sum + 3 * weight : -1, negative}, "sums");
  }
}
