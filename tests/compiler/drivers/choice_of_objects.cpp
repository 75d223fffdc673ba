#include "../drive.hpp"
namespace regression_choice_of_objects {
#include "../regressions/choice_of_objects.cpp"
}
using regression_choice_of_objects::sample_t;

EPILINE_LEAVES(sample_t, v.tag, v.value, v.parts[0], v.parts[1], v.parts[2]);
EPILINE_DRIVER(choice_of_objects) {
  auto& in = s.input<sample_t>("in");
  auto& out = s.output<sample_t>("out");
  std::vector<int> wanted;
  int best = -1000;
  for (int i = 0; i < 100; ++i) {
    sample_t p = s.any<sample_t>();
    p.value = i * 7919 % 301 - 150;
    in.push(p);
    best = std::max(best, int(p.value));
    wanted.push_back(best);
    regression_choice_of_objects::choice_of_objects(in.stream, out.stream);
  }
  std::vector<int> found;
  for (const sample_t& p : out.drain()) found.push_back(int(p.value));
  s.expect_equal(found, wanted, "out");
}
