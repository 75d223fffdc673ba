// Method 2 for iCE40 HX8K as the compiler made it: the same maps at every level, with the largest frame it takes.

#include <gtest/gtest.h>

#include "color_fuzzy_hx8k_rtl_model.hpp"
#include "cosim/engines.hpp"
#include "frame_bench.hpp"
#include "tops/color_fuzzy_hx8k.hpp"

namespace epiline::cosim {
namespace {

using config = tops::color_fuzzy_hx8k_config;
using method = color_fuzzy_method;

TEST(color_fuzzy_hx8k, its_largest_frame_is_the_same_at_every_level) {
  test::settings with;
  with.levels = config::levels;
  const test::stereo_pair scene = synthetic_scene(config::max_width, config::max_height, config::levels, 41);
  const eval::match_request request = request_of<method>(scene, with);
  const eval::disparity_map golden = golden_map<method>(request);
  EXPECT_TRUE(same_maps(native_map_of<method, config>(scene, with), golden)) << "native";
  const auto graph = make_graph_engine(*eval::find_design("color_fuzzy_hx8k"), COLOR_FUZZY_HX8K_GRAPH);
  EXPECT_TRUE(same_maps(graph->match(request, {}).map, golden)) << "graph";
  const auto model = make_color_fuzzy_hx8k_rtl_model(1);
  const frames_run run = run_frames(*model, {request, request}, config::pixels_per_beat, {});
  EXPECT_TRUE(same_maps(run.maps[0], golden)) << "rtl";
  EXPECT_TRUE(same_maps(run.maps[1], golden)) << "rtl, second frame";
  RecordProperty("clocks_a_frame", static_cast<int>(run.frame_ends[1] - run.frame_ends[0]));
}

TEST(color_fuzzy_hx8k, random_frames_are_the_same_under_stalls) {
  std::mt19937 random(42);
  const auto model = make_color_fuzzy_hx8k_rtl_model(2);
  for (std::uint64_t round = 0; round < 12; ++round) {
    const random_frame frame(random, config::max_width, 24, config::levels);
    drive_options options;
    options.seed = 500 + round;
    options.stalls = {{"left", {25, 1}}, {"right", {25, 1}}, {"disparity", {25, 1}}};
    const frames_run run = run_frames(*model, {frame.request()}, config::pixels_per_beat, options);
    ASSERT_TRUE(same_maps(run.maps[0], golden_map<method>(frame.request()))) << "round " << round;
  }
}

}  // namespace
}  // namespace epiline::cosim
