#include <gmock/gmock.h>

#include "csim/engines.hpp"
#include "eval/engine.hpp"
#include "golden/engines.hpp"

namespace epiline::eval {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

match_request request_of(int width, int height) {
  return {rgb_image(width, height), rgb_image(width, height), 16, default_parameters(*find_design("color_fuzzy"))};
}

TEST(designs, have_defaults_within_their_ranges) {
  ASSERT_FALSE(all_designs().empty());
  for (const auto& design : all_designs()) {
    EXPECT_LE(design.default_levels, design.max_levels);
    for (const auto& parameter : design.parameters) {
      EXPECT_GE(parameter.default_value, parameter.minimum) << parameter.name;
      EXPECT_LE(parameter.default_value, parameter.maximum) << parameter.name;
    }
  }
}

TEST(designs, color_fuzzy_has_the_documented_parameters) {
  const auto* design = find_design("color_fuzzy");
  ASSERT_NE(design, nullptr);
  EXPECT_EQ(default_parameters(*design),
            (parameter_values{{"left_right", 1}, {"uniqueness", 17}, {"fuzzy", 2}, {"careful_fill", 0}}));
  EXPECT_EQ(design->max_width, 1024);
  EXPECT_EQ(design->default_levels, 80);
  EXPECT_EQ(find_design("color_fuzz"), nullptr);
  EXPECT_EQ(find_parameter(*design, "fuzz"), nullptr);
}

TEST(designs, adaptive_ca_has_the_documented_parameters) {
  const auto* design = find_design("adaptive_ca");
  ASSERT_NE(design, nullptr);
  EXPECT_EQ(default_parameters(*design), (parameter_values{{"t2", 32}, {"t5", 100}, {"automaton", 1}, {"ring", 24}}));
  EXPECT_EQ(design->max_width, 1024);
  EXPECT_EQ(design->default_levels, 80);
  EXPECT_EQ(find_parameter(*design, "ring")->minimum, 1);
  EXPECT_EQ(find_parameter(*design, "ring")->maximum, 40);
}

TEST(designs, that_are_other_speeds_name_the_design_whose_maps_and_parameters_they_have) {
  for (const auto& design : all_designs()) {
    if (design.same_maps_as.empty()) continue;
    const auto* same = find_design(design.same_maps_as);
    ASSERT_NE(same, nullptr) << design.name;
    EXPECT_TRUE(same->same_maps_as.empty()) << design.name;
    EXPECT_EQ(default_parameters(design), default_parameters(*same)) << design.name;
    EXPECT_NE(std::pair(design.pixels_per_beat, design.max_levels), std::pair(same->pixels_per_beat, same->max_levels))
        << design.name;
    EXPECT_LE(design.max_levels, same->max_levels) << design.name;
  }
  EXPECT_EQ(find_design("adaptive_ca_p2")->same_maps_as, "adaptive_ca");
}

TEST(closest_name, suggests_a_slip_of_the_finger_only) {
  const std::string_view known[] = {"golden", "native", "rtl"};
  EXPECT_EQ(closest_name("natve", known), "native");
  EXPECT_EQ(closest_name("rlt", known), "");  // two changes of three letters
  EXPECT_EQ(closest_name("rtll", known), "rtl");
  EXPECT_EQ(closest_name("board", known), "");
  EXPECT_EQ(closest_name("", known), "");
}

TEST(check_request, accepts_the_largest_frame_and_the_ends_of_every_range) {
  const auto& design = *find_design("color_fuzzy");
  EXPECT_NO_THROW(check_request(design, request_of(design.max_width, 1)));
  EXPECT_NO_THROW(check_request(design, request_of(1, design.max_height)));
  for (const auto& parameter : design.parameters) {
    for (const int value : {parameter.minimum, parameter.maximum}) {
      auto request = request_of(3, 3);
      request.parameters[std::string(parameter.name)] = value;
      EXPECT_NO_THROW(check_request(design, request)) << parameter.name << " " << value;
    }
  }
}

TEST(check_request, says_what_is_wrong) {
  const auto& design = *find_design("color_fuzzy");
  const auto expect = [&](const match_request& request, const auto& matcher) {
    EXPECT_THAT([&] { check_request(design, request); }, ThrowsMessage<engine_error>(matcher));
  };
  auto request = request_of(4, 3);
  request.right = rgb_image(4, 2);
  expect(request, AllOf(HasSubstr("left is 4x3"), HasSubstr("right is 4x2")));
  expect(request_of(0, 0), HasSubstr("no pixels"));
  expect(request_of(1025, 1), AllOf(HasSubstr("1025x1"), HasSubstr("at most 1024x4095")));
  expect(request_of(1, 4096), AllOf(HasSubstr("1x4096"), HasSubstr("at most 1024x4095")));
  for (const int levels : {0, -1, 81}) {
    request = request_of(3, 3);
    request.levels = levels;
    expect(request, AllOf(HasSubstr("levels is " + std::to_string(levels)), HasSubstr("1 to 80")));
  }
  for (const int value : {-1, 32}) {
    request = request_of(3, 3);
    request.parameters["uniqueness"] = value;
    expect(request, AllOf(HasSubstr("uniqueness is " + std::to_string(value)), HasSubstr("0 to 31")));
  }
  request = request_of(3, 3);
  request.parameters["uniquenes"] = 17;
  expect(request, AllOf(HasSubstr("'uniquenes'"), HasSubstr("did you mean uniqueness?"), HasSubstr("careful_fill")));
  request = request_of(3, 3);
  request.parameters.erase("fuzzy");
  expect(request, HasSubstr("parameter fuzzy"));
}

TEST(engine_registry, finds_engines_by_design_and_name_and_refuses_duplicates) {
  engine_registry registry;
  golden::register_engines(registry);
  csim::register_engines(registry);
  EXPECT_NE(registry.find("color_fuzzy", "golden"), nullptr);
  EXPECT_NE(registry.find("color_fuzzy", "native"), nullptr);
  EXPECT_EQ(registry.find("color_fuzzy", "board"), nullptr);
  EXPECT_EQ(registry.find("other", "golden"), nullptr);
  EXPECT_EQ(registry.engines_of("color_fuzzy").size(), 2u);
  EXPECT_TRUE(registry.engines_of("other").empty());
  EXPECT_THROW(golden::register_engines(registry), std::logic_error);
  EXPECT_THROW(registry.add({"other", "golden", "", nullptr}), std::logic_error);
}

TEST(native_engine, refuses_a_description_that_is_not_its_tops) {
  engine_registry registry;
  csim::register_engines(registry);
  design_description other = *find_design("color_fuzzy");
  EXPECT_NO_THROW((void)registry.find("color_fuzzy", "native")->make(other));
  other.max_levels = 81;
  EXPECT_THROW((void)registry.find("color_fuzzy", "native")->make(other), std::logic_error);
}

}  // namespace
}  // namespace epiline::eval
