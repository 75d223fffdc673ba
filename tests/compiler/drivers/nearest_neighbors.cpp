#include "../drive.hpp"
namespace kernel_nearest_neighbors {
#include "../kernels/nearest_neighbors.cpp"
}
using namespace kernel_nearest_neighbors;
EPILINE_LEAVES(point_t, v.x[0], v.x[1], v.x[2], v.x[3]);
EPILINE_LEAVES(labelled_t, v.point, v.label);

EPILINE_DRIVER(nearest_neighbors) {
  auto& training = s.input<labelled_t>("training");
  auto& queries = s.input<point_t>("queries");
  auto& answers = s.output<label_t>("answers");
  std::vector<int> wanted;
  for (const int count : {10, 0, 1, 12}) {
    // Clusters around four corners, or anything; few different values make ties.
    const bool clusters = count == 10, coarse = count == 12;
    std::vector<labelled_t> points;
    for (int i = 0; i < TRAINING; ++i) {
      labelled_t p = s.any<labelled_t>();
      for (int d = 0; d < DIMENSIONS; ++d) {
        if (clusters) p.point.x[d] = (int(p.label) >> d % 2 & 1) * 100 - 50 + int(s.number(-40, 40));
        if (coarse) p.point.x[d] = s.number(0, 2);
      }
      points.push_back(p);
      training.push(p);
    }
    for (int q = 0; q < count; ++q) {
      point_t query = s.any<point_t>();
      for (int d = 0; coarse && d < DIMENSIONS; ++d) query.x[d] = s.number(0, 2);
      queries.push(query);
      std::vector<std::pair<int, int>> order;  // distance, label
      for (const labelled_t& p : points) {
        int sum = 0;
        for (int d = 0; d < DIMENSIONS; ++d)
          sum += (int(p.point.x[d]) - int(query.x[d])) * (int(p.point.x[d]) - int(query.x[d]));
        order.emplace_back(sum, int(p.label));
      }
      std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
      const int a = order[0].second, b = order[1].second, c = order[2].second;
      wanted.push_back(b == c ? b : a);
    }
    s.call({{"count", count}});
    nearest_neighbors(training.stream, queries.stream, answers.stream, count);
  }
  s.expect_equal(answers.drain(), wanted, "answers");
}
