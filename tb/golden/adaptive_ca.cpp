#include "golden/adaptive_ca.hpp"

#include <limits>
#include <vector>

namespace epiline::golden {
namespace {

using cost_plane = plane<std::uint16_t>;

/// The image with `above` and `left` more rows and columns before it, `below` and `right` after it, copies of its
/// border.
plane<int> replicate_border(const plane<std::uint8_t>& image, int before, int after) {
  const Eigen::Index rows = image.rows();
  const Eigen::Index columns = image.cols();
  plane<int> wide(rows + before + after, columns + before + after);
  for (Eigen::Index y = 0; y < wide.rows(); ++y) {
    for (Eigen::Index x = 0; x < wide.cols(); ++x) {
      wide(y, x) = image(std::clamp<Eigen::Index>(y - before, 0, rows - 1),
                         std::clamp<Eigen::Index>(x - before, 0, columns - 1));
    }
  }
  return wide;
}

/// n * sum |I - mean| over side x side = n pixels, of which the first lies `before` rows and columns before the centre.
plane<int> local_variation(const plane<std::uint8_t>& image, int side, int before) {
  const Eigen::Index rows = image.rows();
  const Eigen::Index columns = image.cols();
  const plane<int> wide = replicate_border(image, before, side - 1 - before);
  const auto shifted = [&](int k) { return wide.block(k / side, k % side, rows, columns); };
  plane<int> sum = plane<int>::Zero(rows, columns);
  for (int k = 0; k < side * side; ++k) sum += shifted(k);
  plane<int> variation = plane<int>::Zero(rows, columns);
  for (int k = 0; k < side * side; ++k) variation += (side * side * shifted(k) - sum).abs();
  return variation;
}

using cells = plane<std::uint8_t>;  // of one binary plane: 0 or 1

std::vector<cells> split(const disparity_plane& map, int levels) {
  std::vector<cells> planes;
  for (int v = 0; v < levels; ++v) {
    planes.push_back((map.defined && map.disparity == static_cast<std::uint8_t>(v)).cast<std::uint8_t>());
  }
  return planes;
}

/// A pixel that exactly one plane holds has that plane's level.
disparity_plane recompose(const std::vector<cells>& planes) {
  cells claims = cells::Zero(planes[0].rows(), planes[0].cols());
  plane<int> level = plane<int>::Zero(claims.rows(), claims.cols());
  for (std::size_t v = 0; v < planes.size(); ++v) {
    claims += planes[v];
    level += static_cast<int>(v) * planes[v].cast<int>();
  }
  const plane<bool> defined = claims == std::uint8_t{1};
  return {defined.select(level, 0).cast<std::uint8_t>(), defined};
}

}  // namespace

plane<std::uint8_t> luma(const colour_image& image) {
  return ((image.red.cast<int>() + 2 * image.green.cast<int>() + image.blue.cast<int>() + 2) / 4).cast<std::uint8_t>();
}

plane<int> local_variation_2x2(const plane<std::uint8_t>& image) { return local_variation(image, 2, 0); }

plane<int> local_variation_5x5(const plane<std::uint8_t>& image) { return local_variation(image, 5, 2); }

plane<std::uint8_t> chosen_window(const plane<std::uint8_t>& left, int t2, int t5) {
  const plane<bool> textured = local_variation_2x2(left) > 4 * t2;
  const plane<bool> less_textured = local_variation_5x5(left) > 25 * t5;
  const auto side = [&](std::uint8_t n) { return plane<std::uint8_t>::Constant(left.rows(), left.cols(), n); };
  return textured.select(side(3), less_textured.select(side(5), side(7)));
}

cost_plane adaptive_cost(const plane<std::uint8_t>& left, const plane<std::uint8_t>& right,
                         const plane<std::uint8_t>& window, int d) {
  const cost_plane difference = absolute_difference(left, right, d).cast<std::uint16_t>();
  const auto is = [&](int side) { return window == static_cast<std::uint8_t>(side); };
  return is(3).select(window_sum(difference, 3), is(5).select(window_sum(difference, 5), window_sum(difference, 7)));
}

disparity_plane adaptive_winners(const colour_image& left, const colour_image& right,
                                 const adaptive_ca_parameters& parameters) {
  const plane<std::uint8_t> left_luma = luma(left);
  const plane<std::uint8_t> right_luma = luma(right);
  const plane<std::uint8_t> window = chosen_window(left_luma, parameters.t2, parameters.t5);
  const Eigen::Index rows = window.rows();
  const Eigen::Index columns = window.cols();

  cost_plane best = cost_plane::Constant(rows, columns, std::numeric_limits<std::uint16_t>::max());
  plane<std::uint8_t> winner = plane<std::uint8_t>::Zero(rows, columns);
  for (int d = 0; d < parameters.levels && d < columns; ++d) {
    // A disparity is a candidate only where its right pixel exists: d <= x.
    const cost_plane cost = adaptive_cost(left_luma, right_luma, window, d).rightCols(columns - d);
    auto lowest = best.rightCols(columns - d);
    auto level = winner.rightCols(columns - d);
    const plane<bool> better = cost < lowest;  // strictly: the smallest disparity wins a tie
    lowest = better.select(cost, lowest).eval();
    level = better.select(plane<std::uint8_t>::Constant(rows, columns - d, static_cast<std::uint8_t>(d)), level).eval();
  }
  return {winner, plane<bool>::Constant(rows, columns, true)};
}

disparity_plane automaton_rule_1(const disparity_plane& map, int levels) {
  std::vector<cells> planes = split(map, levels);
  plane<bool> born_somewhere = plane<bool>::Constant(map.defined.rows(), map.defined.cols(), false);
  std::vector<plane<bool>> born;
  for (cells& set : planes) {
    const cells neighbours = window_sum(set, 3) - set;
    born.push_back(set == std::uint8_t{0} && neighbours >= std::uint8_t{7});
    born_somewhere = born_somewhere || born.back();
    const plane<bool> kept = set != std::uint8_t{0} && neighbours != std::uint8_t{0};
    set = (kept || born.back()).cast<std::uint8_t>();
  }
  for (std::size_t v = 0; v < planes.size(); ++v) {
    const plane<bool> left_its_plane = born_somewhere && !born[v];
    planes[v] = left_its_plane.select(cells::Zero(planes[v].rows(), planes[v].cols()), planes[v]).eval();
  }
  return recompose(planes);
}

disparity_plane automaton_rule_2(const disparity_plane& map, int levels, int ring) {
  std::vector<cells> planes = split(map, levels);
  for (cells& set : planes) {
    const cells near = window_sum(set, 3);
    const cells around = window_sum(set, 7) - near;
    set = (near >= std::uint8_t{1} && around >= static_cast<std::uint8_t>(ring)).cast<std::uint8_t>();
  }
  return recompose(planes);
}

disparity_plane adaptive_ca(const colour_image& left, const colour_image& right,
                            const adaptive_ca_parameters& parameters) {
  const disparity_plane winners = adaptive_winners(left, right, parameters);
  if (!parameters.automaton) return winners;
  return automaton_rule_2(automaton_rule_1(winners, parameters.levels), parameters.levels, parameters.ring);
}

}  // namespace epiline::golden
