// The discriminating set discriminates: counted with the reference models, every level wins somewhere, every border and
// tie-break decides pixels, and every rule of both filters fires.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <compare>
#include <cstdlib>
#include <functional>
#include <iterator>
#include <limits>
#include <set>

#include "golden/adaptive_ca.hpp"
#include "golden/color_fuzzy.hpp"
#include "golden/streaming_automaton.hpp"
#include "scenes/render.hpp"

namespace epiline::scenes {
namespace {

using golden::colour_image;
using golden::disparity_plane;
using golden::plane;

constexpr int levels = 80;

struct pictures {
  colour_image left;
  colour_image right;
};

colour_image planes_of(const eval::rgb_image& image) {
  plane<std::uint8_t> colours[3];
  for (int c = 0; c < 3; ++c) {
    colours[c].resize(image.height, image.width);
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) colours[c](y, x) = image.at(x, y)[c];
    }
  }
  return {colours[0], colours[1], colours[2]};
}

const std::vector<pictures>& discriminating_pictures() {
  static const auto all = [] {
    std::vector<pictures> result;
    for (const auto& choice : discriminating_set()) {
      const auto pair = render(choice.name, choice.parameters);
      result.push_back({planes_of(pair.left.image), planes_of(pair.right.image)});
    }
    return result;
  }();
  return all;
}

/// The cost of a disparity at a pixel, with the policies at the image's borders that another matcher might have.
struct policies {
  bool repeat_rows = false;  // rows outside the image are copies of its border, not 0
  bool repeat_columns_at_right = false;
  bool right_outside_is_black = false;  // right columns left of the image are 0, not copies of column 0
};

int cost(const pictures& of, bool grey, Eigen::Index y, Eigen::Index x, int d, int reach, const policies& at_borders) {
  const Eigen::Index rows = of.left.red.rows();
  const Eigen::Index columns = of.left.red.cols();
  int sum = 0;
  for (Eigen::Index j = y - reach; j <= y + reach; ++j) {
    if ((j < 0 || j >= rows) && !at_borders.repeat_rows) continue;
    const Eigen::Index row = std::clamp<Eigen::Index>(j, 0, rows - 1);
    for (Eigen::Index i = x - reach; i <= x + reach; ++i) {
      if (i < 0) continue;  // copies of column 0 would add the same to every disparity
      if (i >= columns && !at_borders.repeat_columns_at_right) continue;
      const Eigen::Index column = std::clamp<Eigen::Index>(i, 0, columns - 1);
      const Eigen::Index matching = std::max<Eigen::Index>(column - d, 0);
      const bool black = column < d && at_borders.right_outside_is_black;
      const auto value = [&](const colour_image& image, Eigen::Index at, int c) -> int {
        return c == 0 ? image.red(row, at) : c == 1 ? image.green(row, at) : image.blue(row, at);
      };
      if (grey) {
        const auto luma = [&](const colour_image& image, Eigen::Index at) {
          return (value(image, at, 0) + 2 * value(image, at, 1) + value(image, at, 2) + 2) / 4;
        };
        sum += std::abs(luma(of.left, column) - (black ? 0 : luma(of.right, matching)));
      } else {
        for (int c = 0; c < 3; ++c) {
          sum += std::abs(value(of.left, column, c) - (black ? 0 : value(of.right, matching, c)));
        }
      }
    }
  }
  return sum;
}

struct winner {
  int disparity = 0;
  int largest = 0;     // the last disparity of a tie
  bool ahead = false;  // a disparity d > x, which is no candidate, would win
};

winner find_winner(const pictures& of, bool grey, Eigen::Index y, Eigen::Index x, int reach,
                   const policies& at_borders = {}) {
  winner result;
  int lowest = std::numeric_limits<int>::max();
  for (int d = 0; d < levels; ++d) {
    const int here = cost(of, grey, y, x, d, reach, at_borders);
    if (d > x) {
      result.ahead = result.ahead || here < lowest;
      continue;
    }
    if (here < lowest) result.disparity = d;
    if (here <= lowest) result.largest = d;
    lowest = std::min(lowest, here);
  }
  return result;
}

/// Visits the pixels near a border of every picture with the method's own winner.
class discriminating_set_at_borders : public testing::TestWithParam<bool> {};

TEST_P(discriminating_set_at_borders, decides_every_policy_and_tie) {
  const bool grey = GetParam();
  test::branch_counts decided;
  for (const auto& of : discriminating_pictures()) {
    const Eigen::Index rows = of.left.red.rows();
    const Eigen::Index columns = of.left.red.cols();
    const auto windows = golden::chosen_window(golden::luma(of.left), 32, 100);
    const auto model = grey ? golden::adaptive_winners(of.left, of.right, {})
                            : golden::confident_winners(of.left, of.right, {.left_right = false, .uniqueness = 0});
    for (Eigen::Index y = 0; y < rows; ++y) {
      for (Eigen::Index x = 0; x < columns; ++x) {
        const int reach = grey ? windows(y, x) / 2 : 3;
        const bool above = y < reach;
        const bool below = y >= rows - reach;
        const bool at_right = x >= columns - reach;
        if (!above && !below && !at_right && x >= levels && (y + x) % 16 != 0) continue;  // a sample of the middle
        const winner found = find_winner(of, grey, y, x, reach);
        ASSERT_EQ(found.disparity, model.disparity(y, x)) << y << "," << x;
        if (found.largest != found.disparity) ++decided["tie"];
        if (found.ahead) ++decided["candidates end at column 0"];
        const auto other = [&](const policies& with) {
          return find_winner(of, grey, y, x, reach, with).disparity != found.disparity;
        };
        if (above && other({.repeat_rows = true})) ++decided["upper border"];
        if (below && other({.repeat_rows = true})) ++decided["lower border"];
        if (at_right && other({.repeat_columns_at_right = true})) ++decided["right border"];
        if (x < levels && other({.right_outside_is_black = true})) ++decided["right image's left border"];
      }
    }
  }
  for (const char* what : {"tie", "candidates end at column 0", "upper border", "lower border", "right border",
                           "right image's left border"}) {
    EXPECT_GE(decided[what], 10) << what;
  }
}

INSTANTIATE_TEST_SUITE_P(methods, discriminating_set_at_borders, testing::Bool(),
                         [](const auto& test) { return test.param ? "adaptive_ca" : "color_fuzzy"; });

TEST(discriminating_set, lets_every_level_win_before_and_after_the_filters) {
  const golden::adaptive_ca_parameters unfiltered{.automaton = false};
  const golden::color_fuzzy_parameters raw{.left_right = false, .uniqueness = 0, .fuzzy = 0};
  const std::function<disparity_plane(const pictures&)> maps[] = {
      [&](const auto& of) { return golden::adaptive_ca(of.left, of.right, unfiltered); },
      [](const auto& of) { return golden::adaptive_ca(of.left, of.right, {}); },
      [&](const auto& of) { return golden::color_fuzzy(of.left, of.right, raw); },
      [](const auto& of) { return golden::color_fuzzy(of.left, of.right, {}); },
  };
  for (const auto& map_of : maps) {
    std::vector<int> wins(levels);
    int undefined = 0;
    for (const auto& of : discriminating_pictures()) {
      const auto map = map_of(of);
      for (Eigen::Index i = 0; i < map.defined.size(); ++i) {
        if (map.defined(i)) {
          ++wins[map.disparity(i)];
        } else {
          ++undefined;
        }
      }
    }
    for (int d = 0; d < levels; ++d)
      EXPECT_GE(wins[static_cast<std::size_t>(d)], 5) << "map " << &map_of - maps << ", level " << d;
    EXPECT_TRUE(undefined > 1000 || &map_of == &maps[0] || &map_of == &maps[2]);
  }
}

// ---- method 1

TEST(discriminating_set, chooses_every_window_and_meets_both_thresholds) {
  test::branch_counts chosen;
  for (const auto& of : discriminating_pictures()) {
    const auto luma = golden::luma(of.left);
    const auto variation_2x2 = golden::local_variation_2x2(luma);
    const auto variation_5x5 = golden::local_variation_5x5(luma);
    const auto windows = golden::chosen_window(luma, 32, 100);
    for (Eigen::Index i = 0; i < windows.size(); ++i) {
      ++chosen["window " + std::to_string(windows(i))];
      if (variation_2x2(i) == 4 * 32) ++chosen["at the first threshold"];
      if (windows(i) != 3 && variation_5x5(i) == 25 * 100) ++chosen["at the second threshold"];
      if (windows(i) == 3 && variation_5x5(i) <= 25 * 100) ++chosen["first threshold goes before the second"];
    }
  }
  for (const char* what : {"window 3", "window 5", "window 7"}) EXPECT_GE(chosen[what], 1000) << what;
  EXPECT_GE(chosen["at the first threshold"], 10);
  EXPECT_GE(chosen["at the second threshold"], 1);
  EXPECT_GE(chosen["first threshold goes before the second"], 10);
}

TEST(discriminating_set, takes_every_branch_of_the_automaton) {
  test::branch_counts all;
  for (const int ring : {1, 20, 24, 40}) {
    test::branch_counts branches;
    for (const auto& of : discriminating_pictures()) {
      const auto map = golden::adaptive_winners(of.left, of.right, {});
      const auto streamed = test::streaming_automaton(map, branches).filter(ring);
      const auto planes = golden::automaton_rule_2(golden::automaton_rule_1(map, levels), levels, ring);
      EXPECT_EQ((planes.disparity != streamed.disparity || planes.defined != streamed.defined).count(), 0) << ring;
    }
    for (const auto& [branch, count] : branches) all[branch] += count;
  }
  for (const char* branch : test::automaton_branches) {
    // Every pixel has a winner, so the first rule never meets an undefined one.
    if (std::string(branch).starts_with("rule 1: undefined") ||
        std::string(branch).starts_with("rule 1 b: undefined")) {
      EXPECT_EQ(all[branch], 0) << branch;
    } else {
      EXPECT_GE(all[branch], 5) << branch;
    }
  }
}

// ---- method 2

TEST(discriminating_set, decides_uniqueness_and_the_left_right_check_each_way) {
  test::branch_counts met;
  for (const auto& of : discriminating_pictures()) {
    const Eigen::Index rows = of.left.red.rows();
    const Eigen::Index columns = of.left.red.cols();
    std::vector<plane<std::uint16_t>> costs;
    for (int d = 0; d < levels; ++d) costs.push_back(golden::aggregated_cost(of.left, of.right, d));
    const auto at = [&](Eigen::Index y, Eigen::Index x, int d) -> int {
      return costs[static_cast<std::size_t>(d)](y, x);
    };
    for (Eigen::Index y = 0; y < rows; ++y) {
      for (Eigen::Index x = 0; x < columns; ++x) {
        int best = 0;
        for (int d = 1; d < levels && d <= x; ++d) {
          if (at(y, x, d) < at(y, x, best)) best = d;
        }
        int second = std::numeric_limits<int>::max();
        bool neighbour_is_second = false;  // a disparity beside the winner is better than every other
        for (int d = 0; d < levels && d <= x; ++d) {
          if (std::abs(d - best) > 1) second = std::min(second, at(y, x, d));
        }
        for (const int d : {best - 1, best + 1}) {
          if (d >= 0 && d < levels && d <= x && at(y, x, d) < second) neighbour_is_second = true;
        }
        if (second == std::numeric_limits<int>::max()) {
          ++met["uniqueness: no second candidate"];
        } else {
          const int difference = 16 * second - 17 * at(y, x, best);
          ++met[difference > 0 ? "uniqueness: kept" : difference < 0 ? "uniqueness: dropped" : "uniqueness: just kept"];
          if (difference == 0 && second != 0) ++met["uniqueness: just kept, not with cost 0"];
          if (neighbour_is_second) ++met["uniqueness: winner's neighbours do not count"];
        }
        const Eigen::Index seen = x - best;
        int of_right = 0;
        bool tie = false;
        for (int d = 1; d < levels && seen + d < columns; ++d) {
          tie = tie || at(y, seen + d, d) == at(y, seen + of_right, of_right);
          if (at(y, seen + d, d) < at(y, seen + of_right, of_right)) {
            of_right = d;
            tie = false;
          }
        }
        if (tie) ++met["right winner: tie"];
        const int apart = std::abs(best - of_right);
        ++met["left-right: " + std::string(apart == 0   ? "same"
                                           : apart == 1 ? "one apart, kept"
                                           : apart == 2 ? "two apart, dropped"
                                                        : "farther, dropped")];
      }
    }
  }
  for (const char* what :
       {"uniqueness: no second candidate", "uniqueness: kept", "uniqueness: dropped", "uniqueness: just kept",
        "uniqueness: just kept, not with cost 0", "uniqueness: winner's neighbours do not count", "right winner: tie",
        "left-right: same", "left-right: one apart, kept", "left-right: two apart, dropped",
        "left-right: farther, dropped"}) {
    EXPECT_GE(met[what], 3) << what;
  }
}

/// What the inference of a pixel depends on: which of the three are defined, their differences, and which of two
/// neighbours is larger.
struct situation {
  std::array<bool, 3> defined;
  std::array<int, 3> apart;  // centre and left, centre and right, left and right; -1: one is undefined
  int order;                 // of left and right

  /// Differences as far as they matter: up to 4, from where on all are far.
  [[nodiscard]] situation exactly() const {
    return with([](int delta) { return std::min(delta, 4); });
  }
  /// Only whether they are rather the same (0), near (1, 2) or far.
  [[nodiscard]] situation roughly() const {
    return with([](int delta) { return delta <= 0 ? delta : delta <= 2 ? 1 : 3; });
  }
  [[nodiscard]] auto operator<=>(const situation&) const = default;

 private:
  template <class Change>
  [[nodiscard]] situation with(Change&& change) const {
    situation result = *this;
    for (int& delta : result.apart) delta = change(delta);
    return result;
  }
};

void PrintTo(const situation& met, std::ostream* stream) {
  *stream << testing::PrintToString(met.defined) << testing::PrintToString(met.apart) << met.order;
}

situation situation_of(golden::operand centre, golden::operand left, golden::operand right) {
  const auto apart = [](golden::operand a, golden::operand b) {
    return a.defined && b.defined ? std::abs(a.disparity - b.disparity) : -1;
  };
  const int order =
      left.defined && right.defined ? (left.disparity > right.disparity) - (left.disparity < right.disparity) : 0;
  return {{centre.defined, left.defined, right.defined},
          {apart(centre, left), apart(centre, right), apart(left, right)},
          order};
}

/// What can come up in the first pass, exactly, and in the second one, roughly: not everything, as the first brings
/// neighbours together. A pixel of the second pass depends on five of the map. Disparities up to 9 and none are enough
/// to be undefined, the same, near and far in every combination.
std::array<std::set<situation>, 2> possible_situations(bool careful) {
  std::array<std::set<situation>, 2> possible;
  std::vector<golden::operand> values{{}};
  for (int d = 0; d <= 9; ++d) values.push_back({d, true});
  for (const auto& b : values) {
    for (const auto& c : values) {
      for (const auto& d : values) {
        possible[0].insert(situation_of(c, b, d).exactly());
        const auto centre = golden::infer(c, b, d, careful);
        for (const auto& a : values) {
          const auto left = golden::infer(b, a, c, careful);
          for (const auto& e : values) {
            possible[1].insert(situation_of(centre, left, golden::infer(d, c, e, careful)).roughly());
          }
        }
      }
    }
  }
  return possible;
}

std::vector<situation> situations_of(const disparity_plane& map) {
  std::vector<situation> met;
  for (Eigen::Index y = 0; y < map.defined.rows(); ++y) {
    const auto value = [&](Eigen::Index x) {
      if (x < 0 || x >= map.defined.cols() || !map.defined(y, x)) return golden::operand{};
      return golden::operand{map.disparity(y, x), true};
    };
    for (Eigen::Index x = 0; x < map.defined.cols(); ++x) {
      met.push_back(situation_of(value(x), value(x - 3), value(x + 3)));
    }
  }
  return met;
}

TEST(discriminating_set, meets_every_situation_of_the_fuzzy_filter_in_both_passes) {
  for (const bool careful : {false, true}) {
    const std::array<std::set<situation>, 2> possible = possible_situations(careful);
    std::array<std::set<situation>, 2> met;
    for (const auto& of : discriminating_pictures()) {
      // With the checks the map is cautious, without them it is wild: the filter has to cope with both.
      for (const golden::color_fuzzy_parameters& with :
           {golden::color_fuzzy_parameters{}, {.left_right = false, .uniqueness = 0}, {.left_right = false}}) {
        disparity_plane map = golden::confident_winners(of.left, of.right, with);
        for (const auto& here : situations_of(map)) met[0].insert(here.exactly());
        map = golden::fuzzy_filter(map, careful);
        for (const auto& here : situations_of(map)) met[1].insert(here.roughly());
      }
    }
    for (const std::size_t pass : {0u, 1u}) {
      std::vector<situation> missing;
      std::ranges::set_difference(possible[pass], met[pass], std::back_inserter(missing));
      EXPECT_TRUE(missing.empty()) << "careful " << careful << ", pass " << pass << ", never met "
                                   << testing::PrintToString(missing);
      EXPECT_EQ(met[pass].size(), possible[pass].size());
    }
  }
}

}  // namespace
}  // namespace epiline::scenes
