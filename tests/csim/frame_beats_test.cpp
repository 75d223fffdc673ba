#include "csim/frame_beats.hpp"

#include <gtest/gtest.h>

#include <functional>

namespace epiline::csim {
namespace {

eval::rgb_image counting_image(int width, int height) {
  eval::rgb_image image(width, height);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = static_cast<std::uint8_t>(i + 1);
  return image;
}

TEST(beats_of_image, puts_red_low_and_lane_0_low_and_starts_every_row_with_a_new_beat) {
  const auto beats = beats_of_image(counting_image(3, 2), 2);  // bytes 1..9 and 10..18
  ASSERT_EQ(beats.size(), 4u);
  EXPECT_EQ(beats[0], (beat{{0x04030201, 0x0605}, 0x3f, 1, false}));
  EXPECT_EQ(beats[1], (beat{{0x090807}, 0x07, 0, true}));
  EXPECT_EQ(beats[2], (beat{{0x0d0c0b0a, 0x0f0e}, 0x3f, 0, false}));
  EXPECT_EQ(beats[3], (beat{{0x121110}, 0x07, 0, true}));
}

TEST(beats_of_image, fills_four_lanes_across_word_boundaries) {
  const auto beats = beats_of_image(counting_image(4, 1), 4);
  ASSERT_EQ(beats.size(), 1u);
  EXPECT_EQ(beats[0], (beat{{0x04030201, 0x08070605, 0x0c0b0a09}, 0xfff, 1, true}));
}

TEST(beats_of_image, marks_the_only_beat_of_a_one_pixel_frame_as_first_and_last) {
  EXPECT_EQ(beats_of_image(counting_image(1, 1), 1), (std::vector<beat>{{{0x030201}, 0x7, 1, true}}));
}

/// 3x2 at two pixels a beat: defined 1, undefined, defined 0 / defined 127, defined 5, undefined.
std::vector<beat> good_frame() {
  return {{{0x0081}, 3, 1, false}, {{0x80}, 1, 0, true}, {{0x85ff}, 3, 0, false}, {{0}, 1, 0, true}};
}

TEST(map_of_beats, reads_disparity_and_valid_bit_of_every_lane) {
  const auto map = map_of_beats(good_frame(), 3, 2, 2);
  EXPECT_EQ(map.disparity, (std::vector<std::uint8_t>{1, 0, 0, 127, 5, 0}));
  EXPECT_EQ(map.defined, (std::vector<std::uint8_t>{1, 0, 1, 1, 1, 0}));
}

struct damage {
  const char* names;  // what the message must name
  std::function<void(std::vector<beat>&)> apply;
};

TEST(map_of_beats, refuses_a_malformed_frame_and_names_what_is_wrong) {
  const damage damages[] = {
      {"holds 3 beats, a 3x2 frame has 4", [](auto& beats) { beats.pop_back(); }},
      {"holds 5 beats", [](auto& beats) { beats.push_back(beats.back()); }},
      {"tuser", [](auto& beats) { beats[0].user = 0; }},
      {"beat 2 of the disparity stream (row 1, beat 0 of the row): tuser", [](auto& beats) { beats[2].user = 1; }},
      {"tlast", [](auto& beats) { beats[1].last = false; }},
      {"tlast", [](auto& beats) { beats[0].last = true; }},
      {"tkeep", [](auto& beats) { beats[1].keep = 3; }},
      {"lane 1 past the end of the row", [](auto& beats) { beats[1].data[0] |= 0x8100; }},
      {"undefined lane 1", [](auto& beats) { beats[0].data[0] |= 0x0100; }},
  };
  for (const auto& damage : damages) {
    auto beats = good_frame();
    damage.apply(beats);
    try {
      (void)map_of_beats(beats, 3, 2, 2);
      ADD_FAILURE() << "accepted: " << damage.names;
    } catch (const malformed_frame& error) {
      EXPECT_NE(std::string(error.what()).find(damage.names), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace epiline::csim
