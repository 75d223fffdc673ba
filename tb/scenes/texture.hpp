#pragma once
// The colour of a surface at continuous positions.

#include <Eigen/Core>
#include <cstdint>

namespace epiline::scenes {

/// Red, green, blue in grey levels; 0 .. 255 are what a picture can hold.
using colour = Eigen::Array3d;

struct texture {
  enum class kind {
    plain,     // `base` everywhere
    waves,     // smooth noise of several wavelengths, each half the one before
    dots,      // squares of one unit, black or white
    specks,    // `base`, with a lighter or darker square of one unit here and there
    repeated,  // `waves` of a strip `period` units wide, again and again along u
  };
  kind form = kind::plain;
  std::uint64_t seed = 0;
  colour base{128, 128, 128};
  double contrast = 40;      // grey levels a wavelength adds or subtracts at most
  double longest_wave = 32;  // units
  int waves = 4;
  int period = 0;  // units

  /// Colour at (u, v). Waves shorter than two pixels cannot be shown and fade out: `pixels_per_unit` > 0 says how large
  /// a unit is here.
  [[nodiscard]] colour at(double u, double v, double pixels_per_unit) const;
};

}  // namespace epiline::scenes
