// Other programs end in one of three ways, each of which is noticed, and get their words as they are.
#include "check/program.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <stdexcept>

namespace epiline::check {
namespace {

namespace fs = std::filesystem;

class program_test : public testing::Test {
 protected:
  program_test() : folder_(fs::temp_directory_path() / ("epiline_program_test_" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
  }
  ~program_test() override { fs::remove_all(folder_); }
  [[nodiscard]] std::string log() const {
    std::ifstream in(folder_ / "log");
    return {std::istreambuf_iterator<char>(in), {}};
  }
  fs::path folder_;
};

TEST_F(program_test, gives_words_to_the_program_and_not_to_a_shell) {
  const std::string word = "a b; $(touch hurt) 'quoted' > file";
  EXPECT_EQ(run_program({*find_program("printf"), "%s", word}, folder_, "log", 10), program_end::succeeded);
  EXPECT_EQ(log(), word);
  EXPECT_FALSE(fs::exists(folder_ / "hurt"));
}

TEST_F(program_test, runs_in_the_folder_and_notices_failure) {
  EXPECT_EQ(run_program({*find_program("sh"), "-c", "pwd; exit 3"}, folder_, "log", 10), program_end::failed);
  EXPECT_EQ(log(), fs::canonical(folder_).string() + "\n");
}

TEST_F(program_test, ends_a_program_and_what_it_started_after_the_time) {
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(run_program({*find_program("sh"), "-c", "sleep 100 & sleep 100"}, folder_, "log", 1),
            program_end::timed_out);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(50));
}

TEST_F(program_test, says_that_there_is_no_such_program) {
  EXPECT_FALSE(find_program("epiline-no-such-program"));
  EXPECT_THROW(run_program({"/nowhere/epiline-no-such-program"}, folder_, "log", 1), std::runtime_error);
}

TEST_F(program_test, finds_the_lines_that_say_what_went_wrong) {
  std::ofstream(folder_ / "log") << "first\nx.v:3: syntax error\nlast\n";
  EXPECT_EQ(what_went_wrong(folder_ / "log"), "x.v:3: syntax error");
  std::ofstream(folder_ / "log") << "first\nlast\n";
  EXPECT_EQ(what_went_wrong(folder_ / "log"), "first; last");
  EXPECT_EQ(what_went_wrong(folder_ / "none"), "it says nothing");
}

}  // namespace
}  // namespace epiline::check
