// The whole of method 1 against brute force, over sizes, parameters and pixels a beat. One object of state serves all
// frames of a configuration, as in hardware: whatever one frame leaves behind meets the next one.
#include <gtest/gtest.h>

#include "brute_force_adaptive_ca.hpp"

namespace epiline::test {
namespace {

template <int Lanes, int Levels, int MaxWidth, int ParallelDisparities = kernels::all_levels>
struct test_config : tops::adaptive_ca_config {
  static constexpr int max_width = MaxWidth;
  static constexpr int max_height = 15;
  static constexpr int levels = Levels;
  static constexpr int parallel_disparities = ParallelDisparities;
  static constexpr int pixels_per_beat = Lanes;
};

/// Pictures of smooth and busy regions, so that every window is chosen; the right one is the left one shifted by
/// region, with a little noise, so that neighbours agree often enough for the automaton.
stereo_pair adaptive_pair(std::mt19937& random, int width, int height, int largest_shift) {
  const auto below = [&random](int count) { return static_cast<int>(random() % static_cast<unsigned>(count)); };
  stereo_pair pair{{width, height, {}}, {width, height, {}}};
  const int cell = 2 + below(8);
  const int cells = 64;
  std::vector<int> contrast(cells * cells);
  std::vector<int> shift(cells * cells);
  for (auto& value : contrast) value = below(3) == 0 ? 255 : below(40) + 1;
  for (auto& value : shift) value = below(largest_shift + 1);
  const auto region = [&](int x, int y) {
    return static_cast<std::size_t>(y / cell % cells * cells + x / cell % cells);
  };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < 3; ++c) {
        pair.left.channels.push_back(static_cast<std::uint8_t>(below(contrast[region(x, y)])));
      }
    }
  }
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const int from = std::min(x + shift[region(x, y)], width - 1);
      for (int c = 0; c < 3; ++c) {
        pair.right.channels.push_back(
            static_cast<std::uint8_t>(std::clamp(pair.left.at(from, y, c) + below(5) - 2, 0, 255)));
      }
    }
  }
  return pair;
}

template <class Config>
class adaptive_ca_of : public testing::Test {
 protected:
  void expect_equal(const stereo_pair& pair, const adaptive_ca_settings& with) {
    const disparity_map expected = brute_force_adaptive_ca(pair, with);
    const disparity_map actual = run_adaptive_ca<Config>(pair, with);
    ASSERT_EQ(actual, expected) << pair.left.width << " x " << pair.left.height << ", levels " << with.levels << ", t2 "
                                << with.t2 << ", t5 " << with.t5 << ", automaton " << with.automaton << ", ring "
                                << with.ring;
  }
};

using configs = testing::Types<test_config<1, 8, 64>, test_config<2, 8, 64>, test_config<4, 8, 64>,  //
                               test_config<1, 13, 40>, test_config<2, 13, 40>, test_config<4, 13, 41>,
                               test_config<1, 1, 40>, test_config<2, 2, 40>, test_config<4, 3, 40>,  //
                               test_config<1, 64, 40>, test_config<4, 80, 40>,                       //
                               test_config<1, 8, 64, 4>, test_config<1, 8, 64, 2>, test_config<1, 8, 64, 1>,
                               test_config<1, 15, 40, 5>, test_config<1, 80, 40, 16>>;
TYPED_TEST_SUITE(adaptive_ca_of, configs);

TYPED_TEST(adaptive_ca_of, every_size) {
  std::mt19937 random(1);
  for (int width = 1; width <= 40; ++width) {
    for (int height = 1; height <= 10; height += 1 + width % 3) {
      const stereo_pair pair = adaptive_pair(random, width, height, 3);
      this->expect_equal(pair, {.levels = TypeParam::levels, .automaton = false});
      this->expect_equal(pair, {.levels = TypeParam::levels, .ring = 1 + width % 8});
      if (this->HasFatalFailure()) return;
    }
  }
}

TYPED_TEST(adaptive_ca_of, every_parameter_with_frames_back_to_back) {
  std::mt19937 random(2);
  const auto below = [&random](int count) { return static_cast<int>(random() % static_cast<unsigned>(count)); };
  for (int frame = 0; frame < 100; ++frame) {
    adaptive_ca_settings with;
    with.levels = 1 + below(TypeParam::levels);
    with.t2 = below(3) == 0 ? below(256) : 10 + below(40);
    with.t5 = below(3) == 0 ? below(3183) : 20 + below(200);
    with.automaton = below(4) != 0;
    with.ring = below(3) == 0 ? 1 + below(40) : 1 + below(12);
    const stereo_pair pair = adaptive_pair(random, 1 + below(40), 1 + below(15), below(8));
    this->expect_equal(pair, with);
    if (this->HasFatalFailure()) return;
  }
}

TYPED_TEST(adaptive_ca_of, largest_costs_and_variations_do_not_overflow) {
  stereo_pair pair{{40, 15, {}}, {40, 15, {}}};
  pair.left.channels.assign(40 * 15 * 3, 255);
  pair.right.channels.assign(40 * 15 * 3, 0);
  this->expect_equal(pair, {.levels = TypeParam::levels});
  // A chequerboard has the largest variation; thresholds at and around it.
  for (int i = 0; i < 40 * 15; ++i) {
    for (int c = 0; c < 3; ++c) {
      pair.left.channels[static_cast<std::size_t>(3 * i + c)] = (i / 40 + i % 40) % 2 == 0 ? 255 : 0;
    }
  }
  for (const int t2 : {254, 255}) {
    for (const int t5 : {3181, 3182, 100}) this->expect_equal(pair, {.levels = TypeParam::levels, .t2 = t2, .t5 = t5});
  }
}

TYPED_TEST(adaptive_ca_of, frame_of_largest_size) {
  std::mt19937 random(3);
  this->expect_equal(adaptive_pair(random, TypeParam::max_width, TypeParam::max_height, 5),
                     {.levels = TypeParam::levels});
}

}  // namespace
}  // namespace epiline::test
