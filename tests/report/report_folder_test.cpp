#include "report/report_folder.hpp"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <filesystem>

#include "eval/output_file.hpp"
#include "eval/scratch_folder.hpp"

namespace epiline::report {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;
namespace fs = std::filesystem;

const std::map<std::string, std::string> files = {
    {"index.html", "<p>"}, {"figures.json", R"({"schema": "epiline-evaluation/1"})"}, {"figures.csv", "a\n"}};

class report_folder : public testing::Test {
 protected:
  /// Both functions refuse and change nothing.
  void expect_refusal(const std::string& folder, const std::string& part) {
    const auto refuses = ThrowsMessage<eval::file_error>(testing::AllOf(HasSubstr(folder), HasSubstr(part)));
    EXPECT_THAT([&] { require_report_folder(folder); }, refuses);
    EXPECT_THAT([&] { write_report_folder(folder, files); }, refuses);
  }
  test::scratch_folder scratch_;
};

TEST_F(report_folder, is_made_with_all_files_and_readable_for_others) {
  const auto folder = scratch_ / "report";
  require_report_folder(folder);
  EXPECT_FALSE(fs::exists(folder));
  write_report_folder(folder + "/", files);  // a slash at the end is how people write folders
  EXPECT_EQ(test::read_file(folder + "/index.html"), "<p>");
  EXPECT_EQ(test::read_file(folder + "/figures.csv"), "a\n");
  EXPECT_THAT(scratch_.contents(), ElementsAre("report"));
  struct stat status{};
  ASSERT_EQ(::stat(folder.c_str(), &status), 0);
  const mode_t mask = ::umask(0);
  ::umask(mask);
  EXPECT_EQ(status.st_mode & 0777, 0777 & ~mask);
}

TEST_F(report_folder, replaces_an_earlier_report_and_an_empty_folder) {
  const auto folder = scratch_ / "report";
  fs::create_directory(folder);
  write_report_folder(folder, files);
  auto second = files;
  second["index.html"] = "<h1>";
  write_report_folder(folder, second);
  EXPECT_EQ(test::read_file(folder + "/index.html"), "<h1>");
  EXPECT_THAT(scratch_.contents(), ElementsAre("report"));
}

TEST_F(report_folder, never_destroys_what_is_not_a_report) {
  const auto foreign = scratch_ / "thesis";
  fs::create_directory(foreign);
  test::write_file(foreign + "/chapter1.tex", "years of work");
  expect_refusal(foreign, "chapter1.tex");
  EXPECT_EQ(test::read_file(foreign + "/chapter1.tex"), "years of work");

  const auto site = scratch_ / "site";  // somebody else's page
  fs::create_directory(site);
  test::write_file(site + "/index.html", "<p>home");
  expect_refusal(site, "figures.json");
  EXPECT_EQ(test::read_file(site + "/index.html"), "<p>home");

  test::write_file(scratch_ / "file", "x");
  expect_refusal(scratch_ / "file", "it is a file");
  EXPECT_THAT(scratch_.contents(), ElementsAre("file", "site", "thesis"));
}

TEST_F(report_folder, names_a_folder_above_that_is_missing) {
  expect_refusal(scratch_ / "missing/report", "No such file");
}

TEST_F(report_folder, follows_a_link_to_the_folder) {
  fs::create_directory(scratch_ / "real");
  fs::create_directory_symlink(scratch_ / "real", scratch_ / "link");
  write_report_folder(scratch_ / "link", files);
  EXPECT_TRUE(fs::is_symlink(scratch_ / "link"));
  EXPECT_EQ(test::read_file(scratch_ / "real/index.html"), "<p>");
}

}  // namespace
}  // namespace epiline::report
