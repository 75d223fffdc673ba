// The six shared stereo pairs at full size, against the maps of an independent prototype. Skipped where the pairs are
// not.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "frame_harness.hpp"

namespace epiline::test {
namespace {

namespace fs = std::filesystem;

/// The folder of pairs: EPILINE_DATA, else the shared one beside the repository; empty if there is none.
fs::path data_folder() {
  if (const char* data = std::getenv("EPILINE_DATA"); data != nullptr && *data != '\0') return fs::path(data);
  const fs::path beside = fs::path(EPILINE_SOURCE_DIR) / "../shared/data";
  return fs::exists(beside) ? beside : fs::path();
}

picture read_picture(const fs::path& folder, const std::string& stem) {
  for (const char* extension : {".ppm", ".png"}) {
    const fs::path file = folder / (stem + extension);
    if (!fs::exists(file)) continue;
    const cv::Mat bgr = cv::imread(file.string(), cv::IMREAD_COLOR);
    if (bgr.empty()) throw std::runtime_error("cannot read " + file.string());
    cv::Mat rgb;
    cv::cvtColor(bgr, rgb, cv::COLOR_BGR2RGB);
    return {rgb.cols, rgb.rows, std::vector<std::uint8_t>(rgb.datastart, rgb.dataend)};
  }
  throw std::runtime_error("no picture " + stem + " in " + folder.string());
}

class real_pair : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    const fs::path data = data_folder();
    reference_ = data / "../reference" / GetParam();
    if (!fs::exists(data / GetParam()) || !fs::exists(reference_)) {
      GTEST_SKIP() << "pair " << GetParam() << " with its reference maps is not on this machine";
    }
    std::ifstream file(data / "pairs.json");
    for (const auto& entry : nlohmann::json::parse(file)) {
      if (entry["scene"] == GetParam()) levels_ = entry["levels"];
    }
    ASSERT_GT(levels_, 0) << GetParam() << " is not in pairs.json";
    pair_.left = read_picture(data / GetParam(), "left");
    pair_.right = read_picture(data / GetParam(), "right");
  }

  void expect_reference(const settings& with, const char* name) {
    expect_equal(run_color_fuzzy<tops::color_fuzzy_config>(pair_, with), name);
  }
  void expect_reference(const adaptive_ca_settings& with, const char* name) {
    expect_equal(run_adaptive_ca<tops::adaptive_ca_config>(pair_, with), name);
  }

  void expect_equal(const disparity_map& map, const char* name) {
    const fs::path file = reference_ / name;
    const cv::Mat reference = cv::imread(file.string(), cv::IMREAD_UNCHANGED);
    ASSERT_EQ(reference.type(), CV_8U) << file;
    ASSERT_EQ(map.size(), reference.total());
    int differing = 0;
    for (std::size_t i = 0; i < map.size(); ++i) differing += map[i] != reference.data[i];
    EXPECT_EQ(differing, 0) << file;
  }

  fs::path reference_;
  stereo_pair pair_;
  int levels_ = 0;
};

TEST_P(real_pair, winner_equals_reference) {
  expect_reference(settings{levels_, false, 0, 0, false}, "color_fuzzy-raw.png");
}

TEST_P(real_pair, confident_winner_equals_reference) {
  expect_reference(settings{levels_, true, 17, 0, false}, "color_fuzzy-confident.png");
}

TEST_P(real_pair, whole_method_equals_reference) {
  expect_reference(settings{levels_, true, 17, 2, false}, "color_fuzzy.png");
}

TEST_P(real_pair, adaptive_winner_equals_reference) {
  expect_reference(adaptive_ca_settings{.levels = levels_, .automaton = false}, "adaptive_ca-off.png");
}

TEST_P(real_pair, automaton_equals_reference_for_every_ring) {
  expect_reference(adaptive_ca_settings{.levels = levels_, .ring = 1}, "adaptive_ca-r1.png");
  expect_reference(adaptive_ca_settings{.levels = levels_, .ring = 20}, "adaptive_ca-r20.png");
  expect_reference(adaptive_ca_settings{.levels = levels_, .ring = 24}, "adaptive_ca-r24.png");
}

INSTANTIATE_TEST_SUITE_P(shared, real_pair, testing::Values("tsukuba", "venus", "cones", "teddy", "motorcycle", "aloe"),
                         [](const auto& scene) { return std::string(scene.param); });

}  // namespace
}  // namespace epiline::test
