#include "eval/output_file.hpp"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include "eval/scratch_folder.hpp"

namespace epiline::eval {
namespace {

using test::read_file;
using test::write_file;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(write_whole_file, writes_a_new_file_and_leaves_nothing_else) {
  const test::scratch_folder folder;
  write_whole_file(folder / "a", std::string("x\0y", 3));
  EXPECT_EQ(read_file(folder / "a"), std::string("x\0y", 3));
  EXPECT_EQ(folder.contents(), std::set<std::string>{"a"});
}

TEST(write_whole_file, replaces_a_file_and_keeps_its_mode) {
  const test::scratch_folder folder;
  write_file(folder / "a", "a longer text than the new one");
  ::chmod((folder / "a").c_str(), 0640);
  write_whole_file(folder / "a", "new");
  EXPECT_EQ(read_file(folder / "a"), "new");
  struct stat status{};
  ASSERT_EQ(::stat((folder / "a").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0640u);
}

TEST(write_whole_file, gives_a_new_file_the_mode_of_ordinary_files) {
  const test::scratch_folder folder;
  const mode_t mask = ::umask(022);
  write_whole_file(folder / "a", "x");
  ::umask(mask);
  struct stat status{};
  ASSERT_EQ(::stat((folder / "a").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0644u);
}

TEST(write_whole_file, follows_a_link) {
  const test::scratch_folder folder;
  write_file(folder / "target", "old");
  std::filesystem::create_symlink(folder / "target", folder / "link");
  write_whole_file(folder / "link", "new");
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
  EXPECT_EQ(read_file(folder / "target"), "new");
}

TEST(write_whole_file, writes_to_a_device_without_replacing_it) {
  write_whole_file("/dev/null", "x");
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(write_whole_file, names_the_file_and_the_reason_of_a_failure) {
  const test::scratch_folder folder;
  EXPECT_THAT([&] { write_whole_file(folder / "none/a", "x"); },
              ThrowsMessage<file_error>(testing::AllOf(HasSubstr("none/a"), HasSubstr("No such file or directory"))));
  EXPECT_TRUE(folder.contents().empty());
}

TEST(write_whole_file, reports_a_full_disk) {
  EXPECT_THAT([] { write_whole_file("/dev/full", "x"); },
              ThrowsMessage<file_error>(HasSubstr("No space left on device")));
}

TEST(require_writable, accepts_a_possible_file_and_leaves_no_trace) {
  const test::scratch_folder folder;
  EXPECT_NO_THROW(require_writable(folder / "a"));
  EXPECT_NO_THROW(require_writable("/dev/null"));
  EXPECT_TRUE(folder.contents().empty());
}

TEST(require_writable, refuses_a_missing_folder_a_folder_and_a_file_used_as_a_folder) {
  const test::scratch_folder folder;
  write_file(folder / "file", "x");
  EXPECT_THAT([&] { require_writable(folder / "none/a"); },
              ThrowsMessage<file_error>(HasSubstr("No such file or directory")));
  EXPECT_THAT([&] { require_writable(folder / "."); }, ThrowsMessage<file_error>(HasSubstr("Is a directory")));
  EXPECT_THAT([&] { require_writable(folder / "file/a"); }, ThrowsMessage<file_error>(HasSubstr("Not a directory")));
}

}  // namespace
}  // namespace epiline::eval
