// The inference engine and the disparity filter built on it.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <random>
#include <vector>

#include "brute_force.hpp"
#include "kernels/fuzzy_filter.hpp"
#include "kernels/fuzzy_inference.hpp"
#include "kernels/fuzzy_rule_base.hpp"

namespace epiline::kernels {
namespace {

constexpr int no_disparity = test::undefined;

template <int Lanes, class RuleBase = triangular_rule_base<6>>
struct config {
  static constexpr int pixels_per_beat = Lanes;
  static constexpr int fuzzy_radius = 3;
  using rule_base = RuleBase;
};

disparity_pixel pixel_of(int disparity) {
  return {disparity == no_disparity ? 0 : disparity, disparity != no_disparity, 1};
}
int value_of(const disparity_pixel& pixel) { return pixel.defined != 0 ? pixel.disparity.to_int() : no_disparity; }

template <class RuleBase>
int filtered(int c, int l, int r, bool careful_fill = false) {
  return value_of(fuzzy_filter<config<1, RuleBase>>::filter(pixel_of(c), pixel_of(l), pixel_of(r), careful_fill));
}

template <int Bits>
void expect_partition_of_unity() {
  using base = triangular_rule_base<Bits>;
  for (int delta = 0; delta < base::domain; ++delta) {
    int sum = 0;
    for (int k = 0; k < base::labels; ++k) sum += base::membership.of[delta][k];
    EXPECT_EQ(sum, (1 << Bits) - 1) << Bits << " bits, difference " << delta;
  }
}

TEST(triangular_rule_base, degrees_sum_up_to_full_membership) {
  expect_partition_of_unity<4>();
  expect_partition_of_unity<5>();
  expect_partition_of_unity<6>();
  expect_partition_of_unity<7>();
  expect_partition_of_unity<8>();
}

TEST(triangular_rule_base, has_the_specified_degrees_of_six_bits) {
  constexpr int expected[5][3] = {{63, 0, 0}, {31, 32, 0}, {0, 63, 0}, {0, 31, 32}, {0, 0, 63}};
  using engine = fuzzy_inference<triangular_rule_base<6>>;
  for (int delta = 0; delta < 128; ++delta) {
    const auto value = engine::fuzzify(disparity_t(delta), true);
    for (int k = 0; k < 3; ++k) EXPECT_EQ(value.label[k], expected[std::min(delta, 4)][k]) << delta << ' ' << k;
  }
}

TEST(fuzzify, undefined_input_belongs_to_the_last_label_in_full) {
  using engine = fuzzy_inference<triangular_rule_base<5>>;
  for (int delta = 0; delta < 128; ++delta) {
    const auto value = engine::fuzzify(disparity_t(delta), false);
    EXPECT_EQ(value.label[same], 0);
    EXPECT_EQ(value.label[near], 0);
    EXPECT_EQ(value.label[far], 31);
  }
}

TEST(fuzzy_inference, is_min_max_for_all_degrees_of_a_label) {
  using engine = fuzzy_inference<triangular_rule_base<4>>;
  std::mt19937 random(1);
  for (int trial = 0; trial < 20000; ++trial) {
    engine::fuzzy_value input[3];
    for (auto& value : input) {
      for (auto& degree : value.label) degree = random() % 16;
    }
    int expected[3] = {0, 0, 0};
    for (int u = 0; u < 3; ++u) {
      for (int v = 0; v < 3; ++v) {
        for (int w = 0; w < 3; ++w) {
          int& set = expected[disparity_rules.set[u][v][w]];
          set = std::max(
              set, std::min({input[0].label[u].to_int(), input[1].label[v].to_int(), input[2].label[w].to_int()}));
        }
      }
    }
    const auto conclusion = engine::infer(input[0], input[1], input[2]);
    for (int set = 0; set < 3; ++set) ASSERT_EQ(conclusion.set[set], expected[set]);
  }
}

TEST(fuzzy_filter, equals_the_tables_for_all_disparities) {
  for (int c = 0; c <= 128; ++c) {
    for (int l = 0; l <= 128; ++l) {
      for (int r = 0; r <= 128; ++r) {
        const auto plain = [](int value) { return value == 128 ? no_disparity : value; };
        for (const bool careful_fill : {false, true}) {
          if (careful_fill && c != 128) continue;
          ASSERT_EQ(filtered<triangular_rule_base<6>>(plain(c), plain(l), plain(r), careful_fill),
                    test::brute_force_filter(plain(c), plain(l), plain(r), careful_fill))
              << c << ' ' << l << ' ' << r << ' ' << careful_fill;
        }
      }
    }
  }
}

/// Every order and every pair of differences up to "far" occurs within 0 .. 16; more distance changes nothing.
template <class Body>
void for_all_constellations(Body body) {
  for (int c = 0; c <= 17; ++c) {
    for (int l = 0; l <= 17; ++l) {
      for (int r = 0; r <= 17; ++r) {
        const auto plain = [](int value) { return value == 17 ? no_disparity : value; };
        body(plain(c), plain(l), plain(r));
      }
    }
  }
}

TEST(fuzzy_filter, result_of_triangular_sets_does_not_depend_on_degree_bits) {
  for_all_constellations([](int c, int l, int r) {
    for (const bool careful_fill : {false, true}) {
      const int expected = filtered<triangular_rule_base<6>>(c, l, r, careful_fill);
      ASSERT_EQ(filtered<triangular_rule_base<4>>(c, l, r, careful_fill), expected) << c << ' ' << l << ' ' << r;
      ASSERT_EQ(filtered<triangular_rule_base<5>>(c, l, r, careful_fill), expected) << c << ' ' << l << ' ' << r;
      ASSERT_EQ(filtered<triangular_rule_base<7>>(c, l, r, careful_fill), expected) << c << ' ' << l << ' ' << r;
      ASSERT_EQ(filtered<triangular_rule_base<8>>(c, l, r, careful_fill), expected) << c << ' ' << l << ' ' << r;
    }
  });
}

constexpr double gaussian_sigma = 18.75;

/// exp(-x * x / (2 sigma^2)) at compile time: the series converges quickly after the argument is halved four times.
constexpr double gaussian(double x, double sigma) {
  const double argument = -x * x / (2 * sigma * sigma) / 16;
  double term = 1;
  double sum = 1;
  for (int i = 1; i < 60; ++i) {
    term *= argument / i;
    sum += term;
  }
  for (int i = 0; i < 4; ++i) sum *= sum;
  return sum;
}

TEST(gaussian, is_the_exponential_function) {
  for (int x = 0; x < 128; ++x) {
    EXPECT_NEAR(gaussian(x, gaussian_sigma), std::exp(-x * x / (2 * gaussian_sigma * gaussian_sigma)), 1e-12) << x;
  }
}

TEST(digitised_membership, has_the_published_largest_errors) {
  // The paper's table, N = 4 .. 8, three decimals cut off.
  constexpr int published_thousandths[] = {61, 29, 15, 7, 3};
  for (int bits = 4; bits <= 8; ++bits) {
    double largest = 0;
    for (int x = 0; x < 128; ++x) {
      const double degree = std::exp(-x * x / (2 * gaussian_sigma * gaussian_sigma));
      const double steps = 1 << bits;
      largest = std::max(largest, degree - std::floor(degree * steps) / steps);
    }
    EXPECT_EQ(static_cast<int>(largest * 1000), published_thousandths[bits - 4]) << bits << " bits: " << largest;
  }
}

/// Overlapping bell curves: no label dominates clearly, so coarse degrees tie where fine ones do not.
template <int DegreeBits>
struct gaussian_rule_base {
  static constexpr int degree_bits = DegreeBits;
  static constexpr int labels = 3;
  static constexpr int sets = 3;
  static constexpr int domain = 16;
  static constexpr membership_table<domain, labels> sampled() {
    membership_table<domain, labels> table{};
    for (int x = 0; x < domain; ++x) {
      for (int k = 0; k < labels; ++k) {
        const double degree = k == 2 && x == domain - 1 ? 1 : gaussian(x - 6 * k, gaussian_sigma);
        const int steps = static_cast<int>(degree * (1 << DegreeBits));
        table.of[x][k] = static_cast<unsigned char>(std::min(steps, (1 << DegreeBits) - 1));
      }
    }
    return table;
  }
  static constexpr membership_table<domain, labels> membership = sampled();
  static constexpr rule_table<3> rules = disparity_rules;
};

/// Mamdani inference and largest-of-maximum in plain integers for any rule base with a defined centre.
template <class RuleBase>
int plain_filter(int c, int l, int r) {
  const auto degree = [](int a, int b, int label) -> int {
    if (a == no_disparity || b == no_disparity) return label == 2 ? (1 << RuleBase::degree_bits) - 1 : 0;
    return RuleBase::membership.of[std::min(std::abs(a - b), RuleBase::domain - 1)][label];
  };
  int sets[3] = {0, 0, 0};
  for (int i = 0; i < 27; ++i) {
    const int rule = std::min({degree(c, l, i / 9), degree(c, r, i / 3 % 3), degree(l, r, i % 3)});
    int& set = sets[RuleBase::rules.set[i / 9][i / 3 % 3][i % 3]];
    set = std::max(set, rule);
  }
  const int highest = *std::max_element(sets, sets + 3);
  int result = -1;
  if (sets[0] == highest) result = c;
  if (sets[1] == highest && l != no_disparity) result = std::max(result, l);
  if (sets[1] == highest && r != no_disparity) result = std::max(result, r);
  return result < 0 ? no_disparity : result;
}

TEST(fuzzy_filter, follows_any_rule_base_and_gaussian_sets_do_depend_on_degree_bits) {
  int differing = 0;
  for_all_constellations([&differing](int c, int l, int r) {
    if (c == no_disparity) return;
    const int coarse = filtered<gaussian_rule_base<4>>(c, l, r);
    const int fine = filtered<gaussian_rule_base<8>>(c, l, r);
    ASSERT_EQ(coarse, plain_filter<gaussian_rule_base<4>>(c, l, r)) << c << ' ' << l << ' ' << r;
    ASSERT_EQ(filtered<gaussian_rule_base<6>>(c, l, r), plain_filter<gaussian_rule_base<6>>(c, l, r));
    ASSERT_EQ(fine, plain_filter<gaussian_rule_base<8>>(c, l, r)) << c << ' ' << l << ' ' << r;
    differing += coarse != fine;
  });
  EXPECT_GT(differing, 0);
}

template <int Lanes>
void expect_rows_filtered() {
  using filter_t = fuzzy_filter<config<Lanes>>;
  const auto filter = std::make_unique<filter_t>();
  std::mt19937 random(1);
  std::vector<int> raster;  // -1 = outside the frame
  std::vector<int> expected;
  for (int row = 0; row < 40; ++row) {
    std::vector<int> pixels(1 + random() % 20);
    for (auto& pixel : pixels) pixel = random() % 3 == 0 ? no_disparity : static_cast<int>(60 + random() % 8);
    for (int x = 0; x < static_cast<int>(pixels.size()); ++x) {
      const auto at = [&pixels](int i) {
        return i >= 0 && i < static_cast<int>(pixels.size()) ? pixels[static_cast<std::size_t>(i)] : no_disparity;
      };
      raster.push_back(at(x));
      expected.push_back(test::brute_force_filter(at(x), at(x - 3), at(x + 3), false));
    }
    for (int outside = 0; outside < 3 || raster.size() % Lanes != 0; ++outside) {
      raster.push_back(-1);
      expected.push_back(no_disparity);
    }
  }
  for (const bool enabled : {true, false}) {
    for (std::size_t first = 0; first < raster.size() + filter_t::delay_beats * Lanes; first += Lanes) {
      typename filter_t::beat beat;
      for (std::size_t lane = 0; lane < Lanes; ++lane) {
        const int value = first + lane < raster.size() ? raster[first + lane] : -1;
        beat.pixel[lane] = pixel_of(value < 0 ? no_disparity : value);
        beat.pixel[lane].in_frame = value >= 0;
      }
      beat.marks = {first % 2, first % 3 == 0, first % 5 == 0};
      const auto result = filter->step(beat, enabled, false);
      if (first < filter_t::delay_beats * Lanes) continue;
      const std::size_t then = first - filter_t::delay_beats * Lanes;
      EXPECT_EQ(result.marks.in_frame, then % 2);
      EXPECT_EQ(result.marks.first_beat, then % 3 == 0);
      EXPECT_EQ(result.marks.last_of_row, then % 5 == 0);
      for (std::size_t lane = 0; lane < Lanes; ++lane) {
        const int unchanged = raster[then + lane] < 0 ? no_disparity : raster[then + lane];
        ASSERT_EQ(value_of(result.pixel[lane]), enabled ? expected[then + lane] : unchanged)
            << "lanes " << Lanes << ", pixel " << then + lane;
      }
    }
  }
}

TEST(fuzzy_filter, takes_neighbours_outside_the_row_as_undefined) {
  expect_rows_filtered<1>();
  expect_rows_filtered<2>();
  expect_rows_filtered<4>();
}

}  // namespace
}  // namespace epiline::kernels
