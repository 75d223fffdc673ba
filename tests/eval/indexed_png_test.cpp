#include "eval/indexed_png.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <random>
#include <stdexcept>

namespace epiline::eval {
namespace {

TEST(indexed_png, is_read_back_by_another_library_as_it_was) {
  std::mt19937 random(5);
  for (const auto& [width, height, colours] : {std::tuple{1, 1, 1}, {7, 3, 2}, {3, 50, 255}, {301, 200, 256}}) {
    indexed_picture picture{width, height, {}, {}};
    const auto byte = [&] { return static_cast<std::uint8_t>(random() % 256); };
    for (int i = 0; i < colours; ++i) picture.colours.push_back({byte(), byte(), byte()});
    for (int i = 0; i < width * height; ++i) {
      picture.pixels.push_back(static_cast<std::uint8_t>(random() % static_cast<unsigned>(colours)));
    }
    const std::string bytes = png_of(picture);
    const auto decoded = cv::imdecode(std::vector<unsigned char>(bytes.begin(), bytes.end()), cv::IMREAD_COLOR);
    ASSERT_EQ(decoded.cols, width);
    ASSERT_EQ(decoded.rows, height);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const auto& pixel = decoded.at<cv::Vec3b>(y, x);
        const auto& expected = picture.colours[picture.pixels[static_cast<std::size_t>(y) * width + x]];
        ASSERT_EQ((rgb_colour{pixel[2], pixel[1], pixel[0]}), expected) << x << ' ' << y;
      }
    }
  }
}

TEST(indexed_png, refuses_what_is_no_picture) {
  EXPECT_THROW((void)png_of({0, 0, {{1, 2, 3}}, {}}), std::invalid_argument);
  EXPECT_THROW((void)png_of({2, 1, {{1, 2, 3}}, {0}}), std::invalid_argument);
  EXPECT_THROW((void)png_of({1, 1, {}, {0}}), std::invalid_argument);
  EXPECT_THROW((void)png_of({1, 1, std::vector<rgb_colour>(257), {0}}), std::invalid_argument);
  EXPECT_THROW((void)png_of({2, 1, {{1, 2, 3}}, {0, 1}}), std::invalid_argument);
}

TEST(disparity_colours, go_from_blue_to_red_without_black) {
  const auto colours = disparity_colours(255);
  ASSERT_EQ(colours.size(), 255u);
  EXPECT_GT(colours[20][2], colours[20][0]);
  EXPECT_GT(colours[240][0], colours[240][2]);
  for (const auto& colour : colours) EXPECT_GT(colour[0] + colour[1] + colour[2], 60);
}

}  // namespace
}  // namespace epiline::eval
