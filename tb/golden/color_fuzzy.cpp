#include "golden/color_fuzzy.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>

namespace epiline::golden {
namespace {

using cost_plane = plane<std::uint16_t>;

// ---- the default rule base
// -------------------------------------------------------------------------------------------

enum label : std::uint8_t { same, near, far };
enum class output_set : std::uint8_t { centre, neighbours, undefined };

using degrees = std::array<int, 3>;  // of same, near, far

/// Degrees of a difference, 6 bits: the breakpoints are 0, 2, 4 and the three degrees add up to 63.
degrees fuzzify(int delta) {
  static constexpr std::array<degrees, 5> table{{{63, 0, 0}, {31, 32, 0}, {0, 63, 0}, {0, 31, 32}, {0, 0, 63}}};
  return table[static_cast<std::size_t>(std::min(delta, 4))];
}

degrees fuzzify(operand a, operand b) {
  return a.defined && b.defined ? fuzzify(std::abs(a.disparity - b.disparity)) : degrees{0, 0, 63};
}

/// ALGORITHMS.md section 3, the table of 27 rules.
output_set rule(int u, int v, int w) {
  constexpr auto c = output_set::centre;
  constexpr auto n = output_set::neighbours;
  constexpr auto none = output_set::undefined;
  static constexpr output_set table[3][3][3] = {
      {{c, c, c}, {c, c, c}, {c, c, c}},
      {{c, c, c}, {n, c, c}, {n, c, c}},
      {{c, c, c}, {n, c, c}, {n, n, none}},
  };
  return table[u][v][w];
}

operand fill(operand left, operand right, bool careful) {
  if (left.defined && right.defined) {
    const bool agree = fuzzify(left, right)[far] < 32;
    if (agree) return {std::max(left.disparity, right.disparity), true};
    return careful ? operand{} : operand{std::min(left.disparity, right.disparity), true};
  }
  if (careful) return {};
  return left.defined ? left : right;
}

}  // namespace

cost_plane aggregated_cost(const colour_image& left, const colour_image& right, int d) {
  constexpr int window = 7;
  const cost_plane difference =
      (absolute_difference(left.red, right.red, d) + absolute_difference(left.green, right.green, d) +
       absolute_difference(left.blue, right.blue, d))
          .cast<std::uint16_t>();
  return window_sum(difference, window);
}

disparity_plane confident_winners(const colour_image& left, const colour_image& right,
                                  const color_fuzzy_parameters& parameters) {
  const Eigen::Index rows = left.red.rows();
  const Eigen::Index columns = left.red.cols();
  // A disparity is a candidate only where its right pixel exists: d <= x.
  const int levels = static_cast<int>(std::min<Eigen::Index>(parameters.levels, columns));

  constexpr std::uint16_t never = std::numeric_limits<std::uint16_t>::max();  // above every cost
  cost_plane best = cost_plane::Constant(rows, columns, never);
  plane<std::uint8_t> winner = plane<std::uint8_t>::Zero(rows, columns);
  cost_plane best_of_right = best;
  plane<std::uint8_t> winner_of_right = winner;
  // Costs are computed twice, here and for the second minimum, rather than kept for every level at once.
  for (int d = 0; d < levels; ++d) {
    const cost_plane cost = aggregated_cost(left, right, d).rightCols(columns - d);
    const auto improve = [&](auto&& minimum, auto&& argument) {
      const plane<bool> better = cost < minimum;  // strictly: the smallest disparity wins a tie
      minimum = better.select(cost, minimum).eval();
      argument = better.select(plane<std::uint8_t>::Constant(rows, columns - d, static_cast<std::uint8_t>(d)), argument)
                     .eval();
    };
    improve(best.rightCols(columns - d), winner.rightCols(columns - d));
    improve(best_of_right.leftCols(columns - d), winner_of_right.leftCols(columns - d));
  }

  plane<bool> keep = plane<bool>::Constant(rows, columns, true);
  if (parameters.uniqueness != 0) {
    cost_plane second = cost_plane::Constant(rows, columns, never);  // `never` stays where there is no other candidate
    const plane<std::int16_t> chosen = winner.cast<std::int16_t>();
    for (int d = 0; d < levels; ++d) {
      const cost_plane cost = aggregated_cost(left, right, d).rightCols(columns - d);
      auto minimum = second.rightCols(columns - d);
      const plane<bool> other = (chosen.rightCols(columns - d) - static_cast<std::int16_t>(d)).abs() > 1;
      minimum = (other && cost < minimum).select(cost, minimum).eval();
    }
    keep = second == never || 16 * second.cast<int>() >= parameters.uniqueness * best.cast<int>();
  }
  if (parameters.left_right) {
    for (Eigen::Index y = 0; y < rows; ++y) {
      for (Eigen::Index x = 0; x < columns; ++x) {
        const int d = winner(y, x);
        keep(y, x) = keep(y, x) && std::abs(d - winner_of_right(y, x - d)) <= 1;
      }
    }
  }
  return {keep.select(winner, plane<std::uint8_t>::Zero(rows, columns)), keep};
}

operand infer(operand centre, operand left, operand right, bool careful_fill) {
  if (!centre.defined) return fill(left, right, careful_fill);
  const degrees u = fuzzify(centre, left);
  const degrees v = fuzzify(centre, right);
  const degrees w = fuzzify(left, right);
  std::array<int, 3> aggregated{};  // of the output sets
  for (int i = same; i <= far; ++i) {
    for (int j = same; j <= far; ++j) {
      for (int k = same; k <= far; ++k) {
        const int strength = std::min({u[i], v[j], w[k]});
        int& degree = aggregated[static_cast<std::size_t>(rule(i, j, k))];
        degree = std::max(degree, strength);
      }
    }
  }
  const int highest = *std::max_element(aggregated.begin(), aggregated.end());
  const auto reaches = [&](output_set set) { return aggregated[static_cast<std::size_t>(set)] == highest; };
  operand result;
  const auto offer = [&](operand singleton) {
    if (singleton.defined) result = {std::max(result.disparity, singleton.disparity), true};
  };
  if (reaches(output_set::centre)) offer(centre);
  if (reaches(output_set::neighbours)) {
    offer(left);
    offer(right);
  }
  return result;
}

disparity_plane fuzzy_filter(const disparity_plane& input, bool careful_fill) {
  constexpr Eigen::Index distance = 3;
  disparity_plane output = input;
  const auto value = [&](Eigen::Index y, Eigen::Index x) {
    if (x < 0 || x >= input.defined.cols()) return operand{};
    return operand{input.disparity(y, x), input.defined(y, x)};
  };
  for (Eigen::Index y = 0; y < input.defined.rows(); ++y) {
    for (Eigen::Index x = 0; x < input.defined.cols(); ++x) {
      const operand result = infer(value(y, x), value(y, x - distance), value(y, x + distance), careful_fill);
      output.disparity(y, x) = static_cast<std::uint8_t>(result.defined ? result.disparity : 0);
      output.defined(y, x) = result.defined;
    }
  }
  return output;
}

disparity_plane color_fuzzy(const colour_image& left, const colour_image& right,
                            const color_fuzzy_parameters& parameters) {
  disparity_plane map = confident_winners(left, right, parameters);
  for (int pass = 0; pass < parameters.fuzzy; ++pass) map = fuzzy_filter(map, parameters.careful_fill);
  return map;
}

}  // namespace epiline::golden
