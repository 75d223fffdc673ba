// The reference models and the native tops on the shared pairs at full size, against maps and counts of an independent
// prototype.

#include "eval/real_pairs.hpp"

#include <gtest/gtest.h>

#include "csim/engines.hpp"
#include "golden/adaptive_ca.hpp"
#include "golden/engines.hpp"
#include "golden/streaming_automaton.hpp"

namespace epiline::test {
namespace {

class real_pairs : public testing::TestWithParam<const char*> {};

TEST_P(real_pairs, golden_and_native_give_the_reference_maps_and_counts) {
  const auto pair = find_real_pair(GetParam());
  if (!pair) GTEST_SKIP() << GetParam() << " and its reference maps are not on this machine (EPILINE_DATA)";
  eval::engine_registry registry;
  golden::register_engines(registry);
  csim::register_engines(registry);

  for (const auto& expected : reference_cases) {
    SCOPED_TRACE(expected.map);
    const auto& design = *eval::find_design(expected.design);
    eval::match_request request{pair->left, pair->right, pair->levels, eval::default_parameters(design)};
    for (const auto& [name, value] : expected.changed) request.parameters[name] = value;
    const auto reference = read_reference_map(pair->reference / (std::string(expected.map) + ".png"));
    for (const auto& speed : eval::all_designs()) {
      if (speed.name != design.name && speed.same_maps_as != design.name) continue;
      if (request.left.width > speed.max_width || request.levels > speed.max_levels) continue;
      for (const auto* engine : registry.engines_of(speed.name)) {
        const auto result = engine->make(speed)->match(request, {});
        EXPECT_EQ(eval::compare(reference, result.map).differing, 0u) << speed.name << ", " << engine->name;
      }
    }

    const auto& counts = pair->figures.at(expected.map);
    const eval::map_figures figures = eval::measure(reference, &pair->truth);
    EXPECT_EQ(figures.pixels, counts.at("pixels"));
    EXPECT_EQ(figures.defined, counts.at("defined"));
    EXPECT_EQ(figures.all->defined, counts.at("known_and_defined"));
    EXPECT_NEAR(figures.coverage(), counts.at("coverage"), 0.005);
    ASSERT_EQ(figures.non_occluded.has_value(), counts.contains("nonocc_known"));

    // The prototype read Motorcycle's PFM through OpenCV, which divides by the scale 0.003922 of the header, and
    // multiplied by 1/255 = 0.00392157 again: its truth is 1/10000 too small, which moves a few disparities across the
    // threshold. With plain values the count is slightly higher.
    eval::ground_truth as_prototype = pair->truth;
    if (std::string(GetParam()) == "motorcycle") {
      for (double& value : as_prototype.disparity.values) value *= 0.00392157 / 0.003922;
    }
    const eval::map_figures prototype = eval::measure(reference, &as_prototype);
    EXPECT_EQ(prototype.all->correct, counts.at("correct"));
    EXPECT_NEAR(prototype.all->accuracy(), counts.at("accuracy"), 0.005);
    if (figures.non_occluded) {
      EXPECT_EQ(figures.non_occluded->known, counts.at("nonocc_known"));
      EXPECT_EQ(figures.non_occluded->defined, counts.at("nonocc_defined"));
      EXPECT_EQ(prototype.non_occluded->correct, counts.at("nonocc_correct"));
    }
  }
}

TEST_P(real_pairs, the_automaton_on_planes_equals_its_streaming_form) {
  const auto pair = find_real_pair(GetParam());
  if (!pair) GTEST_SKIP() << GetParam() << " and its reference maps are not on this machine (EPILINE_DATA)";
  const auto stored = read_reference_map(pair->reference / "adaptive_ca-off.png");
  golden::disparity_plane map{golden::plane<std::uint8_t>::Zero(stored.height, stored.width),
                              golden::plane<bool>::Constant(stored.height, stored.width, true)};
  std::copy(stored.disparity.begin(), stored.disparity.end(), map.disparity.data());
  const auto after_rule_1 = golden::automaton_rule_1(map, pair->levels);
  branch_counts branches;
  for (const int ring : {1, 20, 24, 40}) {
    const auto planes = golden::automaton_rule_2(after_rule_1, pair->levels, ring);
    const auto streamed = streaming_automaton(map, branches).filter(ring);
    EXPECT_EQ((planes.disparity != streamed.disparity || planes.defined != streamed.defined).count(), 0) << ring;
  }
}

INSTANTIATE_TEST_SUITE_P(shared, real_pairs, testing::ValuesIn(real_scenes),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace epiline::test
