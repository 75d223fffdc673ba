#include "scenes/catalogue.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "eval/designs.hpp"
#include "scenes/noise.hpp"

namespace epiline::scenes {
namespace {

/// What builders share: sizes as shares of the frame and of the disparities, and textures that differ from one another.
class builder {
 public:
  explicit builder(const scene_parameters& parameters) : parameters_(parameters) {}

  [[nodiscard]] const scene_parameters& parameters() const { return parameters_; }
  /// The disparity at `share` of the range, whole.
  [[nodiscard]] double level(double share) const { return std::round(share * (parameters_.levels - 1)); }
  /// Borders of surfaces lie between pixels, so that no pixel's centre is on one.
  [[nodiscard]] double column(double share) const { return std::floor(share * parameters_.width) - 0.5; }
  [[nodiscard]] double row(double share) const { return std::floor(share * parameters_.height) - 0.5; }
  [[nodiscard]] std::uint64_t random(std::initializer_list<std::int64_t> counters) const {
    return hash(parameters_.seed, counters);
  }

  [[nodiscard]] texture some_texture(double longest_wave = 32, int waves = 4) {
    const std::uint64_t seed = random({++textures_});
    const auto part = [&](int k) { return 96 + 64 * uniform(hash(seed, {k})); };
    return {.form = texture::kind::waves,
            .seed = seed,
            .base = {part(0), part(1), part(2)},
            .longest_wave = longest_wave,
            .waves = waves};
  }

  /// Background at a constant disparity.
  [[nodiscard]] surface backdrop(double disparity) {
    return {.disparity_at_origin = disparity, .colours = some_texture()};
  }

  [[nodiscard]] surface rectangle(double disparity, double left, double right, double top, double bottom) {
    surface result = backdrop(disparity);
    result.left = left;
    result.right = right;
    result.top = top;
    result.bottom = bottom;
    return result;
  }

 private:
  scene_parameters parameters_;
  std::int64_t textures_ = 0;
};

/// A plane by its disparities at the upper left pixel, in the first row as far right as a camera sees (the right camera
/// sees up to `nearest` columns more of it than the left one), and at the lower left pixel.
surface slanted_through(surface shape, double upper_left, double upper_right, double lower_left,
                        const scene_parameters& parameters) {
  const double nearest = parameters.levels - 1;
  // In narrow images it would be steeper than anyone could look at.
  shape.per_column = std::clamp((upper_right - upper_left) / (parameters.width - 1 + nearest), -0.5, 0.5);
  shape.per_row = (lower_left - upper_left) / std::max(parameters.height - 1, 1);
  shape.disparity_at_origin = upper_left;
  return shape;
}

/// Floor, ceiling, two side walls and an end wall, seen along the middle. The nearest points are at the image's margin.
room corridor(builder& build) {
  const auto& size = build.parameters();
  const position centre{(size.width - 1) / 2.0, (size.height - 1) / 2.0};
  const double nearest = size.levels - 1;
  const double end_wall = nearest / 8;
  const auto wall = [&](double per_column, double per_row, double at_centre, surface::mapping laid) {
    surface result{.disparity_at_origin = at_centre - per_column * centre.x - per_row * centre.y,
                   .per_column = per_column,
                   .per_row = per_row,
                   .colours = build.some_texture(256, 6),
                   .laid = laid,
                   .centre = centre,
                   .unit_disparity = nearest,
                   .focal_length = static_cast<double>(std::max(size.width, size.height))};
    return result;
  };
  // The right camera sees more of the right wall, where it is nearer still: there it reaches `nearest`.
  const double sideways = nearest / (std::max(centre.x, nearest) + nearest);
  const double downwards = nearest / std::max(centre.y, 1.0);
  return room({wall(0, 0, end_wall, surface::mapping::frontal), wall(0, downwards, 0, surface::mapping::along_floor),
               wall(0, -downwards, 0, surface::mapping::along_floor),
               wall(sideways, 0, 0, surface::mapping::along_wall),
               wall(-sideways, 0, 0, surface::mapping::along_wall)});
}

/// A ground that rises towards the viewer and three slanted boards that cross it and one another.
room slanted(builder& build) {
  const auto& size = build.parameters();
  const double nearest = size.levels - 1;
  const auto board = [&](double left, double right, double top, double bottom) {
    return build.rectangle(0, build.column(left), build.column(right), build.row(top), build.row(bottom));
  };
  return room({slanted_through(build.backdrop(0), 0, 0.1 * nearest, 0.6 * nearest, size),
               slanted_through(board(0.05, 0.5, 0.1, 0.6), 0.2 * nearest, 0.9 * nearest, 0.25 * nearest, size),
               slanted_through(board(0.45, 0.9, 0.05, 0.5), 0.7 * nearest, 0.3 * nearest, 0.9 * nearest, size),
               slanted_through(board(0.3, 0.95, 0.65, 0.95), 0.8 * nearest, 0.3 * nearest, nearest, size)});
}

/// Stairs of whole disparities, and bars 1 to 9 pixels thin, upright above and lying below.
room steps(builder& build) {
  const auto& size = build.parameters();
  std::vector<surface> surfaces{build.backdrop(build.level(0.05))};
  constexpr int stairs = 8;
  for (int k = 0; k < stairs; ++k) {
    surfaces.push_back(build.rectangle(build.level(0.1 + 0.6 * k / (stairs - 1)), build.column(0.1 * (k + 1)),
                                       build.column(0.1 * (k + 2)), build.row(0.35), build.row(0.65)));
  }
  double x = build.column(0.15);
  double y = build.row(0.7);
  for (const int thickness : {1, 2, 3, 5, 7, 9}) {
    surfaces.push_back(build.rectangle(build.level(0.5), x, x + thickness, build.row(0.05), build.row(0.3)));
    surfaces.push_back(build.rectangle(build.level(0.7), build.column(0.35), build.column(0.9), y, y + thickness));
    x += std::max(std::floor(size.width / 7.0), thickness + 2.0);
    y += thickness + std::max(std::floor(size.height / 40.0), 2.0);
  }
  return room(std::move(surfaces));
}

/// A wall of one colour in a textured frame.
room textureless(builder& build) {
  surface wall =
      build.rectangle(build.level(0.4), build.column(0.2), build.column(0.85), build.row(0.2), build.row(0.8));
  wall.colours.form = texture::kind::plain;
  return room({build.backdrop(build.level(0.15)), wall});
}

/// A wall with a pattern that comes again within the range of disparities, in a textured frame.
room repetitive(builder& build) {
  surface wall =
      build.rectangle(build.level(0.4), build.column(0.15), build.column(0.9), build.row(0.15), build.row(0.85));
  wall.colours.form = texture::kind::repeated;
  wall.colours.period = std::max(build.parameters().levels / 5, 2);
  wall.colours.longest_wave = wall.colours.period / 2.0;
  wall.colours.waves = 3;
  return room({build.backdrop(build.level(0.15)), wall});
}

/// Random dots: nothing to be seen in either image alone, a square in front of a background in both.
room random_dot(builder& build) {
  surface background = build.backdrop(build.level(0.2));
  surface square =
      build.rectangle(build.level(0.5), build.column(0.3), build.column(0.8), build.row(0.25), build.row(0.75));
  for (surface* each : {&background, &square}) each->colours.form = texture::kind::dots;
  return room({background, square});
}

/// Tiles of 2 to 17 pixels at whole disparities close to one another, from the farthest on the left to the nearest on
/// the right; one in six has no texture, one in twelve only specks. Nothing to look at, but full of decisions.
room mosaic(builder& build) {
  const auto& size = build.parameters();
  std::vector<surface> surfaces{build.backdrop(0)};
  std::int64_t tile = 1000;
  for (double y = -0.5; y < size.height;) {
    const int tall = between(build.random({++tile}), 2, 17);
    for (double x = -0.5; x < size.width;) {
      const int wide = between(build.random({++tile}), 2, 17);
      // Up to five levels apart, so that neighbours are the same, near and far.
      const double around = x / size.width * (size.levels + 3) - 2;
      const double disparity =
          std::clamp(std::round(around) + between(build.random({++tile}), -3, 3), 0.0, size.levels - 1.0);
      surface piece = build.rectangle(disparity, x, x + wide, y, y + tall);
      piece.colours.longest_wave = 4;
      piece.colours.waves = 2;
      const int kind = between(build.random({++tile}), 0, 11);
      if (kind < 2) piece.colours.form = texture::kind::plain;
      if (kind == 2) piece.colours.form = texture::kind::specks;
      surfaces.push_back(piece);
      x += wide;
    }
    y += tall;
  }
  return room(std::move(surfaces));
}

struct entry {
  scene_description description;
  room (*make)(builder&);
};

constexpr entry catalogue[] = {
    {{"corridor", "floor, ceiling, side walls and end wall of a corridor, in perspective", false}, corridor},
    {{"slanted", "slanted boards that cross a rising ground and one another", false}, slanted},
    {{"steps", "stairs of whole disparities, bars 1 to 9 pixels thin", true}, steps},
    {{"textureless", "a wall of one colour in a textured frame", true}, textureless},
    {{"repetitive", "a wall whose pattern comes again within the range of disparities", true}, repetitive},
    {{"random_dot", "random dots, a square in front of a background", true}, random_dot},
    {{"mosaic", "tiles of 2 to 17 pixels at disparities close to one another, some without texture", true}, mosaic},
};

}  // namespace

std::span<const scene_description> all_scenes() {
  static const auto descriptions = [] {
    std::vector<scene_description> result;
    for (const entry& each : catalogue) result.push_back(each.description);
    return result;
  }();
  return descriptions;
}

room build(std::string_view name, const scene_parameters& parameters) {
  builder builder(parameters);
  std::vector<std::string_view> known;
  for (const entry& each : catalogue) {
    if (each.description.name == name) return each.make(builder);
    known.push_back(each.description.name);
  }
  const auto closest = eval::closest_name(name, known);
  throw scene_error(fmt::format("unknown scene '{}'{}; scenes: {}", name,
                                closest.empty() ? "" : fmt::format(" (did you mean {}?)", closest),
                                fmt::join(known, ", ")));
}

}  // namespace epiline::scenes
