#include "scenes/render.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scenes/catalogue.hpp"
#include "scenes/noise.hpp"

namespace epiline::scenes {
namespace {

void check(const scene_parameters& parameters) {
  const auto within = [](const char* name, double value, double low, double high) {
    if (value >= low && value <= high) return;  // not so for NaN
    throw scene_error(fmt::format("{} is {}; it must be {} to {}", name, value, low, high));
  };
  within("width", parameters.width, 1, 4096);
  within("height", parameters.height, 1, 4096);
  within("levels", parameters.levels, 2, 256);
  within("noise", parameters.noise, 0, 64);
  within("gain", parameters.gain, 0.1, 10);
  within("offset", parameters.offset, -255, 255);
  within("misalignment", parameters.misalignment, -16, 16);
}

constexpr camera other(camera by) { return by == camera::left ? camera::right : camera::left; }

/// Whether the point that `by` sees is seen by the other camera too, whose surfaces in this row are `surfaces`.
bool seen_by_both(const std::vector<const surface*>& surfaces, const sighting& point, camera by, int width) {
  const double x = by == camera::left ? point.in_left.x - point.disparity : point.in_left.x;
  // Where a coordinate went through a division, it is whole only within rounding.
  constexpr double rounding = 1e-9;
  if (x < -rounding || x > width - 1 + rounding) return false;
  const sighting nearest = room::nearest(surfaces, other(by), {x, point.in_left.y});
  return nearest.disparity <= point.disparity + rounding;
}

view look(const room& room, camera by, const scene_parameters& parameters) {
  const int width = parameters.width;
  const int height = parameters.height;
  const bool is_right = by == camera::right;
  const double gain = is_right ? parameters.gain : 1;
  const double offset = is_right ? parameters.offset : 0;
  const double too_low = is_right ? parameters.misalignment : 0;

  view result{eval::rgb_image(width, height), {width, height, {}}, {width, height, {}}};
  for (int y = 0; y < height; ++y) {
    const auto surfaces = room.surfaces_of_row(y);
    const auto pictured = room.surfaces_of_row(y - too_low);
    for (int x = 0; x < width; ++x) {
      const auto at = [&](double row) { return position{static_cast<double>(x), row}; };
      const sighting truth = room::nearest(surfaces, by, at(y));
      result.disparity.values.push_back(truth.disparity);
      result.visible.selected.push_back(seen_by_both(surfaces, truth, by, width));

      const sighting shown = room::nearest(pictured, by, at(y - too_low));
      colour value = shown.seen->colour_at(shown.in_left) * gain + offset;
      for (int c = 0; c < 3; ++c) {
        if (parameters.noise != 0) {
          value[c] += parameters.noise * gaussian(parameters.seed, {is_right ? 1 : 0, y, x, c});
        }
        result.image.at(x, y)[c] = static_cast<std::uint8_t>(std::floor(std::clamp(value[c], 0.0, 255.0) + 0.5));
      }
    }
  }
  return result;
}

}  // namespace

stereo_scene render(std::string_view name, const scene_parameters& parameters) {
  check(parameters);
  const room room = build(name, parameters);
  return {look(room, camera::left, parameters), look(room, camera::right, parameters)};
}

std::vector<scene_choice> discriminating_set() {
  return {
      {"mosaic", {.width = 320, .height = 72, .seed = 1}},
      {"mosaic", {.width = 200, .height = 64, .seed = 2, .noise = 6}},
      {"slanted", {.width = 240, .height = 96, .seed = 3, .noise = 1}},
      {"corridor",
       {.width = 200, .height = 80, .seed = 4, .noise = 2, .gain = 1.05, .offset = -3, .misalignment = 0.3}},
      {"steps", {.width = 240, .height = 96, .seed = 5}},
      {"textureless", {.width = 160, .height = 40, .seed = 6}},
      {"repetitive", {.width = 200, .height = 48, .seed = 7}},
      {"random_dot", {.width = 160, .height = 40, .seed = 8}},
      {"mosaic", {.width = 1, .height = 9, .seed = 9}},
      {"mosaic", {.width = 90, .height = 1, .seed = 10}},
      {"mosaic", {.width = 6, .height = 5, .seed = 11}},
  };
}

}  // namespace epiline::scenes
