#include "eval/pair_list.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <opencv2/imgcodecs.hpp>
#include <random>

#include "eval/scratch_folder.hpp"

namespace epiline::eval {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;
namespace fs = std::filesystem;

constexpr int width = 60;
constexpr int height = 30;
constexpr int disparity = 5;

/// A list with the pair "step" in its folder: random texture at disparity 5, but the right half of the rows 10 to 19 at
/// 8. Truth as grey levels, 4 a pixel.
class pair_list : public testing::Test {
 protected:
  pair_list() {
    fs::create_directory(folder_ / "step");
    std::mt19937 random(9);
    cv::Mat left(height, width, CV_8UC3);
    for (auto pixel = left.begin<cv::Vec3b>(); pixel != left.end<cv::Vec3b>(); ++pixel) {
      for (int c = 0; c < 3; ++c) (*pixel)[c] = static_cast<std::uint8_t>(random() % 256);
    }
    cv::Mat right = left.clone();
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const int d = true_at(x, y);
        truth_.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(4 * d);
        if (x >= d) right.at<cv::Vec3b>(y, x - d) = left.at<cv::Vec3b>(y, x);
        if (x >= d)
          right_truth_.at<std::uint8_t>(y, x - d) =
              std::max<std::uint8_t>(right_truth_.at<std::uint8_t>(y, x - d), static_cast<std::uint8_t>(4 * d));
      }
    }
    cv::imwrite(folder_ / "step/left.png", left);
    cv::imwrite(folder_ / "step/right.png", right);
    cv::imwrite(folder_ / "step/disp_left.png", truth_);
  }

  static int true_at(int x, int y) { return x >= width / 2 && y >= 10 && y < 20 ? 8 : disparity; }

  std::string write_list(const std::string& text) {
    test::write_file(folder_ / "pairs.json", text);
    return folder_ / "pairs.json";
  }

  /// An entry as JSON; `from` in it is replaced.
  static std::string entry(const std::string& from = "", const std::string& to = "") {
    std::string text = R"({"scene": "step", "family": "test", "levels": 16, "truth_scale": 4, "files":
      {"left.png": "0", "right.png": "0", "disp_left.png": "0"}})";
    if (!from.empty()) text.replace(text.find(from), from.size(), to);
    return text;
  }

  stereo_pair load(const std::string& from = "", const std::string& to = "") {
    const auto list = write_list("[" + entry(from, to) + "]");
    return load_pair(read_pair_list(list).front(), {folder_ / ""});
  }

  template <class... Part>
  void expect_list_error(const std::string& text, const Part&... parts) {
    const auto list = write_list(text);
    EXPECT_THAT([&] { (void)read_pair_list(list); },
                ThrowsMessage<file_error>(AllOf(HasSubstr("pairs.json"), HasSubstr(parts)...)));
  }
  template <class... Part>
  void expect_pair_error(const std::string& from, const std::string& to, const Part&... parts) {
    EXPECT_THAT([&] { (void)load(from, to); }, ThrowsMessage<file_error>(AllOf(HasSubstr(parts)...)));
  }

  test::scratch_folder folder_;
  cv::Mat truth_ = cv::Mat(height, width, CV_8UC1);  // braces would make a list of three numbers
  cv::Mat right_truth_ = cv::Mat(height, width, CV_8UC1, cv::Scalar(0));
};

TEST_F(pair_list, reads_what_the_list_says) {
  const auto list =
      write_list("[" + entry() + R"(, {"scene": "b", "levels": 128, "truth_scale": null, "files": {"left.ppm": "1",
    "mask_disc.pgm": "2"}, "sources": {"mask_disc.pgm": {"url": "u", "convert": "pnm", "optional": true}, "left.ppm": {"package":
    "p", "path": "q", "member": "m"}}}])");
  const auto entries = read_pair_list(list);
  ASSERT_EQ(entries.size(), 2u);
  EXPECT_EQ(entries[0].scene, "step");
  EXPECT_EQ(entries[0].family, "test");
  EXPECT_EQ(entries[0].levels, 16);
  EXPECT_EQ(entries[0].truth_scale, 4);
  EXPECT_EQ(entries[0].files.size(), 3u);
  EXPECT_EQ(entries[1].levels, 128);
  EXPECT_FALSE(entries[1].truth_scale.has_value());
  EXPECT_THAT(entries[1].optional_files, testing::ElementsAre("mask_disc.pgm"));
}

TEST_F(pair_list, names_the_place_of_a_mistake) {
  const auto second = [&](const std::string& from, const std::string& to) {
    return R"([{"scene": "a", "levels": 1, "truth_scale": null, "files": {}}, )" + entry(from, to) + "]";
  };
  expect_list_error(second("16", "\"sixty\""), "[1].levels", "a whole number from 1 to 128", "\"sixty\"");
  expect_list_error(second("16", "129"), "[1].levels", "1 to 128", "129");
  expect_list_error(second("16", "0"), "[1].levels", "1 to 128");
  expect_list_error(second("16", "2.5"), "[1].levels", "2.5");
  expect_list_error(second("16", "99999999999999999999"), "[1].levels");
  expect_list_error(second("\"levels\"", "\"level\""), "[1].level:", "did you mean levels", "truth_scale");
  expect_list_error(second("\"truth_scale\": 4", "\"truth_scale\": -4"), "[1].truth_scale", "above 0");
  expect_list_error(second("\"truth_scale\": 4", "\"truth_scale\": \"4\""), "[1].truth_scale", "null for PFM");
  expect_list_error(second("\"truth_scale\": 4,", ""), "[1]", "truth_scale", "missing");
  expect_list_error(second("\"step\"", "7"), "[1].scene", "text");
  expect_list_error(second("\"step\"", "\"../secret\""), "[1].scene", "plain name");
  expect_list_error(second("\"step\"", "\"a\""), "[1].scene", "twice");
  expect_list_error(second("\"left.png\": \"0\"", "\"left.png\": 0"), "[1].files.left.png");
  expect_list_error(second("\"left.png\": \"0\"", "\"../left.png\": \"0\""), "[1].files", "plain name");
  expect_list_error(R"([{"scene": "a", "levels": 1, "truth_scale": null, "files": ["left.png"]}])", "[0].files");
  expect_list_error(R"([{"scene": "a", "levels": 1, "truth_scale": null, "files": {}, "sources": {"x": {"uri": ""}}}])",
                    "[0].sources.x.uri", "did you mean url");
  expect_list_error(
      R"([{"scene": "a", "levels": 1, "truth_scale": null, "files": {}, "sources": {"x": {"optional": 1}}}])",
      "[0].sources.x.optional", "true or false");
  expect_list_error("{}", "a list of one pair or more");
  expect_list_error("[]", "a list of one pair or more");
  expect_list_error("[3]", "[0]", "an object");
  expect_list_error("[{", "not valid JSON");
  EXPECT_THAT([&] { (void)read_pair_list(folder_ / "none.json"); }, ThrowsMessage<file_error>(HasSubstr("none.json")));
  EXPECT_THAT([&] { (void)read_pair_list(folder_ / "step"); }, ThrowsMessage<file_error>(HasSubstr("is a directory")));
}

TEST_F(pair_list, loads_a_pair_with_derived_masks) {
  const auto pair = load();
  EXPECT_EQ(pair.left.width, width);
  ASSERT_TRUE(pair.truth.has_value());
  EXPECT_EQ(pair.truth->disparity.values[0], disparity);
  EXPECT_EQ(pair.truth->disparity.values[12 * width + 40], 8);
  EXPECT_FALSE(pair.truth->evaluated.has_value());
  EXPECT_FALSE(pair.truth->non_occluded.has_value());  // there is nothing to tell it from
  EXPECT_EQ(pair.non_occluded_source, "");
  EXPECT_THAT(pair.near_discontinuity_source, HasSubstr("occluded pixels included"));
  EXPECT_TRUE(pair.truth->near_discontinuity->selected[12 * width + 30]);
  EXPECT_FALSE(pair.truth->near_discontinuity->selected[0]);
  EXPECT_TRUE(pair.notes.empty());

  cv::imwrite(folder_ / "step/disp_right.png", right_truth_);
  const auto seen = load();
  EXPECT_THAT(seen.non_occluded_source, HasSubstr("derived from the truth of both images"));
  EXPECT_FALSE(seen.truth->non_occluded->selected[0]);  // lies outside the right image
  EXPECT_TRUE(seen.truth->non_occluded->selected[10]);
  EXPECT_FALSE(seen.truth->non_occluded->selected[12 * width + 29]);  // hidden by the nearer half
  EXPECT_FALSE(seen.truth->near_discontinuity->selected[12 * width + 29]);
}

TEST_F(pair_list, prefers_the_data_sets_masks) {
  cv::Mat mask(height, width, CV_8UC1, cv::Scalar(0));
  mask.at<std::uint8_t>(2, 3) = 255;
  mask.at<std::uint8_t>(2, 4) = 128;  // occluded
  for (const char* name : {"mask_all", "mask_nonocc", "mask_disc"})
    cv::imwrite(folder_ / fmt::format("step/{}.png", name), mask);
  const auto pair = load();
  for (const auto& found : {pair.truth->evaluated, pair.truth->non_occluded, pair.truth->near_discontinuity}) {
    ASSERT_TRUE(found.has_value());
    EXPECT_EQ(std::ranges::count(found->selected, true), 1);
    EXPECT_TRUE(found->selected[2 * width + 3]);
  }
  EXPECT_THAT(pair.non_occluded_source, HasSubstr("data set's mask"));
  EXPECT_THAT(pair.near_discontinuity_source, HasSubstr("data set's mask"));
}

TEST_F(pair_list, finds_files_in_another_format_and_misses_those_that_are_promised) {
  EXPECT_NO_THROW((void)load("\"left.png\"", "\"left.ppm\""));  // left.png is there
  expect_pair_error("\"left.png\": \"0\"", "\"left.png\": \"0\", \"mask_nonocc.png\": \"0\"", "mask_nonocc.png",
                    "is missing", "fetch");
  fs::remove(folder_ / "step/right.png");
  expect_pair_error("", "", "right.png", "is missing");
  expect_pair_error("\"right.png\": \"0\",", "", "no right image");
}

TEST_F(pair_list, goes_without_optional_masks_and_without_truth) {
  const std::string sources = R"("family": "test", "sources": {"mask_all.pgm": {"optional": true}}, )";
  const auto list = write_list("[" + entry("\"family\": \"test\", ", sources) + "]");
  auto entries = read_pair_list(list);
  entries[0].files.emplace_back("mask_all.pgm");
  EXPECT_NO_THROW((void)load_pair(entries[0], {folder_ / ""}));
  fs::remove(folder_ / "step/disp_left.png");
  const auto pair = load(", \"disp_left.png\": \"0\"", "");
  EXPECT_FALSE(pair.truth.has_value());
  EXPECT_THAT(pair.notes, testing::ElementsAre(HasSubstr("no ground truth")));
}

TEST_F(pair_list, refuses_truth_masks_and_images_of_another_size) {
  const auto write_size = [&](const char* name, int columns, int rows, int type) {
    cv::imwrite(folder_ / fmt::format("step/{}.png", name), cv::Mat(rows, columns, type, cv::Scalar::all(255)));
  };
  const std::string size = fmt::format("{}x{}", width, height);
  write_size("mask_disc", width, height - 1, CV_8UC1);
  expect_pair_error("", "", "mask_disc.png", "60x29", size);
  write_size("disp_right", width + 1, height, CV_8UC1);
  expect_pair_error("", "", "disp_right.png", "61x30", size);
  write_size("mask_all", 1, 1, CV_8UC1);
  expect_pair_error("", "", "mask_all.png", "1x1", size);
  write_size("disp_left", height, width, CV_8UC1);
  expect_pair_error("", "", "disp_left.png", "30x60", size);
  write_size("right", width, height + 2, CV_8UC3);
  expect_pair_error("", "", "right.png", "60x32", size);
}

TEST_F(pair_list, refuses_truth_of_another_scale_than_stated) {
  for (const char* wrong : {"1", "2", "8", "16"}) {
    expect_pair_error("\"truth_scale\": 4", fmt::format("\"truth_scale\": {}", wrong), "disp_left.png", "does not fit",
                      fmt::format("truth_scale {}", wrong), "at scale 4");
  }
  expect_pair_error("\"truth_scale\": 4", "\"truth_scale\": null", "disp_left.png", "states no truth_scale");
}

TEST_F(pair_list, reads_pfm_in_either_byte_order_with_unknown_values) {
  fs::remove(folder_ / "step/disp_left.png");
  for (const bool little : {true, false}) {
    std::string bytes = fmt::format("Pf\n{} {}\n{}\n", width, height, little ? "-1.0" : "1.0");
    for (int y = height - 1; y >= 0; --y) {
      for (int x = 0; x < width; ++x) {
        const float value = x == 0 ? INFINITY : x == 1 ? NAN : x == 2 ? -INFINITY : static_cast<float>(true_at(x, y));
        std::uint32_t bits = 0;
        std::memcpy(&bits, &value, 4);
        for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<char>(bits >> (little ? 8 * i : 24 - 8 * i)));
      }
    }
    test::write_file(folder_ / "step/disp_left.pfm", bytes);
    const auto list = write_list("[" + entry("\"truth_scale\": 4", "\"truth_scale\": null") + "]");
    const auto pair = load_pair(read_pair_list(list).front(), {folder_ / ""});
    for (int x = 0; x < 3; ++x) EXPECT_TRUE(std::isnan(pair.truth->disparity.values[static_cast<std::size_t>(x)]));
    for (int x = 3; x < width; ++x)
      EXPECT_EQ(pair.truth->disparity.values[static_cast<std::size_t>(12 * width + x)], true_at(x, 12));
  }
  expect_pair_error("", "", "disp_left.pfm", "holds pixels", "truth_scale 4", "null");
}

TEST_F(pair_list, notes_truth_beyond_the_levels_and_truth_that_is_unknown) {
  EXPECT_THAT(load("\"levels\": 16", "\"levels\": 7").notes, testing::ElementsAre(HasSubstr("beyond the 7 levels")));
  EXPECT_TRUE(load("\"levels\": 16", "\"levels\": 8").notes.empty());  // 7 is within 1 of a truth of 8
  cv::imwrite(folder_ / "step/disp_left.png", cv::Mat(height, width, CV_8UC1, cv::Scalar(0)));
  EXPECT_THAT(load().notes, testing::ElementsAre(HasSubstr("unknown everywhere")));
}

TEST_F(pair_list, looks_in_the_folders_in_order) {
  const auto entry_of_list = read_pair_list(write_list("[" + entry() + "]")).front();
  EXPECT_NO_THROW((void)load_pair(entry_of_list, {folder_ / "nowhere", folder_ / ""}));
  EXPECT_THAT([&] { (void)load_pair(entry_of_list, {folder_ / "nowhere"}); },
              ThrowsMessage<missing_pair>(AllOf(HasSubstr("nowhere"), HasSubstr("fetch_data.py step"))));
  EXPECT_THAT(pair_folders("a/pairs.json", "given"), testing::ElementsAre(fs::path("given")));
  ::setenv("EPILINE_DATA", "/from/environment", 1);
  const auto folders = pair_folders("/project/data/pairs.json", "");
  ::unsetenv("EPILINE_DATA");
  EXPECT_THAT(folders, testing::ElementsAre(fs::path("/project/data"), fs::path("/from/environment"),
                                            fs::path("/shared/data"), fs::path("/project/data/downloads")));
}

}  // namespace
}  // namespace epiline::eval
