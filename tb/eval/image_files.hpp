#pragma once
// Image files in and out: stereo inputs, ground truth, masks, disparity maps. Every function throws file_error (see
// output_file.hpp) when a file cannot be read, is cut short, or is not of the kind asked for.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "eval/frame.hpp"
#include "eval/output_file.hpp"

namespace epiline::eval {

/// A real number a pixel in raster order, NaN = unknown or undefined.
struct real_map {
  int width = 0;
  int height = 0;
  std::vector<double> values;
};

/// True = the pixel takes part.
struct pixel_mask {
  int width = 0;
  int height = 0;
  std::vector<bool> selected;
};

/// The map's disparities, NaN where it is undefined.
[[nodiscard]] real_map real_values_of(const disparity_map& map);

/// Any 8-bit picture OpenCV reads; grey is taken as R = G = B, transparency is dropped. 16-bit and floating-point
/// pictures are refused.
[[nodiscard]] rgb_image read_stereo_image(const std::filesystem::path& path);

/// Ground truth: PFM (NaN and infinities = unknown) or a one-channel 8- or 16-bit picture (0 = unknown). The disparity
/// is value / scale; the default scale is 1 for PFM and 8-bit pictures and 256 for 16-bit ones (KITTI's convention).
/// The scale in a PFM's header gives its byte order only.
[[nodiscard]] real_map read_truth(const std::filesystem::path& path, std::optional<double> scale = std::nullopt);

/// A one-channel 8-bit picture; 255 = selected (128 marks occluded pixels in Middlebury's masks). A mask that selects
/// nothing is refused.
[[nodiscard]] pixel_mask read_mask(const std::filesystem::path& path);

/// PFM, one channel ("Pf"), either byte order, plain values: infinities and NaN as they stand in the file. `name` is
/// for messages.
[[nodiscard]] real_map parse_pfm(std::string_view bytes, const std::string& name);

/// Little-endian PFM of a map whose undefined pixels become +infinity.
[[nodiscard]] std::string pfm_of(const disparity_map& map);

/// Little-endian PFM of a map whose unknown pixels become +infinity.
[[nodiscard]] std::string pfm_of(const real_map& map);

/// 8-bit colour PNG.
[[nodiscard]] std::string png_of(const rgb_image& image);

/// 8-bit PNG as read_mask() reads it: 255 = selected, 128 = not.
[[nodiscard]] std::string png_of(const pixel_mask& mask);

/// 16-bit PNG: disparity * 256, 0 = undefined; a defined 0 is stored as 1.
[[nodiscard]] std::string png_of(const disparity_map& map);

/// 8-bit PGM: the disparity, 255 = undefined.
[[nodiscard]] std::string pgm_of(const disparity_map& map);

/// Throws unless the extension is one that encode_map() knows.
void require_map_extension(const std::filesystem::path& path);

/// The bytes of a file of that name: .pfm, .png or .pgm, as above.
[[nodiscard]] std::string encode_map(const disparity_map& map, const std::filesystem::path& path);

/// A colour picture for people, as PNG: blue is far, red is levels - 1 and beyond, undefined pixels are black.
[[nodiscard]] std::string picture_of(const real_map& map, int levels);
[[nodiscard]] std::string picture_of(const disparity_map& map, int levels);

}  // namespace epiline::eval
