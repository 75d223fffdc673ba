#include "report/methods.hpp"

#include <gmock/gmock.h>

#include <set>

namespace epiline::report {
namespace {

const eval::engine_registry::entry engine{"color_fuzzy", "native", "", nullptr};

TEST(methods, of_every_design_have_distinct_ids_and_parameters_in_range) {
  std::set<std::string> ids;
  for (const auto& design : eval::all_designs()) {
    int final = 0;
    for (const auto& method : methods_of(design, engine)) {
      EXPECT_TRUE(ids.insert(method.id).second) << method.id;
      EXPECT_EQ(method.design, &design);
      EXPECT_EQ(method.engine, &engine);
      EXPECT_THAT(method.settings, testing::StartsWith(std::string(design.name)));
      const eval::match_request request{{}, {}, design.default_levels, method.parameters};
      EXPECT_NO_THROW(eval::check_settings(design, request)) << method.id;
      final += method.final ? 1 : 0;
    }
    EXPECT_EQ(final, 1) << design.name << " needs one result for the summary";
  }
}

TEST(methods, final_ones_are_the_designs_defaults) {
  for (const auto& design : eval::all_designs()) {
    for (const auto& method : methods_of(design, engine)) {
      if (method.final) {
        EXPECT_EQ(method.parameters, eval::default_parameters(design)) << method.id;
      }
    }
  }
}

TEST(methods, of_a_design_without_variants_are_its_defaults) {
  static constexpr eval::parameter_description parameters[] = {{"gain", 0, 9, 4, ""}};
  const eval::design_description design{"unheard_of", "", 64, 64, 16, 16, 1, parameters};
  const auto methods = methods_of(design, engine);
  ASSERT_EQ(methods.size(), 1u);
  EXPECT_EQ(methods[0].id, "unheard_of");
  EXPECT_EQ(methods[0].parameters.at("gain"), 4);
  EXPECT_TRUE(methods[0].pictured && methods[0].final);
}

TEST(methods, of_opencv_state_their_parameters) {
  const auto methods = opencv_methods();
  ASSERT_EQ(methods.size(), 2u);
  for (const auto& method : methods) EXPECT_EQ(method.design, nullptr);
  EXPECT_THAT(methods[0].settings, testing::HasSubstr("StereoBM"));
  EXPECT_THAT(methods[1].settings, testing::AllOf(testing::HasSubstr("StereoSGBM"), testing::HasSubstr("P2")));
}

}  // namespace
}  // namespace epiline::report
