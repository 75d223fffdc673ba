#include <hls_task.h>

#include "../drive.hpp"
namespace regression_data_driven_tasks {
#include "../regressions/data_driven_tasks.cpp"
}

EPILINE_DRIVER(data_driven_tasks) {
  using regression_data_driven_tasks::number_t;
  auto& in = s.input<number_t>("in");
  auto& out = s.output<number_t>("out");
  // Tasks keep their streams for good: these outlive the session.
  static hls::stream<number_t> given("given"), taken("taken");
  std::vector<int> wanted;
  int back = 5;
  for (int group = 0; group < 100; ++group) {
    int sums[2] = {group + 1, group + 1};
    for (int i = 0; i < 6; ++i) {
      const number_t value = s.any<number_t>();
      in.push(value);
      given.write(in.stream.read());
      sums[i % 2] += value.to_int() * (i % 2 == 0 ? 3 : 5);
    }
    for (const int sum : sums) {
      // The counter of calls has 8 bits.
      const int mixed = ((sum - (group + 1) + ((group + 1) & 255)) + back) & 0xffff;
      wanted.push_back(~mixed & 0xffff);
      back = mixed >> 1;
    }
    regression_data_driven_tasks::data_driven_tasks(given, taken);
  }
  while (!taken.empty()) out.stream.write(taken.read());
  s.expect_equal(out.drain(), wanted, "out");
}
