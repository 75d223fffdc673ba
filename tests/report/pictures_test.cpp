#include "report/pictures.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <set>
#include <stdexcept>

namespace epiline::report {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// Decodes base64 by its definition, bit by bit.
std::string decoded(const std::string& uri, const std::string& head) {
  EXPECT_EQ(uri.substr(0, head.size()), head);
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0;
  int held = 0;
  for (const char c : uri.substr(head.size())) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<unsigned>(digits.find(c));
    held += 6;
    if (held >= 8) bytes.push_back(static_cast<char>(bits >> (held -= 8) & 0xff));
  }
  return bytes;
}

cv::Mat picture_in(const std::string& uri, const std::string& type) {
  const std::string bytes = decoded(uri, "data:" + type + ";base64,");
  return cv::imdecode(std::vector<unsigned char>(bytes.begin(), bytes.end()), cv::IMREAD_COLOR);
}

eval::rgb_colour colour_at(const cv::Mat& picture, int x, int y) {
  const auto& pixel = picture.at<cv::Vec3b>(y, x);
  return {pixel[2], pixel[1], pixel[0]};
}

TEST(data_uri, pads_as_base64_does) {
  EXPECT_EQ(data_uri("text/plain", ""), "data:text/plain;base64,");
  EXPECT_EQ(data_uri("text/plain", "M"), "data:text/plain;base64,TQ==");
  EXPECT_EQ(data_uri("text/plain", "Ma"), "data:text/plain;base64,TWE=");
  EXPECT_EQ(data_uri("text/plain", "Man"), "data:text/plain;base64,TWFu");
  EXPECT_EQ(data_uri("text/plain", "\xff\xfe\xfd"), "data:text/plain;base64,//79");
}

TEST(error_class, has_the_thresholds_of_the_measures) {
  EXPECT_EQ(class_of(5, 5), error_class::right);
  EXPECT_EQ(class_of(5, 6), error_class::right);
  EXPECT_EQ(class_of(5, 6.01), error_class::off_by_two);
  EXPECT_EQ(class_of(5, 3), error_class::off_by_two);
  EXPECT_EQ(class_of(5, 2.99), error_class::wrong);
  EXPECT_EQ(class_of(none, 3), error_class::undefined);
  EXPECT_EQ(class_of(5, none), error_class::unknown);
  EXPECT_EQ(class_of(none, none), error_class::unknown);
}

TEST(error_uri, shows_each_class_in_its_colour_and_leaves_out_what_does_not_count) {
  const eval::real_map map{3, 2, {5, 5, 5, none, 5, 5}};
  eval::ground_truth truth{{3, 2, {5, 7, 9, 5, none, 5}}, std::nullopt, std::nullopt};
  truth.evaluated = eval::pixel_mask{3, 2, {true, true, true, true, true, false}};
  const auto picture = picture_in(error_uri(map, truth), "image/png");
  const error_class expected[] = {error_class::right,     error_class::off_by_two, error_class::wrong,
                                  error_class::undefined, error_class::unknown,    error_class::unknown};
  for (int i = 0; i < 6; ++i) {
    EXPECT_EQ(colour_at(picture, i % 3, i / 3), error_looks()[static_cast<std::size_t>(expected[i])].colour) << i;
  }
  EXPECT_THROW((void)error_uri({1, 1, {5}}, truth), std::invalid_argument);
}

TEST(error_looks, differ) {
  std::set<eval::rgb_colour> colours;
  for (const auto& look : error_looks()) EXPECT_TRUE(colours.insert(look.colour).second) << look.meaning;
}

TEST(map_uri, has_one_scale_from_far_to_near_with_black_for_undefined) {
  const auto picture = picture_in(map_uri({4, 1, {0, 15, 40, none}}, 16), "image/png");
  const auto scale = eval::disparity_colours(255);
  EXPECT_EQ(colour_at(picture, 0, 0), scale.front());
  EXPECT_EQ(colour_at(picture, 1, 0), scale.back());
  EXPECT_EQ(colour_at(picture, 2, 0), scale.back());  // beyond the levels
  EXPECT_EQ(colour_at(picture, 3, 0), (eval::rgb_colour{0, 0, 0}));
}

TEST(photograph_uri, keeps_size_and_colours) {
  eval::rgb_image image(32, 16);
  for (std::size_t i = 0; i < image.pixels.size(); i += 3) image.pixels[i] = 200;  // red
  const auto picture = picture_in(photograph_uri(image), "image/jpeg");
  ASSERT_EQ(picture.cols, 32);
  ASSERT_EQ(picture.rows, 16);
  EXPECT_NEAR(colour_at(picture, 9, 9)[0], 200, 6);
  EXPECT_NEAR(colour_at(picture, 9, 9)[2], 0, 6);
}

TEST(hexadecimal, writes_two_digits_a_colour) { EXPECT_EQ(hexadecimal({0, 10, 255}), "#000aff"); }

}  // namespace
}  // namespace epiline::report
