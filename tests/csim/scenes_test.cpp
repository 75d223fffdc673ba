// The hardware's C++ source and the reference models on the discriminating set of scenes (tests/scenes shows what it
// decides): not one pixel differs, with the designs' defaults and at the ends of every parameter's range.

#include <gtest/gtest.h>

#include "csim/engines.hpp"
#include "eval/metrics.hpp"
#include "golden/engines.hpp"
#include "scenes/render.hpp"

namespace epiline::csim {
namespace {

class every_design : public testing::TestWithParam<std::string> {};

/// Defaults, and with one parameter after the other at each end of its range.
std::vector<eval::parameter_values> settings_of(const eval::design_description& design) {
  std::vector<eval::parameter_values> settings{eval::default_parameters(design)};
  for (const auto& parameter : design.parameters) {
    for (const int value : {parameter.minimum, parameter.maximum}) {
      if (value == parameter.default_value) continue;
      settings.push_back(eval::default_parameters(design));
      settings.back()[std::string(parameter.name)] = value;
    }
  }
  return settings;
}

TEST_P(every_design, equals_its_reference_model_on_the_discriminating_set) {
  eval::engine_registry registry;
  golden::register_engines(registry);
  register_engines(registry);
  const auto& design = *eval::find_design(GetParam());
  const auto golden = registry.find(design.name, "golden")->make(design);
  const auto native = registry.find(design.name, "native")->make(design);
  const auto settings = settings_of(design);
  std::size_t next = 0;
  for (const auto& choice : scenes::discriminating_set()) {
    const auto pair = scenes::render(choice.name, choice.parameters);
    const auto expect_equal = [&](int levels, const eval::parameter_values& parameters) {
      const eval::match_request request{pair.left.image, pair.right.image, levels, parameters};
      const auto difference = eval::compare(golden->match(request, {}).map, native->match(request, {}).map);
      EXPECT_EQ(difference.differing, 0u) << choice.name << ", seed " << choice.parameters.seed << ", " << levels
                                          << " levels, " << testing::PrintToString(parameters) << ": first at column "
                                          << difference.first_x << ", row " << difference.first_y;
    };
    expect_equal(design.max_levels, settings[0]);
    // The first scene, which decides most, meets every setting; the others take turns.
    if (next == 0) {
      for (const auto& parameters : settings) expect_equal(design.max_levels, parameters);
    } else {
      expect_equal(design.max_levels, settings[next % settings.size()]);
    }
    expect_equal(1 + static_cast<int>(7 * next % 79), settings[0]);
    ++next;
  }
}

INSTANTIATE_TEST_SUITE_P(designs, every_design,
                         testing::Values("color_fuzzy", "adaptive_ca", "color_fuzzy_p2", "adaptive_ca_p2"),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace epiline::csim
