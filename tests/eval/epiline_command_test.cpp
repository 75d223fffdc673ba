// The `epiline` command as a user runs it: messages, exit codes, and that no output file is ever left half written.

#include <gmock/gmock.h>
#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <random>

#include "eval/image_files.hpp"
#include "eval/random_images.hpp"
#include "eval/scratch_folder.hpp"
#include "scenes/render.hpp"

namespace epiline::eval {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

struct outcome {
  int exit_code = -1;
  std::string output;
  std::string errors;
};

/// A folder with a stereo pair: left.png, right.png (60x20).
class epiline_command : public testing::Test {
 protected:
  epiline_command() {
    std::mt19937 random(21);
    pair_ = test::random_pair(random, 60, 20, 9, 256);
    write_picture("left.png", pair_.left);
    write_picture("right.png", pair_.right);
  }

  void write_picture(const std::string& name, const rgb_image& image) const {
    cv::Mat picture(image.height, image.width, CV_8UC3);
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        const auto* pixel = image.at(x, y);
        picture.at<cv::Vec3b>(y, x) = cv::Vec3b(pixel[2], pixel[1], pixel[0]);
      }
    }
    cv::imwrite(folder_ / name, picture);
  }

  /// Runs `epiline ARGUMENTS` in the folder.
  outcome run(const std::string& arguments) const {
    const std::string command = "cd '" + (folder_ / ".") + "' && '" EPILINE_PROGRAM "' " + arguments + " >'" +
                                out_.string() + "' 2>'" + err_.string() + "'";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, test::read_file(out_), test::read_file(err_)};
  }

  /// Expects failure with one line on standard error that contains the parts, and no new file.
  template <class... Part>
  void expect_error(const std::string& arguments, const Part&... parts) const {
    SCOPED_TRACE("epiline " + arguments);
    const auto before = folder_.contents();
    const outcome result = run(arguments);
    EXPECT_THAT(result.exit_code, testing::AnyOf(1, 2));
    EXPECT_THAT(result.errors, AllOf(StartsWith("epiline: error: "), HasSubstr(parts)...));
    EXPECT_EQ(std::ranges::count(result.errors, '\n'), 1) << result.errors;
    EXPECT_EQ(result.output, "");
    EXPECT_EQ(folder_.contents(), before);
  }

  test::scratch_folder folder_;
  test::image_pair pair_;

 private:
  test::scratch_folder logs_;
  std::filesystem::path out_ = logs_ / "out";
  std::filesystem::path err_ = logs_ / "err";
};

// ---- what it does
// ------------------------------------------------------------------------------------------------------

TEST_F(epiline_command, match_writes_one_map_in_three_formats_that_agree) {
  for (const char* name : {"m.pfm", "m.png", "m.pgm"}) {
    const auto result =
        run(std::string("match --design color_fuzzy --engine native left.png right.png --levels 10 -o ") + name);
    ASSERT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_EQ(result.errors, "");
    EXPECT_THAT(result.output, HasSubstr("coverage"));
  }
  const auto real = parse_pfm(test::read_file(folder_ / "m.pfm"), "m.pfm");
  const cv::Mat deep = cv::imread(folder_ / "m.png", cv::IMREAD_UNCHANGED);
  const cv::Mat shallow = cv::imread(folder_ / "m.pgm", cv::IMREAD_UNCHANGED);
  ASSERT_EQ(real.width, 60);
  ASSERT_EQ(real.height, 20);
  ASSERT_EQ(deep.type(), CV_16UC1);
  ASSERT_EQ(shallow.type(), CV_8UC1);
  int defined = 0;
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 60; ++x) {
      const double value = real.values[static_cast<std::size_t>(60 * y + x)];
      defined += std::isfinite(value) ? 1 : 0;
      EXPECT_EQ(shallow.at<std::uint8_t>(y, x), std::isfinite(value) ? value : 255);
      EXPECT_EQ(deep.at<std::uint16_t>(y, x), std::isfinite(value) ? std::max(256 * value, 1.0) : 0);
    }
  }
  EXPECT_GT(defined, 100);
  EXPECT_LT(defined, 1200);
}

TEST_F(epiline_command, every_engine_writes_the_same_bytes) {
  ASSERT_EQ(run("match --engine golden left.png right.png --levels 10 -o golden.pfm").exit_code, 0);
  ASSERT_EQ(run("match --engine native left.png right.png --levels 10 -o native.pfm").exit_code, 0);
  EXPECT_EQ(test::read_file(folder_ / "golden.pfm"), test::read_file(folder_ / "native.pfm"));
}

TEST_F(epiline_command, match_obeys_set_and_levels) {
  const auto map_with = [&](const std::string& arguments) {
    const auto result = run("match left.png right.png -o m.pgm " + arguments);
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    return test::read_file(folder_ / "m.pgm");
  };
  const std::string standard = map_with("--levels 10");
  const std::string raw = map_with("--levels 10 --set left_right=0 --set uniqueness=0 --set fuzzy=0");
  EXPECT_EQ(raw.find('\xff'), std::string::npos);  // every pixel gets a winner
  EXPECT_NE(raw, standard);
  EXPECT_NE(map_with("--levels 10 --set careful_fill=1"), standard);
  EXPECT_EQ(map_with("--levels 10 --set fuzzy=0 --set fuzzy=2"), standard);  // the last one counts
  const std::string one_level = map_with("--levels 1 --set left_right=0 --set uniqueness=0 --set fuzzy=0");
  EXPECT_EQ(one_level.find_first_not_of('\0', one_level.find("255\n") + 4), std::string::npos);
}

TEST_F(epiline_command, match_writes_figures_and_picture) {
  const auto result =
      run("match left.png right.png --engine golden --levels 10 --set uniqueness=20 --json f.json --picture p.png "
          "--seed 7");
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const auto figures = nlohmann::json::parse(test::read_file(folder_ / "f.json"));
  EXPECT_EQ(figures["design"], "color_fuzzy");
  EXPECT_EQ(figures["engine"], "golden");
  EXPECT_EQ(figures["width"], 60);
  EXPECT_EQ(figures["height"], 20);
  EXPECT_EQ(figures["levels"], 10);
  EXPECT_EQ(figures["seed"], 7);
  EXPECT_EQ(figures["pixels"], 1200);
  EXPECT_EQ(figures["parameters"],
            (nlohmann::json{{"left_right", 1}, {"uniqueness", 20}, {"fuzzy", 2}, {"careful_fill", 0}}));
  EXPECT_GT(figures["seconds"], 0);
  EXPECT_NEAR(figures["coverage"].get<double>(), figures["defined"].get<double>() / 12, 1e-9);
  EXPECT_FALSE(figures.contains("accuracy"));
  EXPECT_FALSE(figures.contains("cycles"));
  EXPECT_EQ(cv::imread(folder_ / "p.png", cv::IMREAD_UNCHANGED).size(), cv::Size(60, 20));
  EXPECT_EQ(folder_.contents(), (std::set<std::string>{"left.png", "right.png", "f.json", "p.png"}));
}

TEST_F(epiline_command, match_adds_accuracy_when_truth_is_given) {
  // The truth is the map itself, one too large in the first column: every defined pixel is correct.
  ASSERT_EQ(run("match left.png right.png --levels 10 -o map.pgm --json plain.json").exit_code, 0);
  cv::Mat truth = cv::imread(folder_ / "map.pgm", cv::IMREAD_UNCHANGED);
  int known = 0;
  int known_left_half = 0;
  int off_by_one = 0;
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 60; ++x) {
      auto& value = truth.at<std::uint8_t>(y, x);
      value = static_cast<std::uint8_t>(value == 255 ? 0 : 4 * (value + (x == 9 ? 1 : 0)));
      known += value != 0 ? 1 : 0;
      known_left_half += value != 0 && x < 30 ? 1 : 0;
      off_by_one += value != 0 && x == 9 ? 1 : 0;
    }
  }
  ASSERT_GT(off_by_one, 0);
  cv::imwrite(folder_ / "truth.png", truth);
  cv::Mat mask(20, 60, CV_8UC1, cv::Scalar(255));
  mask.colRange(30, 60).setTo(128);
  cv::imwrite(folder_ / "mask.png", mask);
  ASSERT_EQ(run("match left.png right.png --levels 10 --truth truth.png --truth-scale 4 --mask-nonocc mask.png "
                "--mask-disc mask.png --json f.json")
                .exit_code,
            0);
  const auto figures = nlohmann::json::parse(test::read_file(folder_ / "f.json"));
  EXPECT_EQ(figures["known"], known);
  EXPECT_EQ(figures["known_and_defined"], known);
  EXPECT_EQ(figures["correct"], known);
  EXPECT_EQ(figures["accuracy"], 100.0);
  EXPECT_NEAR(figures["bad_0.5"].get<double>(), 100.0 * off_by_one / known, 1e-9);
  EXPECT_NEAR(figures["average_error"].get<double>(), 1.0 * off_by_one / known, 1e-9);
  EXPECT_EQ(figures["nonocc_known"], known_left_half);
  EXPECT_EQ(figures["nonocc_accuracy"], 100.0);
  EXPECT_EQ(figures["disc_known"], known_left_half);
  EXPECT_EQ(figures["disc_accuracy"], 100.0);
  ASSERT_EQ(run("match left.png right.png --levels 10 --truth truth.png --truth-scale 4 --mask mask.png --json g.json")
                .exit_code,
            0);
  EXPECT_EQ(nlohmann::json::parse(test::read_file(folder_ / "g.json"))["known"], known_left_half);
}

TEST_F(epiline_command, compare_finds_native_and_golden_identical) {
  const auto result = run("compare --engines golden,native left.png right.png --levels 10 --json c.json -o m.pfm");
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_THAT(result.output, HasSubstr("golden = native: bit-identical, 1200 pixels compared, 0 differing"));
  const auto figures = nlohmann::json::parse(test::read_file(folder_ / "c.json"));
  EXPECT_EQ(figures["identical"], true);
  EXPECT_EQ(figures["differing"], 0);
  EXPECT_GT(figures["engines"]["native"]["seconds"], 0);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "m.pfm"));
}

TEST_F(epiline_command, lists_designs_parameters_and_engines) {
  for (const char* command : {"match --list", "compare --list"}) {
    const auto result = run(command);
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_THAT(result.output, AllOf(HasSubstr("color_fuzzy"), HasSubstr("uniqueness"), HasSubstr("0 to 31"),
                                     HasSubstr("default 17"), HasSubstr("golden"), HasSubstr("native")));
  }
}

TEST_F(epiline_command, has_help_and_version) {
  EXPECT_THAT(run("--help").output, AllOf(HasSubstr("match"), HasSubstr("compare")));
  EXPECT_THAT(run("match --help").output, AllOf(HasSubstr("--truth-scale"), HasSubstr("--set")));
  EXPECT_EQ(run("--version").exit_code, 0);
  EXPECT_THAT(run("--version").output, testing::MatchesRegex("[0-9]+\\.[0-9]+\\.[0-9]+\n"));
}

TEST_F(epiline_command, renders_a_scene_that_match_can_measure) {
  const auto result =
      run("scene steps -o made/steps --width 96 --height 40 --levels 24 --seed 7 --noise 1.5 --gain 1.1 "
          "--offset -3 --misalignment 0.5");
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_THAT(result.output, AllOf(HasSubstr("steps 96x40, 24 levels"), HasSubstr("made/steps")));
  const auto pair = scenes::render("steps", {.width = 96,
                                             .height = 40,
                                             .levels = 24,
                                             .seed = 7,
                                             .noise = 1.5,
                                             .gain = 1.1,
                                             .offset = -3,
                                             .misalignment = 0.5});
  for (const auto& [side, view] : {std::pair{"left", &pair.left}, {"right", &pair.right}}) {
    const std::string name = side;
    EXPECT_EQ(read_stereo_image(folder_ / ("made/steps/" + name + ".png")).pixels, view->image.pixels);
    EXPECT_EQ(read_truth(folder_ / ("made/steps/disp_" + name + ".pfm")).values, view->disparity.values);
    EXPECT_EQ(read_mask(folder_ / ("made/steps/mask_nonocc_" + name + ".png")).selected, view->visible.selected);
  }
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_ / "made/steps"), {}), 6);

  const auto measured =
      run("match made/steps/left.png made/steps/right.png --levels 24 --truth made/steps/disp_left.pfm "
          "--mask-nonocc made/steps/mask_nonocc_left.png --json figures.json");
  EXPECT_EQ(measured.exit_code, 0) << measured.errors;
  EXPECT_GT(nlohmann::json::parse(test::read_file(folder_ / "figures.json"))["accuracy"], 50);
  // Again into the same folder: replaced.
  EXPECT_EQ(run("scene steps -o made/steps --width 8 --height 8").exit_code, 0);
  EXPECT_EQ(read_stereo_image(folder_ / "made/steps/left.png").width, 8);
}

TEST_F(epiline_command, lists_scenes) {
  const auto result = run("scene --list");
  EXPECT_EQ(result.exit_code, 0);
  for (const auto& scene : scenes::all_scenes()) EXPECT_THAT(result.output, HasSubstr(std::string(scene.name)));
}

TEST_F(epiline_command, refuses_bad_scenes) {
  expect_error("scene corridr -o new", "unknown scene 'corridr'", "did you mean corridor?");
  expect_error("scene tunnel -o new", "unknown scene 'tunnel'", "scenes: corridor, slanted");
  expect_error("scene -o new", "name a scene", "--list");
  expect_error("scene corridor", "-o FOLDER");
  expect_error("scene corridor -o new --width 0", "width is 0", "1 to 4096");
  expect_error("scene corridor -o new --height 5000", "height is 5000", "1 to 4096");
  expect_error("scene corridor -o new --levels 1", "levels is 1", "2 to 256");
  expect_error("scene corridor -o new --noise -1", "noise is -1", "0 to 64");
  expect_error("scene corridor -o new --gain nan", "gain is nan", "0.1 to 10");
  expect_error("scene corridor -o new --offset 300", "offset is 300", "-255 to 255");
  expect_error("scene corridor -o new --misalignment 17", "misalignment is 17", "-16 to 16");
  expect_error("scene corridor -o new --noise much", "--noise", "much");
  expect_error("scene corridor -o new --seed -1", "--seed", "-1");
  expect_error("scene corridor steps -o new", "steps");
  expect_error("scene corridor -o left.png", "left.png", "folder");
  expect_error("scene corridor -o /proc/new", "/proc/new", "choose a folder");
}

// ---- bad input
// ---------------------------------------------------------------------------------------------------------

TEST_F(epiline_command, refuses_bad_images) {
  expect_error("match none.png right.png -o m.pfm", "none.png", "No such file or directory");
  expect_error("match left.png none.png -o m.pfm", "none.png", "No such file or directory");
  cv::imwrite(folder_ / "deep.png", cv::Mat(20, 60, CV_16UC3, cv::Scalar(1, 2, 3)));
  expect_error("match left.png deep.png -o m.pfm", "deep.png", "16 bits");
  test::write_file(folder_ / "cut.png", test::read_file(folder_ / "left.png").substr(0, 900));
  expect_error("match cut.png right.png -o m.pfm", "cut.png", "cut short");
  cv::imwrite(folder_ / "whole.jpg", cv::imread(folder_ / "left.png"));
  test::write_file(folder_ / "cut.jpg", test::read_file(folder_ / "whole.jpg").substr(0, 1500));
  expect_error("match cut.jpg right.png -o m.pfm", "cut.jpg", "cut short");
  cv::imwrite(folder_ / "small.png", cv::Mat(20, 59, CV_8UC3, cv::Scalar(1, 2, 3)));
  expect_error("match left.png small.png -o m.pfm", "left is 60x20", "right is 59x20");
  cv::imwrite(folder_ / "wide.png", cv::Mat(2, 1025, CV_8UC3, cv::Scalar(1, 2, 3)));
  expect_error("match wide.png wide.png -o m.pfm", "1025x2", "at most 1024");
  expect_error("match left.png -o m.pfm", "two images");
}

TEST_F(epiline_command, refuses_bad_names_and_values) {
  expect_error("match --design color_fuzy left.png right.png", "unknown design 'color_fuzy'",
               "did you mean color_fuzzy?");
  expect_error("match --design stereo left.png right.png", "unknown design 'stereo'", "designs: color_fuzzy");
  expect_error("match --engine goldn left.png right.png", "no engine 'goldn'", "did you mean golden?", "native");
  expect_error("match left.png right.png --set uniquenes=17", "'uniquenes'", "did you mean uniqueness?");
  expect_error("match left.png right.png --set threshold=17", "'threshold'",
               "left_right, uniqueness, fuzzy, careful_fill");
  expect_error("match left.png right.png --set uniqueness=32", "uniqueness is 32", "0 to 31");
  expect_error("match left.png right.png --set fuzzy=-1", "fuzzy is -1", "0 to 2");
  expect_error("match left.png right.png --set fuzzy", "--set fuzzy", "NAME=VALUE");
  expect_error("match left.png right.png --set =2", "NAME=VALUE");
  expect_error("match left.png right.png --set fuzzy=two", "'two' is not an integer");
  expect_error("match left.png right.png --set fuzzy=1.5", "'1.5' is not an integer");
  expect_error("match left.png right.png --set fuzzy=", "'' is not an integer");
  expect_error("match left.png right.png --set fuzzy=99999999999", "is not an integer");
  expect_error("match left.png right.png --levels 0", "levels is 0", "1 to 80");
  expect_error("match left.png right.png --levels -5", "levels is -5", "1 to 80");
  expect_error("match left.png right.png --levels 81", "levels is 81", "1 to 80");
  expect_error("match left.png right.png --levels many", "--levels");
  expect_error("match left.png right.png --input-gaps 96", "--input-gaps");
  expect_error("match left.png right.png --output-stalls -1", "--output-stalls");
  expect_error("match left.png right.png --seed -1", "--seed", "-1");
  expect_error("match left.png right.png third.png", "third.png");
  expect_error("match left.png right.png --unknown", "--unknown");
  expect_error("compare left.png right.png --engines golden", "two names or more");
  expect_error("compare left.png right.png --engines golden,other", "no engine 'other'");
  expect_error("", "subcommand");
  expect_error("mach left.png right.png", "unknown command 'mach'", "did you mean match?");
}

TEST_F(epiline_command, refuses_outputs_it_cannot_write_before_it_reads_an_image) {
  // The images are missing too: the output is what is named.
  expect_error("match none.png none.png -o no/such/folder/m.pfm", "no/such/folder/m.pfm", "No such file or directory");
  expect_error("match none.png none.png --json no/f.json", "no/f.json", "No such file or directory");
  expect_error("match none.png none.png --picture no/p.png", "no/p.png", "No such file or directory");
  expect_error("match none.png none.png -o left.png/m.pfm", "left.png/m.pfm", "Not a directory");
  expect_error("match none.png none.png -o m.jpg", "m.jpg", ".pfm");
  expect_error("match none.png none.png --picture p.ppm", "p.ppm", ".png");
  expect_error("match none.png none.png --json .", "Is a directory");
  expect_error("match none.png none.png -o m.png --picture ./m.png", "m.png", "two outputs");
}

TEST_F(epiline_command, keeps_an_existing_output_when_it_fails) {
  test::write_file(folder_ / "m.pfm", "precious");
  expect_error("match left.png none.png -o m.pfm", "none.png");
  EXPECT_EQ(test::read_file(folder_ / "m.pfm"), "precious");
}

TEST_F(epiline_command, reports_a_full_disk) {
  const auto result = run("match left.png right.png --levels 4 --json /dev/full");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.errors, AllOf(HasSubstr("/dev/full"), HasSubstr("No space left on device")));
}

TEST_F(epiline_command, refuses_truth_that_does_not_fit) {
  cv::imwrite(folder_ / "small.png", cv::Mat(19, 60, CV_8UC1, cv::Scalar(255)));
  cv::imwrite(folder_ / "truth.png", cv::Mat(20, 60, CV_8UC1, cv::Scalar(40)));
  expect_error("match left.png right.png -o m.pfm --truth small.png", "small.png is 60x19", "60x20");
  expect_error("match left.png right.png -o m.pfm --truth truth.png --mask small.png", "small.png is 60x19");
  expect_error("match left.png right.png -o m.pfm --truth truth.png --mask-nonocc small.png", "small.png is 60x19");
  expect_error("match left.png right.png -o m.pfm --truth truth.png --mask-disc small.png", "small.png is 60x19");
  expect_error("match left.png right.png -o m.pfm --mask-disc small.png", "--truth", "missing");
  expect_error("match left.png right.png -o m.pfm --truth none.pfm", "none.pfm", "No such file");
  expect_error("match left.png right.png -o m.pfm --truth truth.png --truth-scale 0", "not above 0");
  expect_error("match left.png right.png -o m.pfm --mask small.png", "--truth", "missing");
  expect_error("match left.png right.png -o m.pfm --truth-scale 4", "--truth", "missing");
}

/// With a list of two pairs, "a" and "b", whose truth is 3 everywhere.
class epiline_evaluate : public epiline_command {
 protected:
  epiline_evaluate() {
    for (const char* scene : {"a", "b"}) {
      std::filesystem::create_directory(folder_ / scene);
      for (const char* name : {"left.png", "right.png"}) {
        std::filesystem::copy_file(folder_ / name, folder_ / (std::string(scene) + "/" + name));
      }
      cv::imwrite(folder_ / (std::string(scene) + "/disp_left.png"), cv::Mat(20, 60, CV_8UC1, cv::Scalar(12)));
    }
    test::write_file(folder_ / "pairs.json", "[" + entry("a") + ", " + entry("b") + "]");
  }

  static std::string entry(const std::string& scene) {
    return R"({"scene": ")" + scene +
           R"(", "levels": 12, "truth_scale": 4, "files": {"left.png": "0", "right.png": "0", "disp_left.png": "0"}})";
  }

  nlohmann::json figures(const std::string& report = "report") const {
    return nlohmann::json::parse(test::read_file(folder_ / (report + "/figures.json")));
  }
};

TEST_F(epiline_evaluate, writes_a_page_and_figures_that_match_gives_too) {
  const auto result = run("evaluate --design all --pairs pairs.json -o report -j 2");
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(result.errors, "");
  EXPECT_THAT(result.output, AllOf(HasSubstr("a 60x20, 12 levels"), HasSubstr("report/index.html")));
  const auto page = test::read_file(folder_ / "report/index.html");
  EXPECT_THAT(page, AllOf(StartsWith("<!DOCTYPE html>"), HasSubstr("Corridor (synthetic)"), HasSubstr("</html>")));
  const auto report = figures();
  EXPECT_EQ(report["complete"], true);
  ASSERT_EQ(report["pairs"].size(), 3u);
  EXPECT_EQ(report["pairs"][2]["synthetic"], true);

  ASSERT_EQ(run("match --design color_fuzzy left.png right.png --levels 12 --set fuzzy=0 --truth a/disp_left.png "
                "--truth-scale 4 --json match.json")
                .exit_code,
            0);
  const auto match = nlohmann::json::parse(test::read_file(folder_ / "match.json"));
  const auto& same = report["pairs"][0]["methods"]["color_fuzzy-confident"];
  for (const char* figure : {"pixels", "defined", "coverage", "known", "correct", "accuracy", "bad_0.5", "bad_1",
                             "bad_2", "bad_1_or_undefined", "average_error"}) {
    EXPECT_EQ(same[figure], match[figure]) << figure;
  }
}

TEST_F(epiline_evaluate, gives_the_same_on_one_core_and_with_another_engine) {
  ASSERT_EQ(run("evaluate --pairs pairs.json -o one -j 1 --only a").exit_code, 0);
  ASSERT_EQ(run("evaluate --pairs pairs.json -o many -j 3 --only a").exit_code, 0);
  ASSERT_EQ(run("evaluate --pairs pairs.json -o golden --engine golden --only a").exit_code, 0);
  const auto without_time = [&](const std::string& report) {
    auto pairs = figures(report)["pairs"];
    for (auto& pair : pairs) {
      for (auto& method : pair["methods"]) method.erase("seconds");
    }
    return pairs;
  };
  EXPECT_EQ(without_time("one").size(), 1u);
  EXPECT_EQ(without_time("one"), without_time("many"));
  EXPECT_EQ(without_time("one"), without_time("golden"));
}

TEST_F(epiline_evaluate, evaluates_the_others_when_a_pair_is_missing_or_broken) {
  std::filesystem::remove_all(folder_ / "a");
  cv::imwrite(folder_ / "b/disp_left.png", cv::Mat(20, 61, CV_8UC1, cv::Scalar(12)));
  const auto result = run("evaluate --design color_fuzzy --pairs pairs.json -o report");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.output, AllOf(HasSubstr("a: not evaluated: no folder 'a'"), HasSubstr("b: not evaluated"),
                                   HasSubstr("61x20"), HasSubstr("corridor 384x288")));
  EXPECT_THAT(test::read_file(folder_ / "report/index.html"),
              AllOf(HasSubstr("Not everything could be evaluated"), HasSubstr("61x20")));
  EXPECT_EQ(figures()["complete"], false);
  EXPECT_EQ(figures()["pairs"][0]["missing"], true);
  EXPECT_TRUE(figures()["pairs"][2].contains("methods"));

  EXPECT_EQ(run("evaluate --design color_fuzzy --pairs pairs.json -o report --only a --skip-missing").exit_code, 0);
  EXPECT_EQ(run("evaluate --design color_fuzzy --pairs pairs.json -o report --only a --only corridor").exit_code, 1);
}

TEST_F(epiline_evaluate, reports_a_map_that_cannot_be_computed) {
  // The list allows 128 levels, the designs have 80.
  auto list = test::read_file(folder_ / "pairs.json");
  list.replace(list.find("12"), 2, "99");
  test::write_file(folder_ / "pairs.json", list);
  const auto result = run("evaluate --design color_fuzzy --pairs pairs.json -o report --only a --only b");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.output, HasSubstr("failed: levels is 99, but design color_fuzzy takes 1 to 80"));
  EXPECT_TRUE(figures()["pairs"][0]["methods"]["opencv-stereobm"].contains("accuracy"));
  EXPECT_TRUE(figures()["pairs"][1]["methods"]["color_fuzzy-fis"].contains("accuracy"));
}

TEST_F(epiline_evaluate, refuses_wrong_usage_before_it_computes) {
  const std::string good = "evaluate --pairs pairs.json -o report ";
  expect_error("evaluate --pairs pairs.json", "--output");
  expect_error(good + "--design color_fuzy", "color_fuzy", "did you mean color_fuzzy");
  expect_error(good + "--design color_fuzzy,color_fuzzy", "twice");
  expect_error(good + "--engine nativ", "nativ", "did you mean native");
  expect_error(good + "--only c", "no pair 'c'", "a, b, corridor");
  expect_error(good + "-j 0", "--jobs", "1 to 256");
  expect_error(good + "--timing none.json", "none.json");
  expect_error("evaluate --pairs none.json -o report", "none.json");
  expect_error("evaluate --pairs pairs.json -o missing/report", "missing/report");
  expect_error("evaluate --pairs pairs.json -o a", "left.png", "would be lost");
  expect_error("evaluate --pairs pairs.json -o left.png", "it is a file");
  test::write_file(folder_ / "pairs.json", "[" + entry("a") + R"(, {"scene": "b", "levels": "many"}])");
  expect_error(good, "pairs.json", "[1].levels", "1 to 128");
}

TEST_F(epiline_evaluate, replaces_an_earlier_report_whole) {
  ASSERT_EQ(run("evaluate --design color_fuzzy --pairs pairs.json -o report --only a").exit_code, 0);
  ASSERT_EQ(run("evaluate --design color_fuzzy --pairs pairs.json -o report --only b").exit_code, 0);
  EXPECT_EQ(figures()["pairs"][0]["scene"], "b");
  EXPECT_THAT(folder_.contents(), Not(testing::Contains(StartsWith("."))));
}

}  // namespace
}  // namespace epiline::eval
