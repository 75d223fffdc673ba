// Whole real stereo pairs through the full-size RTL with random stalls and through the dataflow graph, against the
// native kernels and the golden model. Skipped where the pairs are not.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "cosim/engines.hpp"
#include "eval/image_files.hpp"
#include "frame_bench.hpp"

namespace epiline::cosim {
namespace {

template <class Method>
class real_pair : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    const char* data = std::getenv("EPILINE_DATA");
    const std::filesystem::path folder = data != nullptr ? data : EPILINE_SOURCE_FOLDER "/../shared/data";
    std::ifstream file(folder / "pairs.json");
    if (!file) GTEST_SKIP() << "no real pairs in " << folder;
    for (const nlohmann::json& entry : nlohmann::json::parse(file)) {
      if (entry["scene"] == GetParam()) with_.levels = entry["levels"];
      if (entry["scene"] != GetParam()) continue;
      for (const auto& [name, hash] : entry["files"].items()) {
        const std::filesystem::path picture = folder / GetParam() / name;
        if (picture.stem() == "left") pair_.left = read(picture);
        if (picture.stem() == "right") pair_.right = read(picture);
      }
    }
    if (pair_.left.width == 0) GTEST_SKIP() << "no pair " << GetParam() << " in " << folder;
  }

  static test::picture read(const std::filesystem::path& path) {
    const eval::rgb_image image = eval::read_stereo_image(path);
    return {image.width, image.height, image.pixels};
  }

  [[nodiscard]] eval::match_result run(const std::string& name, const char* engine,
                                       const eval::run_options& options) const {
    eval::engine_registry registry;
    register_engines(registry);
    const eval::design_description& design = *eval::find_design(name);
    return registry.find(name, engine)->make(design)->match(request_of<Method>(pair_, with_), options);
  }

  void expect_same_at_every_level() const {
    const eval::disparity_map golden = golden_map<Method>(request_of<Method>(pair_, with_));
    ASSERT_TRUE(same_maps(native_map_of<Method, typename Method::config>(pair_, with_), golden)) << "native";
    eval::run_options options;
    options.seed = 7;
    options.input_gap_percent = 25;
    options.output_stall_percent = 25;
    EXPECT_TRUE(same_maps(run(Method::name, "rtl", options).map, golden)) << "rtl, seed 7";
    EXPECT_TRUE(same_maps(run(Method::name, "graph", {}).map, golden)) << "graph";
    EXPECT_TRUE(same_maps(run(two_pixels, "rtl", options).map, golden)) << two_pixels << " rtl, seed 7";
  }

  static inline const std::string two_pixels = std::string(Method::name) + "_p2";
  test::stereo_pair pair_;
  typename Method::settings with_;
};

using color_fuzzy_real_pair = real_pair<color_fuzzy_method>;
using adaptive_ca_real_pair = real_pair<adaptive_ca_method>;
const auto scenes = testing::Values("tsukuba", "venus", "cones", "teddy", "motorcycle", "aloe");
const auto scene_name = [](const auto& scene) { return std::string(scene.param); };

TEST_P(color_fuzzy_real_pair, is_the_same_at_every_level) { expect_same_at_every_level(); }
INSTANTIATE_TEST_SUITE_P(pairs, color_fuzzy_real_pair, scenes, scene_name);
TEST_P(adaptive_ca_real_pair, is_the_same_at_every_level) { expect_same_at_every_level(); }
INSTANTIATE_TEST_SUITE_P(pairs, adaptive_ca_real_pair, scenes, scene_name);

}  // namespace
}  // namespace epiline::cosim
