#include "opencv/matchers.hpp"

#include <fmt/format.h>

#include <limits>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace epiline::opencv {
namespace {

constexpr int block_window = 11;
constexpr int semi_global_window = 3;
constexpr int colours = 3;
constexpr int small_penalty = 8 * colours * semi_global_window * semi_global_window;
constexpr int large_penalty = 32 * colours * semi_global_window * semi_global_window;
constexpr int right_check = 1;
constexpr int prefilter_cap = 63;
constexpr int uniqueness_percent = 10;
constexpr int speckle_pixels = 100;
constexpr int speckle_range = 2;
constexpr double fractions = cv::StereoMatcher::DISP_SCALE;  // OpenCV's maps are in sixteenths of a pixel

cv::Mat picture_of(const eval::rgb_image& image) {
  const cv::Mat rgb(image.height, image.width, CV_8UC3, const_cast<std::uint8_t*>(image.pixels.data()));
  cv::Mat bgr;
  cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
  return bgr;
}

cv::Mat grey_of(const cv::Mat& bgr) {
  cv::Mat grey;
  cv::cvtColor(bgr, grey, cv::COLOR_BGR2GRAY);
  return grey;
}

cv::Mat extended(const cv::Mat& picture, int columns) {
  cv::Mat wider;
  cv::copyMakeBorder(picture, wider, 0, 0, columns, 0, cv::BORDER_REPLICATE);
  return wider;
}

void require_pair(const eval::rgb_image& left, const eval::rgb_image& right, int levels) {
  if (left.width != right.width || left.height != right.height) {
    throw std::invalid_argument("the two images differ in size");
  }
  if (levels < 1) throw std::invalid_argument("there is no level to search");
}

}  // namespace

int levels_searched(int levels) { return (levels + 15) / 16 * 16; }

std::string parameters_of(matcher kind) {
  if (kind == matcher::block_matching) {
    return fmt::format("cv::StereoBM, grey, blockSize {0}x{0}, otherwise OpenCV's defaults", block_window);
  }
  return fmt::format(
      "cv::StereoSGBM, colour, MODE_HH (8 paths), blockSize {0}x{0}, P1 {1}, P2 {2}, disp12MaxDiff {3}, preFilterCap "
      "{4}, uniquenessRatio {5}, speckleWindowSize {6}, speckleRange {7}",
      semi_global_window, small_penalty, large_penalty, right_check, prefilter_cap, uniqueness_percent, speckle_pixels,
      speckle_range);
}

eval::real_map match(matcher kind, const eval::rgb_image& left, const eval::rgb_image& right, int levels) {
  require_pair(left, right, levels);
  const int searched = levels_searched(levels);
  cv::Mat left_picture = extended(picture_of(left), searched);
  cv::Mat right_picture = extended(picture_of(right), searched);
  cv::Ptr<cv::StereoMatcher> algorithm;
  if (kind == matcher::block_matching) {
    left_picture = grey_of(left_picture);
    right_picture = grey_of(right_picture);
    algorithm = cv::StereoBM::create(searched, block_window);
  } else {
    algorithm = cv::StereoSGBM::create(0, searched, semi_global_window, small_penalty, large_penalty, right_check,
                                       prefilter_cap, uniqueness_percent, speckle_pixels, speckle_range,
                                       cv::StereoSGBM::MODE_HH);
  }
  cv::Mat found;
  algorithm->compute(left_picture, right_picture, found);
  eval::real_map map{left.width, left.height, {}};
  map.values.reserve(static_cast<std::size_t>(left.width) * left.height);
  for (int y = 0; y < left.height; ++y) {
    for (int x = 0; x < left.width; ++x) {
      const int sixteenths = found.at<std::int16_t>(y, searched + x);
      map.values.push_back(sixteenths < 0 ? std::numeric_limits<double>::quiet_NaN() : sixteenths / fractions);
    }
  }
  return map;
}

eval::real_map match_as_in_regression_test(const regression_case& settings, const eval::rgb_image& left,
                                           const eval::rgb_image& right) {
  require_pair(left, right, settings.levels);
  const cv::Mat left_picture = picture_of(left);
  const cv::Mat right_picture = picture_of(right);
  const int area = settings.window * settings.window;
  cv::Mat found;
  if (settings.kind == matcher::block_matching) {
    cv::StereoBM::create(settings.levels, settings.window)
        ->compute(grey_of(left_picture), grey_of(right_picture), found);
    found.convertTo(found, CV_32F, 1 / fractions);
  } else {
    cv::StereoSGBM::create(0, settings.levels, settings.window, 10 * area, 40 * area, 1, 63, 10, 100, 32, settings.mode)
        ->compute(left_picture, right_picture, found);
    found /= fractions;  // in 16-bit integers: to the nearest whole disparity
    found.convertTo(found, CV_32F);
  }
  eval::real_map map{left.width, left.height, {}};
  for (int y = 0; y < left.height; ++y)
    map.values.insert(map.values.end(), found.ptr<float>(y), found.ptr<float>(y) + left.width);
  return map;
}

}  // namespace epiline::opencv
