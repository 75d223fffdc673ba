#include "report/pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace epiline::report {

const std::array<error_class_look, 5>& error_looks() {
  static constexpr std::array<error_class_look, 5> looks = {{
      {{232, 238, 232}, "right, within 1 pixel"},
      {{245, 166, 35}, "off by 1 to 2 pixels"},
      {{176, 24, 43}, "wrong by more than 2 pixels"},
      {{86, 110, 150}, "no disparity given"},
      {{0, 0, 0}, "truth unknown, not counted"},
  }};
  return looks;
}

error_class class_of(double disparity, double truth) {
  if (!std::isfinite(truth)) return error_class::unknown;
  if (!std::isfinite(disparity)) return error_class::undefined;
  const double error = std::abs(disparity - truth);
  return error <= 1 ? error_class::right : error <= 2 ? error_class::off_by_two : error_class::wrong;
}

std::string data_uri(std::string_view type, std::string_view bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string uri = fmt::format("data:{};base64,", type);
  uri.reserve(uri.size() + bytes.size() * 4 / 3 + 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = group << 8 | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) uri.push_back(k <= count ? digits[group >> (18 - 6 * k) & 63] : '=');
  }
  return uri;
}

std::string hexadecimal(const eval::rgb_colour& colour) {
  return fmt::format("#{:02x}{:02x}{:02x}", colour[0], colour[1], colour[2]);
}

std::string map_uri(const eval::real_map& map, int levels) {
  return data_uri("image/png", eval::picture_of(map, levels));
}

std::string error_uri(const eval::real_map& map, const eval::ground_truth& truth) {
  if (map.width != truth.disparity.width || map.height != truth.disparity.height) {
    throw std::invalid_argument("the map and the truth differ in size");
  }
  eval::indexed_picture picture{map.width, map.height, {}, {}};
  for (const auto& look : error_looks()) picture.colours.push_back(look.colour);
  for (std::size_t i = 0; i < map.values.size(); ++i) {
    const bool counts = !truth.evaluated || truth.evaluated->selected[i];
    picture.pixels.push_back(
        static_cast<std::uint8_t>(counts ? class_of(map.values[i], truth.disparity.values[i]) : error_class::unknown));
  }
  return data_uri("image/png", eval::png_of(picture));
}

std::string photograph_uri(const eval::rgb_image& image) {
  const cv::Mat rgb(image.height, image.width, CV_8UC3, const_cast<std::uint8_t*>(image.pixels.data()));
  cv::Mat bgr;
  cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
  std::vector<unsigned char> bytes;
  cv::imencode(".jpg", bgr, bytes, {cv::IMWRITE_JPEG_QUALITY, 88});
  return data_uri("image/jpeg", {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

}  // namespace epiline::report
