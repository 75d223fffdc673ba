#include "../drive.hpp"
namespace kernel_insertion_sort {
#include "../kernels/insertion_sort.cpp"
}
using namespace kernel_insertion_sort;

EPILINE_DRIVER(insertion_sort) {
  auto& unsorted = s.input<entry_t>("unsorted");
  auto& sorted = s.output<entry_t>("sorted");
  std::vector<int> wanted;
  for (int call = 0; call < 25; ++call) {
    std::vector<int> group;
    for (int i = 0; i < GROUP; ++i) {
      const entry_t key = s.chance(30) ? entry_t(s.number(-2, 2)) : s.any<entry_t>();
      group.push_back(int(key));
      unsorted.push(key);
    }
    std::sort(group.begin(), group.end());
    wanted.insert(wanted.end(), group.begin(), group.end());
    insertion_sort(unsorted.stream, sorted.stream);
  }
  s.expect_equal(sorted.drain(), wanted, "sorted");
}
