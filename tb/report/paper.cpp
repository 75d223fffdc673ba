#include "report/paper.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace epiline::report {
namespace {

constexpr printed_scene scenes[] = {
    {"tsukuba", "Tsukuba"}, {"venus", "Venus"}, {"corridor", "Corridor"}, {"cones", "Cones"}, {"teddy", "Teddy"}};
constexpr frame_size sizes[] = {{320, 240}, {640, 480}, {800, 600}, {1024, 768}, {1280, 1024}};
constexpr printed_membership_error membership_errors[] = {{4, 0.061}, {5, 0.029}, {6, 0.015}, {7, 0.007}, {8, 0.003}};

}  // namespace

std::span<const printed_scene> printed_scenes() { return scenes; }
std::span<const frame_size> printed_sizes() { return sizes; }
std::span<const printed_membership_error> printed_membership_errors() { return membership_errors; }

std::span<const printed_row> printed_rows() {
  using cell = printed_accuracy;
  static const std::vector<printed_row> rows = {
      {"Method 1, no automaton",
       {counterpart{"adaptive_ca-off", "ours"}},
       {cell{55, 88}, std::nullopt, cell{36, 98}, cell{48, 65}, cell{90, 49}}},
      {"Method 1, automaton",
       {counterpart{"adaptive_ca-r24", "ours, R = 24"}, counterpart{"adaptive_ca-r1", "ours, R = 1 as in the paper"}},
       {cell{88, 51}, cell{92, std::nullopt}, cell{81, 75}, cell{72, 56}, cell{93, 47}}},
      {"Method 2, no FIS",
       {counterpart{"color_fuzzy-confident", "ours"}},
       {cell{94, 77}, cell{93, 75}, std::nullopt, cell{99, 80}, cell{98, 77}}},
      {"Method 2, FIS",
       {counterpart{"color_fuzzy-fis", "ours"}},
       {cell{89, 92}, cell{92, 90}, std::nullopt, cell{99, 93}, cell{98, 88}}},
  };
  return rows;
}

std::span<const printed_speed> printed_speeds() {
  constexpr frame_size tsukuba{384, 288};
  constexpr frame_size venus{434, 383};
  static const std::vector<printed_speed> speeds = {
      {"Method 1",
       "adaptive_ca",
       {1090, 275, 176, 108, 65},
       {8e7, -0.996},
       "Stratix II EP2S180: 84,307 ALUTs, 5,208 registers, 256 MHz",
       {{"Tsukuba, 16 levels", tsukuba, 1.3}, {"Venus, 20 levels", venus, 1.97}}},
      {"Method 2",
       "color_fuzzy",
       {1713, 439, 282, 173, 104},
       {1e8, -0.976},
       "Stratix III EP3SL340: 208,940 ALUTs, 15,624 registers, 6,912 memory bits, 138 MHz",
       {{"Tsukuba, 16 levels", tsukuba, 0.8}, {"Venus, 20 levels", venus, 1.2}}},
  };
  return speeds;
}

power_law fitted_power_law(std::span<const rate_point> points) {
  const auto count = static_cast<Eigen::Index>(points.size());
  Eigen::MatrixX2d terms(count, 2);
  Eigen::VectorXd logarithms(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto& [pixels, frames] = points[static_cast<std::size_t>(i)];
    if (!(pixels > 0) || !(frames > 0)) throw std::invalid_argument("a power law goes through positive values only");
    terms.row(i) << 1, std::log(pixels);
    logarithms(i) = std::log(frames);
  }
  const Eigen::ColPivHouseholderQR<Eigen::MatrixX2d> solver(terms);
  if (count < 2 || solver.rank() < 2) throw std::invalid_argument("a power law needs two points of different size");
  const Eigen::Vector2d solution = solver.solve(logarithms);
  return {std::exp(solution(0)), solution(1)};
}

double membership_error(int bits) {
  constexpr double sigma = 18.75;
  constexpr int samples = 128;
  const double steps = std::ldexp(1.0, bits);
  double largest = 0;
  for (int x = 0; x < samples; ++x) {
    const double degree = std::exp(-x * x / (2 * sigma * sigma));
    largest = std::max(largest, degree - std::floor(degree * steps) / steps);
  }
  return largest;
}

}  // namespace epiline::report
