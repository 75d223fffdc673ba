#include "report/paper.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "report/methods.hpp"

namespace epiline::report {
namespace {

TEST(membership_error, reproduces_the_papers_table_cut_to_three_decimals) {
  for (const auto& printed : printed_membership_errors()) {
    EXPECT_DOUBLE_EQ(std::floor(membership_error(printed.bits) * 1000) / 1000, printed.error) << printed.bits;
  }
  // ALGORITHMS.md section 3.4, to four decimals.
  EXPECT_NEAR(membership_error(4), 0.0611, 0.00005);
  EXPECT_NEAR(membership_error(5), 0.0298, 0.00005);
  EXPECT_NEAR(membership_error(6), 0.0154, 0.00005);
  EXPECT_NEAR(membership_error(7), 0.0076, 0.00005);
}

TEST(membership_error, is_below_one_step_and_falls_with_the_bits) {
  for (int bits = 1; bits <= 16; ++bits) {
    EXPECT_LT(membership_error(bits), std::ldexp(1.0, -bits));
    EXPECT_GT(membership_error(bits), membership_error(bits + 1));
  }
}

TEST(fitted_power_law, finds_a_law_that_the_points_obey) {
  std::vector<rate_point> points;
  for (const double pixels : {1e3, 2e4, 5e5}) points.push_back({pixels, 3e7 * std::pow(pixels, -0.9)});
  const auto law = fitted_power_law(points);
  EXPECT_NEAR(law.factor / 3e7, 1, 1e-9);
  EXPECT_NEAR(law.exponent, -0.9, 1e-12);
}

TEST(fitted_power_law, balances_errors_of_the_logarithms) {
  // Of one size, e^1 and e^3; of another, e^5: the line goes through their means, e^2 and e^5.
  const auto law =
      fitted_power_law(std::vector<rate_point>{{1, std::exp(1)}, {1, std::exp(3)}, {std::exp(1), std::exp(5)}});
  EXPECT_NEAR(law.factor, std::exp(2), 1e-9);
  EXPECT_NEAR(law.exponent, 3, 1e-9);
}

TEST(fitted_power_law, through_the_papers_rates_lies_near_the_papers_lines) {
  for (const auto& speed : printed_speeds()) {
    std::vector<rate_point> points;
    for (std::size_t s = 0; s < speed.frames.size(); ++s) {
      points.push_back({static_cast<double>(printed_sizes()[s].width) * printed_sizes()[s].height, speed.frames[s]});
    }
    const auto law = fitted_power_law(points);
    EXPECT_NEAR(law.exponent, speed.line.exponent, 0.015) << speed.title;
    EXPECT_NEAR(law.factor / speed.line.factor, 1, 0.15) << speed.title;
  }
}

TEST(fitted_power_law, refuses_what_no_law_goes_through) {
  using points = std::vector<rate_point>;
  EXPECT_THROW((void)fitted_power_law(points{}), std::invalid_argument);
  EXPECT_THROW((void)fitted_power_law(points{{2, 3}}), std::invalid_argument);
  EXPECT_THROW((void)fitted_power_law(points{{2, 3}, {2, 4}}), std::invalid_argument);
  EXPECT_THROW((void)fitted_power_law(points{{2, 3}, {0, 4}}), std::invalid_argument);
  EXPECT_THROW((void)fitted_power_law(points{{2, 3}, {3, -4}}), std::invalid_argument);
}

TEST(paper, tables_have_a_cell_for_every_column) {
  for (const auto& row : printed_rows()) EXPECT_EQ(row.cells.size(), printed_scenes().size()) << row.title;
  for (const auto& speed : printed_speeds()) EXPECT_EQ(speed.frames.size(), printed_sizes().size()) << speed.title;
}

TEST(paper, rows_stand_beside_methods_that_exist) {
  std::vector<std::string> ids;
  for (const auto& design : eval::all_designs()) {
    const eval::engine_registry::entry engine{std::string(design.name), "native", "", nullptr};
    for (const auto& method : methods_of(design, engine)) ids.push_back(method.id);
  }
  for (const auto& row : printed_rows()) {
    ASSERT_FALSE(row.ours.empty());
    for (const auto& ours : row.ours) EXPECT_NE(std::ranges::find(ids, ours.method), ids.end()) << ours.method;
  }
}

}  // namespace
}  // namespace epiline::report
