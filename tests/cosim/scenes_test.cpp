// The full-size RTL and the dataflow graph on the discriminating set of scenes, against the reference models.

#include <gtest/gtest.h>

#include "cosim/engines.hpp"
#include "eval/metrics.hpp"
#include "golden/engines.hpp"
#include "scenes/render.hpp"

namespace epiline::cosim {
namespace {

class every_design : public testing::TestWithParam<std::string> {};

TEST_P(every_design, equals_its_reference_model_on_the_discriminating_set) {
  eval::engine_registry registry;
  golden::register_engines(registry);
  register_engines(registry);
  const auto& design = *eval::find_design(GetParam());
  const auto golden = registry.find(design.name, "golden")->make(design);
  eval::run_options stalls;
  stalls.seed = 3;
  stalls.input_gap_percent = 20;
  stalls.output_stall_percent = 20;
  for (const char* name : {"rtl", "graph"}) {
    const auto engine = registry.find(design.name, name)->make(design);
    for (const auto& choice : scenes::discriminating_set()) {
      const auto pair = scenes::render(choice.name, choice.parameters);
      const eval::match_request request{pair.left.image, pair.right.image, design.max_levels,
                                        eval::default_parameters(design)};
      const auto difference = eval::compare(golden->match(request, {}).map, engine->match(request, stalls).map);
      EXPECT_EQ(difference.differing, 0u)
          << name << ", " << choice.name << ", seed " << choice.parameters.seed << ": first at column "
          << difference.first_x << ", row " << difference.first_y;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(designs, every_design, testing::Values("color_fuzzy", "adaptive_ca"),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace epiline::cosim
