#include "eval/indexed_png.hpp"

#include <zlib.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string_view>

namespace epiline::eval {
namespace {

void append_word(std::string& bytes, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<char>(value >> shift & 0xff));
}

/// A chunk of a PNG file: length, type, data, and the check sum of the last two.
void append_chunk(std::string& bytes, std::string_view type, std::string_view data) {
  append_word(bytes, static_cast<std::uint32_t>(data.size()));
  std::string checked{type};
  checked += data;
  bytes += checked;
  append_word(bytes, static_cast<std::uint32_t>(::crc32(0, reinterpret_cast<const Bytef*>(checked.data()),
                                                        static_cast<uInt>(checked.size()))));
}

std::string compressed(const std::string& data) {
  uLongf size = ::compressBound(data.size());
  std::string packed(size, '\0');
  if (::compress2(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(data.data()),
                  data.size(), 9) != Z_OK) {
    throw std::runtime_error("zlib cannot compress a picture");
  }
  packed.resize(size);
  return packed;
}

}  // namespace

std::vector<rgb_colour> disparity_colours(int count) {
  cv::Mat greys(1, count, CV_8UC1);
  for (int i = 0; i < count; ++i) greys.at<std::uint8_t>(0, i) = static_cast<std::uint8_t>(255 * i / (count - 1));
  cv::Mat colours;
  cv::applyColorMap(greys, colours, cv::COLORMAP_TURBO);
  std::vector<rgb_colour> found;
  for (int i = 0; i < count; ++i) {
    const auto& blue_green_red = colours.at<cv::Vec3b>(0, i);
    found.push_back({blue_green_red[2], blue_green_red[1], blue_green_red[0]});
  }
  return found;
}

std::string png_of(const indexed_picture& picture) {
  const std::size_t pixels = static_cast<std::size_t>(std::max(picture.width, 0)) * std::max(picture.height, 0);
  if (pixels == 0 || picture.pixels.size() != pixels) throw std::invalid_argument("the picture has no pixels");
  if (picture.colours.empty() || picture.colours.size() > 256) {
    throw std::invalid_argument("a palette has 1 to 256 colours");
  }
  if (std::ranges::max(picture.pixels) >= picture.colours.size()) {
    throw std::invalid_argument("a pixel has no colour");
  }
  std::string header;
  append_word(header, static_cast<std::uint32_t>(picture.width));
  append_word(header, static_cast<std::uint32_t>(picture.height));
  header += std::string{"\x08\x03\x00\x00\x00", 5};  // 8 bits an index, palette, and the only methods there are
  std::string palette;
  for (const auto& colour : picture.colours) palette.append(colour.begin(), colour.end());
  std::string rows;
  rows.reserve(pixels + static_cast<std::size_t>(picture.height));
  for (int y = 0; y < picture.height; ++y) {
    const auto begin = picture.pixels.begin() + std::ptrdiff_t{y} * picture.width;
    rows.push_back('\0');  // no filter: differences of indices mean nothing
    rows.append(begin, begin + picture.width);
  }
  std::string bytes = "\x89PNG\r\n\x1a\n";
  append_chunk(bytes, "IHDR", header);
  append_chunk(bytes, "PLTE", palette);
  append_chunk(bytes, "IDAT", compressed(rows));
  append_chunk(bytes, "IEND", "");
  return bytes;
}

}  // namespace epiline::eval
