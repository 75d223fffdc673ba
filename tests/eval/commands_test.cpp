// The commands with engines of the test's own: what happens when an engine is wrong or fails.

#include "eval/commands.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "eval/scratch_folder.hpp"

namespace epiline::eval {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

/// Answers "disparity 3" everywhere; `damage` may change the map.
class constant_engine final : public engine {
 public:
  explicit constant_engine(std::function<void(match_result&, const run_options&)> damage)
      : damage_(std::move(damage)) {}
  match_result match(const match_request& request, const run_options& options) override {
    match_result result;
    result.map = disparity_map(request.left.width, request.left.height);
    std::ranges::fill(result.map.disparity, std::uint8_t{3});
    std::ranges::fill(result.map.defined, std::uint8_t{1});
    result.seconds = 0.5;
    damage_(result, options);
    return result;
  }

 private:
  std::function<void(match_result&, const run_options&)> damage_;
};

class commands : public testing::Test {
 protected:
  commands() {
    cv::imwrite(folder_ / "image.png", cv::Mat(5, 8, CV_8UC3, cv::Scalar(1, 2, 3)));
    add("right", [](auto&, auto&) {});
    add("wrong", [](auto& result, auto&) {
      result.map.disparity[8 * 2 + 6] = 4;
      result.map.defined[8 * 4] = 0;
    });
    add("failing", [](auto&, auto&) { throw engine_error("the model is stuck at beat 7"); });
    add("counting", [this](auto& result, const run_options& options) {
      result.cycles = 80;
      seen_ = options;
    });
  }

  void add(const std::string& name, std::function<void(match_result&, const run_options&)> damage) {
    registry_.add({"color_fuzzy", name, "",
                   [damage](const design_description&) { return std::make_unique<constant_engine>(damage); }});
  }

  /// Runs `epiline ARGUMENTS image.png image.png`; returns the exit code and what was printed.
  std::pair<int, std::string> run(const std::string& arguments) {
    CLI::App application;
    int exit_code = 0;
    add_match_command(application, registry_);
    add_compare_command(application, registry_, exit_code);
    testing::internal::CaptureStdout();
    try {
      application.parse(arguments + " " + (folder_ / "image.png") + " " + (folder_ / "image.png"));
    } catch (...) {
      (void)testing::internal::GetCapturedStdout();
      throw;
    }
    return {exit_code, testing::internal::GetCapturedStdout()};
  }

  test::scratch_folder folder_;
  engine_registry registry_;
  run_options seen_;
};

TEST_F(commands, compare_reports_how_many_pixels_differ_and_where_the_first_is) {
  const auto [exit_code, text] = run("compare --engines right,wrong --json " + (folder_ / "c.json"));
  EXPECT_EQ(exit_code, 1);
  EXPECT_THAT(text, HasSubstr("wrong differs from right in 2 of 40 pixels, first at column 6, row 2"));
  EXPECT_THAT(text, HasSubstr("right, wrong: NOT identical, 40 pixels compared, 2 differing"));
  const auto figures = nlohmann::json::parse(test::read_file(folder_ / "c.json"));
  EXPECT_EQ(figures["identical"], false);
  EXPECT_EQ(figures["differing"], 2);
  EXPECT_EQ(figures["engines"]["wrong"]["differing"], 2);
}

TEST_F(commands, an_engines_failure_leaves_no_output) {
  for (const char* command : {"match --engine failing", "compare --engines right,failing"}) {
    EXPECT_THAT([&] { run(std::string(command) + " -o " + (folder_ / "m.pfm") + " --json " + (folder_ / "f.json")); },
                ThrowsMessage<engine_error>("the model is stuck at beat 7"));
    EXPECT_EQ(folder_.contents(), std::set<std::string>{"image.png"});
  }
}

TEST_F(commands, match_hands_the_run_options_on_and_reports_cycles) {
  const auto [exit_code, text] =
      run("match --engine counting --seed 9 --input-gaps 25 --output-stalls 50 --json " + (folder_ / "f.json"));
  EXPECT_EQ(exit_code, 0);
  EXPECT_EQ(seen_.seed, 9u);
  EXPECT_EQ(seen_.input_gap_percent, 25);
  EXPECT_EQ(seen_.output_stall_percent, 50);
  EXPECT_THAT(text, HasSubstr("80 clocks (2.0000 a pixel"));
  const auto figures = nlohmann::json::parse(test::read_file(folder_ / "f.json"));
  EXPECT_EQ(figures["cycles"], 80);
  EXPECT_EQ(figures["cycles_per_pixel"], 2.0);
  EXPECT_EQ(figures["cycles_per_second"], 160.0);
  EXPECT_EQ(figures["input_gap_percent"], 25);
}

}  // namespace
}  // namespace epiline::eval
