// The small configuration's netlist, as Yosys made it for ECP5: the same maps as the native kernels, on a crop of a
// real pair where there is one, on random frames and under stalls.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "color_fuzzy_small_netlist_model.hpp"
#include "eval/image_files.hpp"
#include "frame_bench.hpp"

namespace epiline::cosim {
namespace {

struct config : tops::color_fuzzy_config {
  static constexpr int max_width = 64;
  static constexpr int max_height = 255;
  static constexpr int levels = 8;
};

void expect_native(const test::stereo_pair& pair, const test::settings& with, const drive_options& options) {
  const auto model = make_color_fuzzy_small_netlist_model(options.seed);
  const frames_run run = run_frames(*model, {request_of(pair, with)}, config::pixels_per_beat, options);
  EXPECT_TRUE(same_maps(run.maps[0], native_map<config>(pair, with)));
}

/// A part of Tsukuba's pair, shrunk by leaving pixels out so that its disparities fit 8 levels.
test::picture crop_of(const std::filesystem::path& file) {
  const eval::rgb_image whole = eval::read_stereo_image(file);
  test::picture crop{64, 48, {}};
  for (int y = 0; y < crop.height; ++y) {
    for (int x = 0; x < crop.width; ++x) {
      const std::uint8_t* pixel = whole.at(120 + 2 * x, 100 + 2 * y);
      crop.channels.insert(crop.channels.end(), pixel, pixel + 3);
    }
  }
  return crop;
}

TEST(color_fuzzy_netlist, a_crop_of_a_real_pair_is_the_same) {
  const char* data = std::getenv("EPILINE_DATA");
  const std::filesystem::path folder =
      std::filesystem::path(data != nullptr ? data : EPILINE_SOURCE_FOLDER "/../shared/data") / "tsukuba";
  if (!std::filesystem::exists(folder / "left.ppm")) GTEST_SKIP() << "no pair in " << folder;
  const test::stereo_pair pair{crop_of(folder / "left.ppm"), crop_of(folder / "right.ppm")};
  test::settings with;
  with.levels = config::levels;
  expect_native(pair, with, {});
}

TEST(color_fuzzy_netlist, a_synthetic_scene_is_the_same_with_stalls) {
  test::settings with;
  with.levels = config::levels;
  drive_options options;
  options.seed = 5;
  options.stalls = {{"left", {25, 1}}, {"right", {50, 1}}, {"disparity", {25, 1}}};
  expect_native(synthetic_scene(64, 40, config::levels, 21), with, options);
}

TEST(color_fuzzy_netlist, random_frames_are_the_same) {
  std::mt19937 random(22);
  for (int round = 0; round < 6; ++round) {
    const random_frame frame(random, 64, 16, config::levels);
    SCOPED_TRACE(testing::Message() << "round " << round);
    drive_options options;
    options.seed = 30 + static_cast<std::uint64_t>(round);
    expect_native(frame.pair, frame.with, options);
  }
}

}  // namespace
}  // namespace epiline::cosim
