// The small configurations' netlists, as Yosys made them for ECP5: the same maps as the native kernels, on a crop of a
// real pair where there is one, on random frames and under stalls.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "adaptive_ca_small_netlist_model.hpp"
#include "color_fuzzy_small_netlist_model.hpp"
#include "eval/image_files.hpp"
#include "frame_bench.hpp"

namespace epiline::cosim {
namespace {

struct color_fuzzy_netlist {
  using method = color_fuzzy_method;
  using config = tops::few_levels_of<tops::color_fuzzy_config>;
  static auto make(std::uint64_t seed) { return make_color_fuzzy_small_netlist_model(seed); }
};
struct adaptive_ca_netlist {
  using method = adaptive_ca_method;
  using config = tops::few_levels_of<tops::adaptive_ca_config>;
  static auto make(std::uint64_t seed) { return make_adaptive_ca_small_netlist_model(seed); }
};

template <class Design>
class netlist : public testing::Test {
 protected:
  using method = typename Design::method;
  using settings = typename method::settings;
  static constexpr int levels = Design::config::levels;

  static void expect_native(const test::stereo_pair& pair, const settings& with, const drive_options& options) {
    const auto model = Design::make(options.seed);
    const frames_run run =
        run_frames(*model, {request_of<method>(pair, with)}, Design::config::pixels_per_beat, options);
    EXPECT_TRUE(same_maps(run.maps[0], native_map_of<method, typename Design::config>(pair, with)));
  }
};
using designs = testing::Types<color_fuzzy_netlist, adaptive_ca_netlist>;
TYPED_TEST_SUITE(netlist, designs);

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

TYPED_TEST(netlist, a_crop_of_a_real_pair_is_the_same) {
  const char* data = std::getenv("EPILINE_DATA");
  const std::filesystem::path folder =
      std::filesystem::path(data != nullptr ? data : EPILINE_SOURCE_FOLDER "/../shared/data") / "tsukuba";
  if (!std::filesystem::exists(folder / "left.ppm")) GTEST_SKIP() << "no pair in " << folder;
  const test::stereo_pair pair{crop_of(folder / "left.ppm"), crop_of(folder / "right.ppm")};
  typename TestFixture::settings with;
  with.levels = TestFixture::levels;
  this->expect_native(pair, with, {});
}

TYPED_TEST(netlist, a_synthetic_scene_is_the_same_with_stalls) {
  typename TestFixture::settings with;
  with.levels = TestFixture::levels;
  drive_options options;
  options.seed = 5;
  options.stalls = {{"left", {25, 1}}, {"right", {50, 1}}, {"disparity", {25, 1}}};
  this->expect_native(synthetic_scene(64, 40, TestFixture::levels, 21), with, options);
}

TYPED_TEST(netlist, random_frames_are_the_same) {
  std::mt19937 random(22);
  for (int round = 0; round < 6; ++round) {
    const random_frame_of<typename TypeParam::method> frame(random, 64, 16, TestFixture::levels);
    SCOPED_TRACE(testing::Message() << "round " << round);
    drive_options options;
    options.seed = 30 + static_cast<std::uint64_t>(round);
    this->expect_native(frame.pair, frame.with, options);
  }
}

}  // namespace
}  // namespace epiline::cosim
