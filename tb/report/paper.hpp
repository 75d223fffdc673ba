#pragma once
// What C. Georgoulas and I. Andreadis, "Real-Time Stereo Vision Techniques", print, and what is computed to stand
// beside it. Nothing here is a measurement of ours.

#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace epiline::report {

/// A cell of the paper's table of accuracy and coverage, per cent.
struct printed_accuracy {
  int accuracy;
  std::optional<int> coverage;  // none: the paper prints a dash
};

/// A column of the table: a scene of the lists of pairs.
struct printed_scene {
  std::string_view scene;
  std::string_view title;
};

/// A method of ours that stands beside a row of the paper.
struct counterpart {
  std::string_view method;  // its id
  std::string_view title;   // how its figures are called there
};

/// A row of the table.
struct printed_row {
  std::string_view title;
  std::vector<counterpart> ours;
  std::vector<std::optional<printed_accuracy>> cells;  // a scene each
};

[[nodiscard]] std::span<const printed_scene> printed_scenes();
[[nodiscard]] std::span<const printed_row> printed_rows();

struct frame_size {
  int width;
  int height;
};

/// Sizes of the paper's table of frame rates.
[[nodiscard]] std::span<const frame_size> printed_sizes();

/// frames/s = factor * pixels^exponent.
struct power_law {
  double factor;
  double exponent;
};

/// Milliseconds a pair that the paper prints.
struct printed_time {
  std::string_view title;
  frame_size size;
  double milliseconds;
};

/// What the paper prints about the speed of one of its methods.
struct printed_speed {
  std::string_view title;
  std::string_view design;     // ours that it stands beside
  std::vector<double> frames;  // a second, a size each
  power_law line;              // the paper's own, over the square of a square image's width
  std::string_view resources;  // logic and clock
  std::vector<printed_time> times;
};
[[nodiscard]] std::span<const printed_speed> printed_speeds();

/// The power law nearest to the points (least squares of logarithms). Throws std::invalid_argument for fewer than two
/// points, two of one size only, or values that are not positive.
struct rate_point {
  double pixels;
  double frames;
};
[[nodiscard]] power_law fitted_power_law(std::span<const rate_point> points);

/// The largest error that truncation to `bits` fractional bits, floor(mu * 2^bits) / 2^bits, makes in the Gaussian
/// membership function exp(-x^2 / (2 sigma^2)), sigma = 18.75, at x = 0 .. 127.
[[nodiscard]] double membership_error(int bits);

/// The same as the paper prints it, for 4 to 8 bits.
struct printed_membership_error {
  int bits;
  double error;
};
[[nodiscard]] std::span<const printed_membership_error> printed_membership_errors();

}  // namespace epiline::report
