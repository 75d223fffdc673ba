// Fewer levels at a time than there are, several clocks a pixel: the same maps as with all levels at once, bit for bit,
// whatever the stalls, and as many clocks as promised.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "adaptive_ca_16_of_80_rtl_model.hpp"
#include "adaptive_ca_2_of_8_rtl_model.hpp"
#include "adaptive_ca_40_of_80_rtl_model.hpp"
#include "adaptive_ca_4_of_8_rtl_model.hpp"
#include "color_fuzzy_16_of_80_rtl_model.hpp"
#include "color_fuzzy_2_of_8_rtl_model.hpp"
#include "color_fuzzy_40_of_80_rtl_model.hpp"
#include "color_fuzzy_4_of_8_rtl_model.hpp"
#include "cosim/engines.hpp"
#include "eval/image_files.hpp"
#include "frame_bench.hpp"

namespace epiline::cosim {
namespace {

template <class Method, int ParallelDisparities, int Levels>
struct in_groups {
  using method = Method;
  struct config : Method::config {
    static constexpr int levels = Levels;
    static constexpr int parallel_disparities = ParallelDisparities;
  };
};

struct color_fuzzy_4_of_8 : in_groups<color_fuzzy_method, 4, 8> {
  static constexpr const char* graph = COLOR_FUZZY_4_OF_8_GRAPH;
  static auto make(std::uint64_t seed) { return make_color_fuzzy_4_of_8_rtl_model(seed); }
};
struct color_fuzzy_2_of_8 : in_groups<color_fuzzy_method, 2, 8> {
  static constexpr const char* graph = COLOR_FUZZY_2_OF_8_GRAPH;
  static auto make(std::uint64_t seed) { return make_color_fuzzy_2_of_8_rtl_model(seed); }
};
struct color_fuzzy_40_of_80 : in_groups<color_fuzzy_method, 40, 80> {
  static constexpr const char* graph = COLOR_FUZZY_40_OF_80_GRAPH;
  static auto make(std::uint64_t seed) { return make_color_fuzzy_40_of_80_rtl_model(seed); }
};
struct color_fuzzy_16_of_80 : in_groups<color_fuzzy_method, 16, 80> {
  static constexpr const char* graph = COLOR_FUZZY_16_OF_80_GRAPH;
  static auto make(std::uint64_t seed) { return make_color_fuzzy_16_of_80_rtl_model(seed); }
};
struct adaptive_ca_4_of_8 : in_groups<adaptive_ca_method, 4, 8> {
  static constexpr const char* graph = ADAPTIVE_CA_4_OF_8_GRAPH;
  static auto make(std::uint64_t seed) { return make_adaptive_ca_4_of_8_rtl_model(seed); }
};
struct adaptive_ca_2_of_8 : in_groups<adaptive_ca_method, 2, 8> {
  static constexpr const char* graph = ADAPTIVE_CA_2_OF_8_GRAPH;
  static auto make(std::uint64_t seed) { return make_adaptive_ca_2_of_8_rtl_model(seed); }
};
struct adaptive_ca_40_of_80 : in_groups<adaptive_ca_method, 40, 80> {
  static constexpr const char* graph = ADAPTIVE_CA_40_OF_80_GRAPH;
  static auto make(std::uint64_t seed) { return make_adaptive_ca_40_of_80_rtl_model(seed); }
};
struct adaptive_ca_16_of_80 : in_groups<adaptive_ca_method, 16, 80> {
  static constexpr const char* graph = ADAPTIVE_CA_16_OF_80_GRAPH;
  static auto make(std::uint64_t seed) { return make_adaptive_ca_16_of_80_rtl_model(seed); }
};

template <class Design>
class level_groups : public testing::Test {
 protected:
  using method = typename Design::method;
  using config = typename Design::config;

  static eval::disparity_map graph_map(const eval::match_request& request) {
    return make_graph_engine(*eval::find_design(method::name), Design::graph)->match(request, {}).map;
  }
};
using small_designs = testing::Types<color_fuzzy_4_of_8, color_fuzzy_2_of_8, adaptive_ca_4_of_8, adaptive_ca_2_of_8>;
using large_designs =
    testing::Types<color_fuzzy_40_of_80, color_fuzzy_16_of_80, adaptive_ca_40_of_80, adaptive_ca_16_of_80>;

template <class Design>
class few_level_groups : public level_groups<Design> {};
TYPED_TEST_SUITE(few_level_groups, small_designs);
template <class Design>
class many_level_groups : public level_groups<Design> {};
TYPED_TEST_SUITE(many_level_groups, large_designs);

TYPED_TEST(few_level_groups, random_frames_are_the_same_at_every_level_under_stalls) {
  using method = typename TypeParam::method;
  using config = typename TypeParam::config;
  std::mt19937 random(31);
  const auto model = TypeParam::make(1);
  for (std::uint64_t round = 0; round < 24; ++round) {
    const random_frame_of<method> first(random, 40, 12, config::levels);
    const random_frame_of<method> second(random, 40, 12, config::levels);
    const std::vector<eval::match_request> requests{first.request(), second.request()};
    SCOPED_TRACE(testing::Message() << "round " << round << ", " << first.pair.left.width << "x"
                                    << first.pair.left.height << ", " << first.with.levels << " levels");
    drive_options options;
    options.seed = 400 + round;
    const int percents[] = {0, 25, 90};
    options.stalls = {{"left", {percents[round % 3], 1}},
                      {"right", {percents[round / 3 % 3], 1}},
                      {"disparity", {percents[round / 9 % 3], round % 2 == 0 ? 1u : 40u}}};
    options.probe_outputs = round % 2 == 0;
    const frames_run run = run_frames(*model, requests, config::pixels_per_beat, options);
    for (std::size_t index = 0; index < 2; ++index) {
      const random_frame_of<method>& frame = index == 0 ? first : second;
      const eval::disparity_map golden = golden_map<method>(requests[index]);
      ASSERT_TRUE(same_maps(native_map_of<method, config>(frame.pair, frame.with), golden)) << "native";
      ASSERT_TRUE(same_maps(this->graph_map(requests[index]), golden)) << "graph";
      ASSERT_TRUE(same_maps(run.maps[index], golden)) << "rtl, frame " << index;
    }
  }
}

TYPED_TEST(few_level_groups, memories_and_a_broken_off_frame_leave_nothing_behind) {
  using method = typename TypeParam::method;
  using config = typename TypeParam::config;
  std::mt19937 random(32);
  const random_frame_of<method> frame(random, 60, 20, config::levels);
  const eval::disparity_map golden = golden_map<method>(frame.request());
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const auto model = TypeParam::make(seed);
    // Some tokens only, then the driver gives up; its next run begins with a reset.
    frame_tokens frames(model->ports(), config::pixels_per_beat);
    drive_request part;
    frames.append_frame(frame.request(), part.inputs);
    for (const char* name : {"left", "right"}) {
      const token_list all = part.inputs.at(name);
      token_list& some = part.inputs.at(name) = token_list(all.width());
      for (std::size_t index = 0; index < all.size() * seed / 4; ++index) some.push_back(all[index]);
    }
    drive_options options;
    options.patience = 500;
    static_cast<void>(drive(*model, part, options));
    ASSERT_TRUE(same_maps(run_frames(*model, {frame.request()}, config::pixels_per_beat, {}).maps[0], golden))
        << "contents of seed " << seed;
  }
}

TYPED_TEST(many_level_groups, a_scene_is_the_same_at_every_level) {
  using method = typename TypeParam::method;
  using config = typename TypeParam::config;
  typename method::settings with;
  with.levels = config::levels;
  const test::stereo_pair scene = synthetic_scene(320, 48, config::levels, 33);
  const eval::match_request request = request_of<method>(scene, with);
  const eval::disparity_map golden = golden_map<method>(request);
  EXPECT_TRUE(same_maps(native_map_of<method, config>(scene, with), golden)) << "native";
  EXPECT_TRUE(same_maps(run_frames(*TypeParam::make(1), {request}, config::pixels_per_beat, {}).maps[0], golden))
      << "rtl";
  EXPECT_TRUE(same_maps(this->graph_map(request), golden)) << "graph";
}

/// The upper third of a real pair, whole rows.
test::picture part_of(const std::filesystem::path& file) {
  const eval::rgb_image whole = eval::read_stereo_image(file);
  test::picture part{whole.width, whole.height / 3, {}};
  part.channels.assign(whole.pixels.begin(), whole.pixels.begin() + part.width * part.height * 3);
  return part;
}

TYPED_TEST(many_level_groups, a_part_of_a_real_pair_is_the_same_under_stalls) {
  using method = typename TypeParam::method;
  using config = typename TypeParam::config;
  const char* data = std::getenv("EPILINE_DATA");
  const std::filesystem::path folder =
      std::filesystem::path(data != nullptr ? data : EPILINE_SOURCE_FOLDER "/../shared/data") / "cones";
  if (!std::filesystem::exists(folder / "left.ppm")) GTEST_SKIP() << "no pair in " << folder;
  const test::stereo_pair pair{part_of(folder / "left.ppm"), part_of(folder / "right.ppm")};
  typename method::settings with;
  with.levels = 60;
  const eval::match_request request = request_of<method>(pair, with);
  const eval::disparity_map golden = golden_map<method>(request);
  EXPECT_TRUE(same_maps(native_map_of<method, config>(pair, with), golden)) << "native";
  drive_options options;
  options.seed = 34;
  options.stalls = {{"left", {25, 1}}, {"right", {25, 1}}, {"disparity", {25, 1}}};
  EXPECT_TRUE(same_maps(run_frames(*TypeParam::make(1), {request}, config::pixels_per_beat, options).maps[0], golden))
      << "rtl";
}

TYPED_TEST(many_level_groups, a_frame_of_640x480_takes_a_clock_a_group_and_little_more) {
  using method = typename TypeParam::method;
  using config = typename TypeParam::config;
  const test::stereo_pair scene = synthetic_scene(640, 480, config::levels, 35);
  const eval::match_request request = request_of<method>(scene, {});
  const frames_run run = run_frames(*TypeParam::make(1), {request, request}, config::pixels_per_beat, {});
  EXPECT_TRUE(same_maps(run.maps[1], run.maps[0]));
  const std::uint64_t clocks = run.frame_ends[1] - run.frame_ends[0];
  testing::Test::RecordProperty("clocks_a_frame", static_cast<int>(clocks));
  const double least = 640.0 * 480 * config::levels / config::parallel_disparities;
  EXPECT_LE(static_cast<double>(clocks), 1.03 * least) << clocks << " clocks";
}

}  // namespace
}  // namespace epiline::cosim
