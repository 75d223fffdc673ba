#pragma once
// What is where: flat surfaces in front of two cameras, and which of them a camera sees.

#include <limits>
#include <optional>
#include <vector>

#include "scenes/texture.hpp"

namespace epiline::scenes {

enum class camera { left, right };

/// Position in pixels; the centre of the upper left pixel is (0, 0).
struct position {
  double x;
  double y;
};

/// A flat surface. In the image of a camera the inverse depth of a plane, and with it its disparity, is linear in x and
/// y. A point that the left camera sees at (x, y) lies at (x - disparity, y) in the right image.
struct surface {
  double disparity_at_origin = 0;  // of left pixel (0, 0), in pixels
  double per_column = 0;           // change of disparity a column of the left image, below 1
  double per_row = 0;              // a row
  // The part of the plane that is there, in left positions: left <= x < right and top <= y < bottom.
  double left = -std::numeric_limits<double>::infinity();
  double right = std::numeric_limits<double>::infinity();
  double top = -std::numeric_limits<double>::infinity();
  double bottom = std::numeric_limits<double>::infinity();
  texture colours;
  /// Where the texture lies: flat on the left image (a unit is a pixel), or in the world, along the floor and ceiling
  /// or along the side walls of a room (a unit is a pixel at disparity `unit_disparity`).
  enum class mapping { image, frontal, along_floor, along_wall };
  mapping laid = mapping::image;
  position centre{0, 0};      // of the left image: what the camera points at
  double unit_disparity = 1;  // of mappings other than `image`
  double focal_length = 1;    // pixels; likewise

  [[nodiscard]] double disparity(position in_left) const {
    return disparity_at_origin + per_column * in_left.x + per_row * in_left.y;
  }

  /// The left position of the point of the plane that `by` sees at `seen`.
  [[nodiscard]] position left_position(camera by, position seen) const {
    if (by == camera::left) return seen;
    // x = seen.x + disparity(x, y), solved for x
    return {(seen.x + disparity_at_origin + per_row * seen.y) / (1 - per_column), seen.y};
  }

  [[nodiscard]] bool covers(position in_left) const {
    return left <= in_left.x && in_left.x < right && top <= in_left.y && in_left.y < bottom;
  }

  [[nodiscard]] colour colour_at(position in_left) const;
};

/// The point of a surface that a camera sees.
struct sighting {
  const surface* seen;
  position in_left;
  double disparity;
};

/// Surfaces of which a camera sees the nearest in every direction. Where two are equally near, the first.
class room {
 public:
  explicit room(std::vector<surface> surfaces) : surfaces_(std::move(surfaces)) {}

  /// The surfaces that cross the row. Look there for everything seen in that row.
  [[nodiscard]] std::vector<const surface*> surfaces_of_row(double y) const;

  /// What the camera sees at `at`, of `surfaces`. There is always something: every room has a background.
  [[nodiscard]] static sighting nearest(const std::vector<const surface*>& surfaces, camera by, position at);

 private:
  std::vector<surface> surfaces_;
};

}  // namespace epiline::scenes
