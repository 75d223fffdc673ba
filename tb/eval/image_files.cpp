#include "eval/image_files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <system_error>

#include "eval/indexed_png.hpp"

namespace epiline::eval {
namespace {

namespace fs = std::filesystem;

std::string read_bytes(const fs::path& path) {
  if (fs::is_directory(path)) {
    throw file_error(fmt::format("cannot read {}: it is a directory; name an image file", path.string()));
  }
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    throw file_error(fmt::format("cannot open {}: {}; check the path", path.string(),
                                 std::generic_category().message(errno == 0 ? EIO : errno)));
  }
  std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (file.bad()) throw file_error(fmt::format("cannot read {}: input/output error", path.string()));
  if (bytes.empty()) throw file_error(fmt::format("{} is empty; it should be an image", path.string()));
  return bytes;
}

/// Silences the standard error stream: the picture libraries print to it what is about to become one clear message.
class quiet_errors {
 public:
  quiet_errors() : saved_(::dup(STDERR_FILENO)) {
    const int nowhere = ::open("/dev/null", O_WRONLY);
    if (nowhere >= 0) {
      ::dup2(nowhere, STDERR_FILENO);
      ::close(nowhere);
    }
  }
  quiet_errors(const quiet_errors&) = delete;
  quiet_errors& operator=(const quiet_errors&) = delete;
  ~quiet_errors() {
    if (saved_ >= 0) {
      ::dup2(saved_, STDERR_FILENO);
      ::close(saved_);
    }
  }

 private:
  int saved_;
};

/// JPEG decoders fill what is missing with grey and call it a warning; so look for the end marker ourselves. Walks the
/// segments, as thumbnails inside them have end markers of their own.
bool is_cut_short_jpeg(std::string_view bytes) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(bytes[i]); };
  if (bytes.size() < 2 || byte(0) != 0xff || byte(1) != 0xd8) return false;
  std::size_t at = 2;
  while (at + 1 < bytes.size()) {
    if (byte(at) != 0xff || byte(at + 1) == 0xff) {
      ++at;  // entropy-coded data, or padding before a marker
      continue;
    }
    const unsigned marker = byte(at + 1);
    at += 2;
    if (marker == 0xd9) return false;
    const bool alone = marker == 0x00 || marker == 0x01 || (marker >= 0xd0 && marker <= 0xd8);
    if (alone) continue;
    if (at + 1 >= bytes.size()) break;
    at += (byte(at) << 8) | byte(at + 1);
  }
  return true;
}

cv::Mat decode(const std::string& bytes, int flags, const fs::path& path) {
  cv::Mat picture;
  if (!is_cut_short_jpeg(bytes)) {
    const quiet_errors quiet;
    try {
      const cv::Mat raw(1, static_cast<int>(bytes.size()), CV_8UC1, const_cast<char*>(bytes.data()));
      picture = cv::imdecode(raw, flags);
    } catch (const cv::Exception&) {
      picture.release();
    }
  }
  if (picture.empty()) {
    throw file_error(
        fmt::format("cannot read {}: it is not a picture of a known format, or it is damaged or cut short; "
                    "fetch it again or convert it to PNG",
                    path.string()));
  }
  return picture;
}

cv::Mat decode_one_channel(const std::string& bytes, const fs::path& path, std::string_view kind) {
  cv::Mat picture = decode(bytes, cv::IMREAD_UNCHANGED, path);
  if (picture.channels() == 1) return picture;
  // A grey picture saved in colour is common; anything else is somebody's visualisation, not data.
  std::vector<cv::Mat> channels;
  cv::split(picture, channels);
  const auto differ = [&](int c) {
    return cv::countNonZero(channels[0] != channels[static_cast<std::size_t>(c)]) != 0;
  };
  if (channels.size() < 3 || differ(1) || differ(2)) {
    throw file_error(fmt::format("{} is in colour, but {} must be a grey picture", path.string(), kind));
  }
  return channels[0];
}

std::string_view next_word(std::string_view bytes, std::size_t& at) {
  constexpr std::string_view blank = " \t\r\n";
  const std::size_t begin = std::min(bytes.find_first_not_of(blank, at), bytes.size());
  at = std::min(bytes.find_first_of(blank, begin), bytes.size());
  return bytes.substr(begin, at - begin);
}

template <class Number>
std::optional<Number> number_in(std::string_view word) {
  Number value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return value;
}

/// Files in a fixed byte order, whatever the machine's.
template <std::endian Order>
void append_float(std::string& bytes, float value) {
  auto bits = std::bit_cast<std::uint32_t>(value);
  for (int i = 0; i < 4; ++i) {
    bytes.push_back(static_cast<char>(bits >> (Order == std::endian::little ? 8 * i : 24 - 8 * i) & 0xff));
  }
}

float float_at(std::string_view bytes, std::size_t at, bool little) {
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    bits |= std::uint32_t{static_cast<unsigned char>(bytes[at + i])} << (little ? 8 * i : 24 - 8 * i);
  }
  return std::bit_cast<float>(bits);
}

std::string encode_png(const cv::Mat& picture) {
  std::vector<unsigned char> bytes;
  if (!cv::imencode(".png", picture, bytes)) throw file_error("cannot encode a PNG picture of this size");
  return {bytes.begin(), bytes.end()};
}

std::string extension_of(const fs::path& path) {
  std::string extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return extension;
}

bool is_pfm(std::string_view bytes) { return bytes.starts_with("Pf") || bytes.starts_with("PF"); }

}  // namespace

rgb_image read_stereo_image(const fs::path& path) {
  const std::string bytes = read_bytes(path);
  if (is_pfm(bytes)) {
    throw file_error(
        fmt::format("{} is a floating-point picture, but stereo inputs must have 8 bits a colour", path.string()));
  }
  const cv::Mat picture = decode(bytes, cv::IMREAD_COLOR | cv::IMREAD_ANYDEPTH, path);
  if (picture.depth() != CV_8U) {
    throw file_error(fmt::format("{} has {} bits a colour, but stereo inputs must have 8: convert it first",
                                 path.string(), 8 * picture.elemSize1()));
  }
  cv::Mat rgb;
  cv::cvtColor(picture, rgb, cv::COLOR_BGR2RGB);
  rgb_image image(rgb.cols, rgb.rows);
  for (int y = 0; y < rgb.rows; ++y) std::copy_n(rgb.ptr(y), 3 * rgb.cols, image.at(0, y));
  return image;
}

real_map read_truth(const fs::path& path, std::optional<double> scale) {
  if (scale && !(*scale > 0 && std::isfinite(*scale))) {
    throw file_error(fmt::format("the truth scale {} of {} is not above 0", *scale, path.string()));
  }
  const std::string bytes = read_bytes(path);
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  if (is_pfm(bytes)) {
    real_map truth = parse_pfm(bytes, path.string());
    for (double& value : truth.values) value = std::isfinite(value) ? value / scale.value_or(1) : unknown;
    return truth;
  }
  const cv::Mat picture = decode_one_channel(bytes, path, "ground truth");
  if (picture.depth() != CV_8U && picture.depth() != CV_16U) {
    throw file_error(
        fmt::format("{} is neither PFM nor an 8- or 16-bit picture, as ground truth must be", path.string()));
  }
  const double divisor = scale.value_or(picture.depth() == CV_16U ? 256 : 1);
  real_map truth{picture.cols, picture.rows, {}};
  truth.values.reserve(picture.total());
  for (int y = 0; y < picture.rows; ++y) {
    for (int x = 0; x < picture.cols; ++x) {
      const int value = picture.depth() == CV_8U ? picture.at<std::uint8_t>(y, x) : picture.at<std::uint16_t>(y, x);
      truth.values.push_back(value == 0 ? unknown : value / divisor);
    }
  }
  return truth;
}

pixel_mask read_mask(const fs::path& path) {
  const cv::Mat picture = decode_one_channel(read_bytes(path), path, "a mask");
  if (picture.depth() != CV_8U) throw file_error(fmt::format("mask {} is not an 8-bit picture", path.string()));
  pixel_mask mask{picture.cols, picture.rows, {}};
  mask.selected.reserve(picture.total());
  for (int y = 0; y < picture.rows; ++y) {
    for (int x = 0; x < picture.cols; ++x) mask.selected.push_back(picture.at<std::uint8_t>(y, x) == 255);
  }
  if (std::ranges::find(mask.selected, true) == mask.selected.end()) {
    throw file_error(fmt::format("mask {} selects no pixel: pixels that take part must be 255", path.string()));
  }
  return mask;
}

real_map parse_pfm(std::string_view bytes, const std::string& name) {
  const auto fail = [&](std::string_view reason) {
    throw file_error(fmt::format("{} is not a usable PFM file: {}", name, reason));
  };
  std::size_t at = 0;
  const auto magic = next_word(bytes, at);
  if (magic == "PF") fail("it is in colour; a disparity map has one channel (Pf)");
  if (magic != "Pf") fail("it does not start with Pf");
  const auto width = number_in<int>(next_word(bytes, at));
  const auto height = number_in<int>(next_word(bytes, at));
  const auto order = number_in<double>(next_word(bytes, at));
  if (!width || !height || *width < 1 || *height < 1) fail("its header has no valid width and height");
  if (!order || *order == 0 || !std::isfinite(*order)) fail("its header has no valid scale");
  if (at >= bytes.size()) fail("it is cut short after the header");
  const std::string_view data = bytes.substr(at + 1);  // exactly one white space ends the header
  const std::size_t columns = static_cast<std::size_t>(*width);
  const std::size_t rows = static_cast<std::size_t>(*height);
  if (data.size() / 4 / columns < rows) {
    fail(fmt::format("it is cut short: {}x{} pixels need {} bytes after the header, it has {}", columns, rows,
                     4 * columns * rows, data.size()));
  }
  real_map map{*width, *height, std::vector<double>(columns * rows)};
  for (std::size_t y = 0; y < rows; ++y) {
    const std::size_t stored_row = rows - 1 - y;  // the file starts with the bottom row
    for (std::size_t x = 0; x < columns; ++x) {
      map.values[y * columns + x] = float_at(data, 4 * (stored_row * columns + x), *order < 0);
    }
  }
  return map;
}

std::string pfm_of(const real_map& map) {
  std::string bytes = fmt::format("Pf\n{} {}\n-1.0\n", map.width, map.height);
  bytes.reserve(bytes.size() + 4 * map.values.size());
  for (int y = map.height - 1; y >= 0; --y) {
    for (int x = 0; x < map.width; ++x) {
      const double value = map.values[static_cast<std::size_t>(y) * map.width + x];
      append_float<std::endian::little>(
          bytes, std::isnan(value) ? std::numeric_limits<float>::infinity() : static_cast<float>(value));
    }
  }
  return bytes;
}

std::string pfm_of(const disparity_map& map) { return pfm_of(real_values_of(map)); }

std::string png_of(const rgb_image& image) {
  cv::Mat picture(image.height, image.width, CV_8UC3);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const std::uint8_t* rgb = image.at(x, y);
      picture.at<cv::Vec3b>(y, x) = {rgb[2], rgb[1], rgb[0]};
    }
  }
  return encode_png(picture);
}

std::string png_of(const pixel_mask& mask) {
  cv::Mat picture(mask.height, mask.width, CV_8UC1);
  for (int y = 0; y < mask.height; ++y) {
    for (int x = 0; x < mask.width; ++x) {
      picture.at<std::uint8_t>(y, x) = mask.selected[static_cast<std::size_t>(y) * mask.width + x] ? 255 : 128;
    }
  }
  return encode_png(picture);
}

std::string png_of(const disparity_map& map) {
  cv::Mat picture(map.height, map.width, CV_16UC1);
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const std::size_t i = map.index(x, y);
      const int stored = map.defined[i] == 0 ? 0 : std::max(256 * map.disparity[i], 1);
      picture.at<std::uint16_t>(y, x) = static_cast<std::uint16_t>(stored);
    }
  }
  return encode_png(picture);
}

std::string pgm_of(const disparity_map& map) {
  std::string bytes = fmt::format("P5\n{} {}\n255\n", map.width, map.height);
  for (std::size_t i = 0; i < map.disparity.size(); ++i) {
    bytes.push_back(static_cast<char>(map.defined[i] != 0 ? map.disparity[i] : 255));
  }
  return bytes;
}

void require_map_extension(const fs::path& path) {
  const std::string extension = extension_of(path);
  if (extension != ".pfm" && extension != ".png" && extension != ".pgm") {
    throw file_error(fmt::format("cannot write {}: a disparity map's name ends in .pfm, .png (16 bit) or .pgm (8 bit)",
                                 path.string()));
  }
}

std::string encode_map(const disparity_map& map, const fs::path& path) {
  require_map_extension(path);
  const std::string extension = extension_of(path);
  if (extension == ".pfm") return pfm_of(map);
  return extension == ".png" ? png_of(map) : pgm_of(map);
}

real_map real_values_of(const disparity_map& map) {
  real_map values{map.width, map.height, std::vector<double>(map.disparity.begin(), map.disparity.end())};
  for (std::size_t i = 0; i < map.defined.size(); ++i) {
    if (map.defined[i] == 0) values.values[i] = std::numeric_limits<double>::quiet_NaN();
  }
  return values;
}

std::string picture_of(const real_map& map, int levels) {
  // 255 colours of the map, and black: a palette makes the file a third of what three bytes a pixel take.
  constexpr std::uint8_t undefined = 255;
  const double highest = std::max(levels - 1, 1);
  indexed_picture picture{map.width, map.height, disparity_colours(undefined), {}};
  picture.colours.push_back({0, 0, 0});
  picture.pixels.reserve(map.values.size());
  for (const double value : map.values) {
    picture.pixels.push_back(std::isfinite(value) ? static_cast<std::uint8_t>(std::lround(
                                                        (undefined - 1) * std::clamp(value / highest, 0.0, 1.0)))
                                                  : undefined);
  }
  return png_of(picture);
}

std::string picture_of(const disparity_map& map, int levels) { return picture_of(real_values_of(map), levels); }

}  // namespace epiline::eval
