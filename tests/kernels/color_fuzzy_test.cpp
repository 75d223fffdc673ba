// The whole of method 2 against brute force, over sizes, parameters and pixels a beat. One object of state serves all
// frames of a configuration, as in hardware: whatever one frame leaves behind meets the next one.
#include <gtest/gtest.h>

#include "brute_force.hpp"

namespace epiline::test {
namespace {

template <int Lanes, int Levels, int MaxWidth, int ParallelDisparities = kernels::all_levels>
struct test_config : tops::color_fuzzy_config {
  static constexpr int max_width = MaxWidth;
  static constexpr int max_height = 15;
  static constexpr int levels = Levels;
  static constexpr int parallel_disparities = ParallelDisparities;
  static constexpr int pixels_per_beat = Lanes;
};

template <class Config>
class color_fuzzy_of : public testing::Test {
 protected:
  void expect_equal(const stereo_pair& pair, const settings& with) {
    const disparity_map expected = brute_force_color_fuzzy(pair, with);
    const disparity_map actual = run_color_fuzzy<Config>(pair, with);
    ASSERT_EQ(actual, expected) << pair.left.width << " x " << pair.left.height << ", levels " << with.levels
                                << ", left_right " << with.left_right << ", uniqueness " << with.uniqueness
                                << ", fuzzy " << with.fuzzy << ", careful_fill " << with.careful_fill;
  }
};

using configs = testing::Types<test_config<1, 8, 64>, test_config<2, 8, 64>, test_config<4, 8, 64>,  //
                               test_config<1, 13, 40>, test_config<2, 13, 40>, test_config<4, 13, 41>,
                               test_config<1, 1, 40>, test_config<2, 2, 40>, test_config<4, 3, 40>,  //
                               test_config<1, 64, 40>, test_config<4, 80, 40>,                       //
                               test_config<1, 8, 64, 8>, test_config<1, 8, 64, 4>, test_config<1, 8, 64, 2>,
                               test_config<1, 8, 64, 1>, test_config<1, 15, 40, 5>, test_config<1, 128, 40, 16>>;
TYPED_TEST_SUITE(color_fuzzy_of, configs);

TYPED_TEST(color_fuzzy_of, every_size) {
  std::mt19937 random(1);
  for (int width = 1; width <= 40; ++width) {
    for (int height = 1; height <= 10; height += 1 + width % 3) {
      const stereo_pair pair = random_pair(random, width, height, 6, 12);
      this->expect_equal(pair, {.levels = TypeParam::levels});
      if (this->HasFatalFailure()) return;
    }
  }
}

TYPED_TEST(color_fuzzy_of, every_parameter_with_frames_back_to_back) {
  std::mt19937 random(2);
  const auto below = [&random](int count) { return static_cast<int>(random() % static_cast<unsigned>(count)); };
  for (int frame = 0; frame < 150; ++frame) {
    settings with;
    with.levels = 1 + below(TypeParam::levels);
    with.left_right = below(2) != 0;
    with.uniqueness = below(3) == 0 ? 0 : below(32);
    with.fuzzy = below(3);
    with.careful_fill = below(2) != 0;
    const stereo_pair pair = random_pair(random, 1 + below(40), 1 + below(10), below(12), 1 + below(40));
    this->expect_equal(pair, with);
    if (this->HasFatalFailure()) return;
  }
}

TYPED_TEST(color_fuzzy_of, largest_costs_do_not_overflow) {
  stereo_pair pair{{40, 10, {}}, {40, 10, {}}};
  pair.left.channels.assign(40 * 10 * 3, 255);
  pair.right.channels.assign(40 * 10 * 3, 0);
  this->expect_equal(pair, {.levels = TypeParam::levels});
  this->expect_equal(pair, {.levels = TypeParam::levels, .uniqueness = 31});
}

TYPED_TEST(color_fuzzy_of, frame_of_largest_size) {
  std::mt19937 random(3);
  this->expect_equal(random_pair(random, TypeParam::max_width, TypeParam::max_height, 9, 20),
                     {.levels = TypeParam::levels});
}

/// Random frames must not agree by staying in one corner of the method: every step has to decide both ways.
TEST(color_fuzzy_stimulus, makes_every_step_matter) {
  std::mt19937 random(4);
  const stereo_pair pair = random_pair(random, 40, 10, 6, 12);
  const auto map = [&pair](settings with) { return brute_force_color_fuzzy(pair, with); };
  const settings raw{.levels = 8, .left_right = false, .uniqueness = 0, .fuzzy = 0};
  settings changed = raw;
  changed.left_right = true;
  EXPECT_NE(map(raw), map(changed));
  changed = raw;
  changed.uniqueness = 17;
  EXPECT_NE(map(raw), map(changed));
  settings once{.levels = 8, .fuzzy = 1};
  settings twice{.levels = 8, .fuzzy = 2};
  EXPECT_NE(map(once), map(twice));
  settings careful = twice;
  careful.careful_fill = true;
  EXPECT_NE(map(twice), map(careful));
  for (int d = 0; d < 7; ++d) {
    const auto winners = map(raw);
    EXPECT_GT(std::count(winners.begin(), winners.end(), d), 0) << "level " << d << " never wins";
  }
}

TEST(color_fuzzy_three_passes, count_as_two) {
  std::mt19937 random(5);
  using config = test_config<1, 8, 64>;
  const stereo_pair pair = random_pair(random, 40, 10, 6, 12);
  EXPECT_EQ(run_color_fuzzy<config>(pair, {.levels = 8, .fuzzy = 3}),
            run_color_fuzzy<config>(pair, {.levels = 8, .fuzzy = 2}));
}

}  // namespace
}  // namespace epiline::test
