#pragma once
// Synthetic stereo pairs with exact ground truth. A scene is a set of flat surfaces; what a pixel sees is computed at
// its centre, without approximation, and so are its disparity and whether the other camera sees the same point.
//
//   const auto pair = epiline::scenes::render("corridor", {.width = 640, .height = 480, .levels = 80});
//   pair.left.image, pair.left.disparity, pair.left.visible; likewise pair.right
//
// The same name and parameters give the same bytes on every machine.

#include <cstdint>
#include <span>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "eval/frame.hpp"
#include "eval/image_files.hpp"

namespace epiline::scenes {

struct scene_parameters {
  int width = 640;          // columns, 1 .. 4096
  int height = 480;         // rows, 1 .. 4096
  int levels = 80;          // disparities are 0 .. levels - 1; 2 .. 256
  std::uint64_t seed = 1;   // of textures, arrangement and noise
  double noise = 0;         // deviation of the noise in grey levels, 0 .. 64: its own in each image and colour
  double gain = 1;          // of the right image, 0.1 .. 10: value * gain + offset + noise
  double offset = 0;        // grey levels added to the right image, -255 .. 255
  double misalignment = 0;  // rows by which the right image's contents lie too low, -16 .. 16; may be a fraction
};

/// One camera's picture and what is true of it.
struct view {
  eval::rgb_image image;
  /// Pixels to the left in the right image at which a left pixel's point lies, and to the right in the left image a
  /// right pixel's: 0 <= disparity <= levels - 1, known everywhere. It is that of the aligned cameras, whatever
  /// `misalignment`.
  eval::real_map disparity;
  /// Pixels whose point the other camera sees too: neither hidden by something nearer nor outside the other image.
  eval::pixel_mask visible;
};

struct stereo_scene {
  view left;
  view right;
};

struct scene_description {
  std::string_view name;
  std::string_view meaning;
  bool whole_disparities;  // every disparity is an integer: the images shift by whole pixels
};

/// A scene's name is unknown or a parameter is out of range; what() says which and what is allowed.
class scene_error : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

[[nodiscard]] std::span<const scene_description> all_scenes();

/// Throws scene_error.
[[nodiscard]] stereo_scene render(std::string_view name, const scene_parameters& parameters);

/// A scene with its parameters.
struct scene_choice {
  std::string_view name;
  scene_parameters parameters;
};

/// Small scenes, 80 levels, in which together every level wins somewhere, and every border, tie and rule of the
/// methods' filters has something to decide (tests/scenes counts them). A matcher that agrees with its reference on all
/// of them is hardly wrong in a rule.
[[nodiscard]] std::vector<scene_choice> discriminating_set();

}  // namespace epiline::scenes
