// The page, the JSON and the CSV of an evaluation made up by the test.

#include "report/page.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <limits>
#include <regex>

#include "report/figures_files.hpp"
#include "report/html.hpp"

namespace epiline::report {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// The methods of every design with maps of its own and OpenCV's.
std::vector<method> every_method() {
  static const eval::engine_registry::entry engine{"", "native", "", nullptr};
  std::vector<method> methods;
  for (const auto& design : eval::all_designs()) {
    if (!design.same_maps_as.empty()) continue;
    for (auto& each : methods_of(design, engine)) methods.push_back(std::move(each));
  }
  for (auto& each : opencv_methods()) methods.push_back(std::move(each));
  return methods;
}

/// A pair of 4x2 pixels, truth 3 everywhere. The method of index m finds m right pixels (at most 8), and nothing else.
pair_result tiny_pair(const std::string& scene, std::size_t methods) {
  pair_result made;
  made.entry.scene = scene;
  made.entry.family = "made <by> the test";
  made.entry.levels = 16;
  made.pair.emplace();
  made.pair->entry = made.entry;
  made.pair->left = eval::rgb_image(4, 2);
  made.pair->right = eval::rgb_image(4, 2);
  made.pair->truth = eval::ground_truth{{4, 2, std::vector<double>(8, 3.0)}, std::nullopt, std::nullopt};
  made.pair->near_discontinuity_source = "derived";
  for (std::size_t m = 0; m < methods; ++m) {
    method_result result;
    result.map = {4, 2, std::vector<double>(8, none)};
    for (std::size_t i = 0; i < std::min<std::size_t>(m, 8); ++i) result.map.values[i] = 3;
    result.figures = eval::measure(result.map, &*made.pair->truth);
    made.methods.push_back(std::move(result));
  }
  return made;
}

evaluation small_evaluation() {
  evaluation found{"native", every_method(), {}};
  found.pairs.push_back(tiny_pair("tsukuba", found.methods.size()));
  return found;
}

std::string page(const evaluation& found, const timings& timing = {}) {
  return page_of({found, timing, "1.2.3", "epiline evaluate --only <x>"});
}

TEST(page, needs_nothing_but_itself) {
  const std::string html = page(small_evaluation());
  EXPECT_THAT(html, Not(HasSubstr("<script")));
  EXPECT_THAT(html, Not(HasSubstr("http")));
  EXPECT_THAT(html, Not(HasSubstr("@import")));
  const std::regex source("(?:src|href)=\"([^\"]{0,20})");
  for (auto at = std::sregex_iterator(html.begin(), html.end(), source); at != std::sregex_iterator(); ++at) {
    const std::string target = (*at)[1];
    EXPECT_TRUE(target.starts_with("data:image/") || target.starts_with("#") || target.starts_with("figures."))
        << target;
  }
  EXPECT_THAT(html,
              AllOf(HasSubstr("name=\"viewport\""), HasSubstr("prefers-color-scheme: dark"), HasSubstr("lang=\"en\"")));
}

TEST(page, every_link_on_it_leads_somewhere) {
  const std::string html = page(small_evaluation());
  const std::regex link("href=\"#([^\"]+)\"");
  int links = 0;
  for (auto at = std::sregex_iterator(html.begin(), html.end(), link); at != std::sregex_iterator(); ++at, ++links) {
    EXPECT_THAT(html, HasSubstr(fmt::format("id=\"{}\"", (*at)[1].str())));
  }
  EXPECT_GT(links, 3);
}

TEST(page, opens_and_closes_its_elements) {
  auto found = small_evaluation();
  found.pairs.push_back({});
  found.pairs.back().entry.scene = "gone";
  found.pairs.back().failure = "no folder";
  const std::string html = page(found);
  for (const char* element : {"table", "thead", "tbody", "tr", "th",   "td",   "p",  "ul", "li", "div", "figure",
                              "h2",    "h3",    "main",  "b",  "code", "span", "dl", "dt", "dd", "sup"}) {
    const auto count = [&](const std::string& pattern) {
      const std::regex expression(pattern);
      return std::distance(std::sregex_iterator(html.begin(), html.end(), expression), std::sregex_iterator());
    };
    EXPECT_EQ(count(fmt::format("<{}[ >]", element)), count(fmt::format("</{}>", element))) << element;
  }
}

TEST(page, shows_every_method_and_escapes_what_comes_from_files) {
  const auto found = small_evaluation();
  const std::string html = page(found);
  for (const auto& method : found.methods) EXPECT_THAT(html, AllOf(HasSubstr(method.title), HasSubstr(method.id)));
  EXPECT_THAT(html,
              AllOf(HasSubstr("made &lt;by&gt; the test"), HasSubstr("--only &lt;x&gt;"), Not(HasSubstr("<by>"))));
}

TEST(page, says_who_wins_by_the_figures) {
  // Every method's defined pixels are right, so the first with any wins by accuracy, and the last, which has most, by
  // the pixels that are wrong or missing.
  const auto found = small_evaluation();
  const std::string html = page(found);
  std::vector<const method*> finals;
  for (const auto& method : found.methods) {
    if (method.final) finals.push_back(&method);
  }
  EXPECT_THAT(html, HasSubstr(fmt::format("Highest accuracy: <b>{}</b> on 1 of 1 (Tsukuba)", finals.front()->title)));
  EXPECT_THAT(html, HasSubstr("Fewest pixels wrong or missing: <b>OpenCV StereoSGBM, 8 paths</b> on 1 of 1 (Tsukuba)"));
}

TEST(page, reports_missing_pairs_and_failed_maps_at_the_top_and_in_their_place) {
  auto found = small_evaluation();
  EXPECT_TRUE(found.complete());
  EXPECT_THAT(page(found), Not(HasSubstr("Not everything could be evaluated")));
  found.pairs[0].methods[1] = {};
  found.pairs[0].methods[1].failure = "the model is stuck";
  EXPECT_FALSE(found.complete());
  EXPECT_THAT(page(found),
              AllOf(HasSubstr("Not everything could be evaluated"), HasSubstr("failed: the model is stuck")));
  found = small_evaluation();
  found.pairs.push_back({});
  found.pairs.back().entry.scene = "gone";
  found.pairs.back().failure = "no folder 'gone'";
  EXPECT_FALSE(found.complete());
  EXPECT_THAT(page(found), AllOf(HasSubstr("Not everything could be evaluated"),
                                 HasSubstr("Not evaluated: no folder 'gone'"), HasSubstr("id=\"pair-gone\"")));
}

TEST(page, calls_a_synthetic_pair_synthetic_wherever_it_stands) {
  auto found = small_evaluation();
  EXPECT_THAT(page(found), Not(HasSubstr("synthetic</a>")));
  found.pairs.push_back(tiny_pair("corridor", found.methods.size()));
  found.pairs.back().synthetic = true;
  EXPECT_THAT(page(found), AllOf(HasSubstr(">Corridor (synthetic)</h2>"), HasSubstr("ours: synthetic</a></th>")));
  EXPECT_THAT(page(found), AllOf(HasSubstr("on 1 of 1 (Tsukuba)"), Not(HasSubstr("Corridor (synthetic))"))));
}

TEST(page, says_where_there_is_no_mask) {
  EXPECT_THAT(page(small_evaluation()), HasSubstr("no mask, and no truth of the right image to derive one from"));
}

TEST(page, has_the_papers_tables_and_says_how_to_measure_what_is_not_measured) {
  const std::string html = page(small_evaluation());
  EXPECT_THAT(html, AllOf(HasSubstr("89 / 92"), HasSubstr("99 / 93"), HasSubstr("1&#8239;713"), HasSubstr("0.061"),
                          HasSubstr("scripts/frame_rates.py"), HasSubstr("cannot be true")));
  const timings timing = {
      {"color_fuzzy", {150, "an <estimate>", "counted by hand", {{{640, 480}, 80, 300000}, {{320, 240}, 80, 75000}}}}};
  const std::string timed = page(small_evaluation(), timing);
  EXPECT_THAT(timed, AllOf(HasSubstr("<td>500</td>"), HasSubstr("<td>2&#8239;000</td>"),
                           HasSubstr("an &lt;estimate&gt;"), HasSubstr("counted by hand")));
  // Rates proportional to 1 / pixels: 1.536e8 * pixels^-1.
  EXPECT_THAT(timed, HasSubstr("1.54 &middot; 10<sup>8</sup> &middot; (w&sup2;)<sup>-1.000</sup>"));
}

TEST(evaluation_json, has_the_figures_of_every_method_and_the_papers_values) {
  auto found = small_evaluation();
  found.pairs[0].methods[2] = {};
  found.pairs[0].methods[2].failure = "stuck";
  const auto json = evaluation_json({found, {}, "1.2.3", "epiline evaluate"});
  EXPECT_EQ(json["schema"], "epiline-evaluation/1");
  EXPECT_EQ(json["engine"], "native");
  EXPECT_EQ(json["complete"], false);
  EXPECT_EQ(json["methods"].size(), found.methods.size());
  const auto& methods = json["pairs"][0]["methods"];
  ASSERT_EQ(methods.size(), found.methods.size());
  EXPECT_EQ(methods[found.methods[3].id]["defined"], 3);
  EXPECT_EQ(methods[found.methods[3].id]["coverage"], 37.5);
  EXPECT_EQ(methods[found.methods[3].id]["bad_1_or_undefined"], 62.5);
  EXPECT_EQ(methods[found.methods[2].id]["failure"], "stuck");
  EXPECT_TRUE(json["pairs"][0]["non_occluded_mask"].is_null());
  EXPECT_EQ(json["paper"]["accuracy"][3]["printed"]["cones"]["accuracy"], 99);
  EXPECT_TRUE(json["paper"]["accuracy"][1]["printed"]["venus"]["coverage"].is_null());
  EXPECT_EQ(json["paper"]["membership_error"].size(), 5u);
}

TEST(evaluation_csv, has_a_line_for_every_map_and_a_column_for_every_figure) {
  auto found = small_evaluation();
  found.pairs[0].methods[0] = {};
  found.pairs[0].methods[0].failure = "stuck, \"badly\"";
  const std::string csv = evaluation_csv(found);
  EXPECT_EQ(std::ranges::count(csv, '\n'), static_cast<std::ptrdiff_t>(1 + found.methods.size()));
  EXPECT_THAT(csv, testing::StartsWith("scene,method,levels,pixels,defined,coverage,known,"));
  EXPECT_THAT(csv, HasSubstr(fmt::format("\"tsukuba\",\"{}\",16,8,3,37.5,8,3,3,100.0,", found.methods[3].id)));
  EXPECT_THAT(csv, HasSubstr("\"stuck, \"\"badly\"\"\""));
  // Every line has as many fields as the head.
  const std::string head = csv.substr(0, csv.find('\n'));
  const std::size_t last = csv.rfind('\n', csv.size() - 2) + 1;
  EXPECT_EQ(std::ranges::count(head, ','), std::count(csv.begin() + static_cast<std::ptrdiff_t>(last), csv.end(), ','));
}

TEST(html, escapes_and_sets_numbers) {
  EXPECT_EQ(escaped("a<b> & \"c\""), "a&lt;b&gt; &amp; &quot;c&quot;");
  EXPECT_EQ(number(1234567, 0), "1&#8239;234&#8239;567");
  EXPECT_EQ(number(123456.75, 1), "123&#8239;456.8");
  EXPECT_EQ(number(999, 0), "999");
  EXPECT_EQ(number(-1234, 0), "-1&#8239;234");
}

}  // namespace
}  // namespace epiline::report
