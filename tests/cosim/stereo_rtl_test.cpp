// The methods as the compiler made them: the RTL in Verilator and the dataflow graph against the native kernels and the
// golden model, bit for bit, whatever the stalls.

#include <gtest/gtest.h>

#include "adaptive_ca_p2_rtl_model.hpp"
#include "adaptive_ca_rtl_model.hpp"
#include "adaptive_ca_small_p2_rtl_model.hpp"
#include "adaptive_ca_small_rtl_model.hpp"
#include "color_fuzzy_p2_rtl_model.hpp"
#include "color_fuzzy_rtl_model.hpp"
#include "color_fuzzy_small_p2_rtl_model.hpp"
#include "color_fuzzy_small_rtl_model.hpp"
#include "cosim/engines.hpp"
#include "frame_bench.hpp"

namespace epiline::cosim {
namespace {

struct color_fuzzy_full {
  using method = color_fuzzy_method;
  using config = method::config;
  static constexpr const char* graph = COLOR_FUZZY_GRAPH;
  static auto make(std::uint64_t seed) { return make_color_fuzzy_rtl_model(seed); }
};
struct color_fuzzy_two_pixels {
  using method = color_fuzzy_method;
  using config = tops::two_pixels_a_beat_of<tops::color_fuzzy_config>;
  static constexpr const char* graph = COLOR_FUZZY_P2_GRAPH;
  static auto make(std::uint64_t seed) { return make_color_fuzzy_p2_rtl_model(seed); }
};
struct color_fuzzy_few_levels {
  using method = color_fuzzy_method;
  using config = tops::few_levels_of<tops::color_fuzzy_config>;
  static constexpr const char* graph = COLOR_FUZZY_SMALL_GRAPH;
  static auto make(std::uint64_t seed) { return make_color_fuzzy_small_rtl_model(seed); }
};
struct color_fuzzy_few_levels_two_pixels {
  using method = color_fuzzy_method;
  using config = tops::two_pixels_a_beat_of<tops::few_levels_of<tops::color_fuzzy_config>>;
  static constexpr const char* graph = COLOR_FUZZY_SMALL_P2_GRAPH;
  static auto make(std::uint64_t seed) { return make_color_fuzzy_small_p2_rtl_model(seed); }
};
struct adaptive_ca_full {
  using method = adaptive_ca_method;
  using config = method::config;
  static constexpr const char* graph = ADAPTIVE_CA_GRAPH;
  static auto make(std::uint64_t seed) { return make_adaptive_ca_rtl_model(seed); }
};
struct adaptive_ca_two_pixels {
  using method = adaptive_ca_method;
  using config = tops::two_pixels_a_beat_of<tops::adaptive_ca_config>;
  static constexpr const char* graph = ADAPTIVE_CA_P2_GRAPH;
  static auto make(std::uint64_t seed) { return make_adaptive_ca_p2_rtl_model(seed); }
};
struct adaptive_ca_few_levels {
  using method = adaptive_ca_method;
  using config = tops::few_levels_of<tops::adaptive_ca_config>;
  static constexpr const char* graph = ADAPTIVE_CA_SMALL_GRAPH;
  static auto make(std::uint64_t seed) { return make_adaptive_ca_small_rtl_model(seed); }
};
struct adaptive_ca_few_levels_two_pixels {
  using method = adaptive_ca_method;
  using config = tops::two_pixels_a_beat_of<tops::few_levels_of<tops::adaptive_ca_config>>;
  static constexpr const char* graph = ADAPTIVE_CA_SMALL_P2_GRAPH;
  static auto make(std::uint64_t seed) { return make_adaptive_ca_small_p2_rtl_model(seed); }
};

template <class Design>
class stereo_rtl : public testing::Test {
 protected:
  using config = typename Design::config;
  static constexpr int pixels_per_beat = config::pixels_per_beat;

  static eval::disparity_map graph_map(const eval::match_request& request) {
    eval::design_description design = *eval::find_design(Design::method::name);
    design.pixels_per_beat = pixels_per_beat;
    return make_graph_engine(design, Design::graph)->match(request, {}).map;
  }
};

// With two pixels a beat the small configurations stand for the full ones, which take long: those meet scenes and real
// pairs.
using designs = testing::Types<color_fuzzy_full, color_fuzzy_few_levels, color_fuzzy_few_levels_two_pixels,
                               adaptive_ca_full, adaptive_ca_few_levels, adaptive_ca_few_levels_two_pixels>;
TYPED_TEST_SUITE(stereo_rtl, designs);

TYPED_TEST(stereo_rtl, random_frames_are_the_same_at_every_level) {
  using config = typename TypeParam::config;
  std::mt19937 random(11);
  const auto model = TypeParam::make(1);
  for (int round = 0; round < 12; ++round) {
    const random_frame_of<typename TypeParam::method> frame(random, 60, 14, config::levels);
    const eval::match_request request = frame.request();
    SCOPED_TRACE(testing::Message() << "round " << round << ", " << frame.pair.left.width << "x"
                                    << frame.pair.left.height << ", " << frame.with.levels << " levels");
    const eval::disparity_map golden = golden_map<typename TypeParam::method>(request);
    ASSERT_TRUE(same_maps(native_map_of<typename TypeParam::method, config>(frame.pair, frame.with), golden))
        << "native";
    ASSERT_TRUE(same_maps(this->graph_map(request), golden)) << "graph";
    ASSERT_TRUE(same_maps(run_frames(*model, {request}, config::pixels_per_beat, {}).maps[0], golden)) << "rtl";
  }
}

TYPED_TEST(stereo_rtl, every_mix_of_stalls_leaves_two_changing_frames_as_they_are) {
  using config = typename TypeParam::config;
  std::mt19937 random(12);
  const auto model = TypeParam::make(2);
  std::uint64_t seed = 100;
  for (const int left : {0, 25, 50, 90}) {
    for (const int right : {0, 25, 50, 90}) {
      for (const int out : {0, 25, 50, 90}) {
        ++seed;
        SCOPED_TRACE(testing::Message() << "stalls left " << left << ", right " << right << ", out " << out << ", seed "
                                        << seed);
        const random_frame_of<typename TypeParam::method> first(random, 20, 9, config::levels);
        const random_frame_of<typename TypeParam::method> second(random, 20, 9, config::levels);
        const std::vector<eval::match_request> requests{first.request(), second.request()};
        drive_options options;
        options.seed = seed;
        const unsigned burst = seed % 3 == 0 ? 40 : 1;
        options.stalls = {{"left", {left, burst}}, {"right", {right, burst}}, {"disparity", {out, burst}}};
        if (seed % 4 == 0) options.stalls["call"] = {90, 100};
        options.probe_outputs = seed % 2 == 0;
        options.ready_after_valid = seed % 5 == 0;
        const frames_run run = run_frames(*model, requests, config::pixels_per_beat, options);
        ASSERT_TRUE(same_maps(run.maps[0], golden_map<typename TypeParam::method>(requests[0]))) << "first frame";
        ASSERT_TRUE(same_maps(run.maps[1], golden_map<typename TypeParam::method>(requests[1]))) << "second frame";
      }
    }
  }
}

TYPED_TEST(stereo_rtl, does_not_trust_what_was_in_its_memories) {
  using config = typename TypeParam::config;
  std::mt19937 random(13);
  const random_frame_of<typename TypeParam::method> frame(random, 60, 20, config::levels);
  const eval::disparity_map golden = golden_map<typename TypeParam::method>(frame.request());
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const auto model = TypeParam::make(seed);
    ASSERT_TRUE(same_maps(run_frames(*model, {frame.request()}, config::pixels_per_beat, {}).maps[0], golden))
        << "contents of seed " << seed;
  }
}

TYPED_TEST(stereo_rtl, a_reset_in_the_middle_of_a_frame_leaves_nothing_behind) {
  using config = typename TypeParam::config;
  std::mt19937 random(14);
  const auto model = TypeParam::make(1);
  const random_frame_of<typename TypeParam::method> frame(random, 60, 20, config::levels);
  // Half of the tokens, then the driver gives up; its next run begins with a reset.
  frame_tokens frames(model->ports(), config::pixels_per_beat);
  drive_request half;
  frames.append_frame(frame.request(), half.inputs);
  for (const char* name : {"left", "right"}) {
    const token_list all = half.inputs.at(name);
    token_list& some = half.inputs.at(name) = token_list(all.width());
    for (std::size_t index = 0; index < all.size() / 2; ++index) some.push_back(all[index]);
  }
  drive_options options;
  options.patience = 500;
  static_cast<void>(drive(*model, half, options));
  EXPECT_TRUE(same_maps(run_frames(*model, {frame.request()}, config::pixels_per_beat, {}).maps[0],
                        golden_map<typename TypeParam::method>(frame.request())));
}

template <class Design>
void expect_scene_at_every_level(int width, int height) {
  using config = typename Design::config;
  typename Design::method::settings with;
  with.levels = config::levels;
  const test::stereo_pair scene = synthetic_scene(width, height, config::levels, 15);
  const eval::match_request request = request_of<typename Design::method>(scene, with);
  const eval::disparity_map golden = golden_map<typename Design::method>(request);
  EXPECT_TRUE(same_maps(native_map_of<typename Design::method, config>(scene, with), golden)) << "native";
  const auto model = Design::make(1);
  EXPECT_TRUE(same_maps(run_frames(*model, {request}, config::pixels_per_beat, {}).maps[0], golden)) << "rtl";
  eval::design_description design = *eval::find_design(Design::method::name);
  design.pixels_per_beat = config::pixels_per_beat;
  EXPECT_TRUE(same_maps(make_graph_engine(design, Design::graph)->match(request, {}).map, golden)) << "graph";
}

TEST(color_fuzzy_80_levels, a_scene_is_the_same_at_every_level) {
  expect_scene_at_every_level<color_fuzzy_full>(320, 96);
}
TEST(color_fuzzy_80_levels, a_scene_is_the_same_with_two_pixels_a_beat) {
  expect_scene_at_every_level<color_fuzzy_two_pixels>(319, 64);
}
TEST(color_fuzzy_80_levels, the_widest_row_fits) { expect_scene_at_every_level<color_fuzzy_full>(1024, 9); }
TEST(adaptive_ca_80_levels, a_scene_is_the_same_at_every_level) {
  expect_scene_at_every_level<adaptive_ca_full>(320, 96);
}
TEST(adaptive_ca_80_levels, a_scene_is_the_same_with_two_pixels_a_beat) {
  expect_scene_at_every_level<adaptive_ca_two_pixels>(319, 64);
}
TEST(adaptive_ca_80_levels, the_widest_row_fits) { expect_scene_at_every_level<adaptive_ca_full>(1024, 9); }

/// Clocks from the end of one frame to the end of the next of the same size, without stalls.
template <class Design>
std::uint64_t clocks_a_frame(int width, int height) {
  using config = typename Design::config;
  typename Design::method::settings with;
  const test::stereo_pair scene = synthetic_scene(width, height, config::levels, 16);
  const auto model = Design::make(1);
  const eval::match_request request = request_of<typename Design::method>(scene, with);
  const frames_run run = run_frames(*model, {request, request}, config::pixels_per_beat, {});
  EXPECT_TRUE(same_maps(run.maps[1], run.maps[0]));
  return run.frame_ends[1] - run.frame_ends[0];
}

template <class Design>
void expect_few_clocks(int width, int height) {
  const std::uint64_t clocks = clocks_a_frame<Design>(width, height);
  const double least = static_cast<double>(width) * height / Design::config::pixels_per_beat;
  testing::Test::RecordProperty("clocks_a_frame", static_cast<int>(clocks));
  EXPECT_LE(static_cast<double>(clocks), 1.03 * least) << width << "x" << height << ": " << clocks << " clocks, "
                                                       << static_cast<double>(clocks) / least << " times the pixels";
}

TEST(color_fuzzy_cycles, a_frame_of_320x240) { expect_few_clocks<color_fuzzy_full>(320, 240); }
TEST(color_fuzzy_cycles, a_frame_of_640x480) { expect_few_clocks<color_fuzzy_full>(640, 480); }
TEST(color_fuzzy_cycles, a_frame_of_640x480_with_two_pixels_a_beat) {
  expect_few_clocks<color_fuzzy_two_pixels>(640, 480);
}

/// Method 1's result lies 7 rows below its newest pixel: smaller frames take relatively more.
TEST(adaptive_ca_cycles, a_frame_of_640x480) { expect_few_clocks<adaptive_ca_full>(640, 480); }
TEST(adaptive_ca_cycles, a_frame_of_640x480_with_two_pixels_a_beat) {
  expect_few_clocks<adaptive_ca_two_pixels>(640, 480);
}

}  // namespace
}  // namespace epiline::cosim
