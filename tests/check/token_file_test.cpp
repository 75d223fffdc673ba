// Token files are read as they are documented, and every mistake in one is named with its line.
#include "check/token_file.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include <fstream>
#include <stdexcept>

namespace epiline::check {
namespace {

namespace fs = std::filesystem;

dataflow::network small_network() {
  dataflow::graph g;
  g.name = "top";
  g.ports.push_back(
      {"in", dataflow::port_kind::stream, true, 70, {{"data", "tdata", 69, 0}, {"last", "tlast", 1, 69}}, {}});
  g.ports.push_back({"call", dataflow::port_kind::call, true, 12, {{"width", "width", 12, 0}}, {}});
  g.ports.push_back({"out", dataflow::port_kind::stream, false, 8, {{"data", "tdata", 8, 0}}, {}});
  return dataflow::network_of(std::move(g));
}

class token_file_test : public testing::Test {
 protected:
  token_file_test() : file_(fs::temp_directory_path() / ("epiline_tokens_" + std::to_string(getpid()))) {}
  ~token_file_test() override { fs::remove(file_); }
  token_file read(const std::string& text) {
    std::ofstream(file_) << text;
    return read_token_file(file_, network_);
  }
  /// What is said about a text, without the file's name.
  std::string refusal(const std::string& text) {
    try {
      (void)read(text);
    } catch (const std::invalid_argument& error) {
      const std::string all = error.what();
      return all.starts_with(file_.string()) ? all.substr(file_.string().size()) : all;
    }
    return "it was read";
  }
  fs::path file_;
  dataflow::network network_ = small_network();
};

TEST_F(token_file_test, reads_what_it_writes) {
  const std::string text =
      "port in input stream tdata:69 tlast:1\n"
      "token 100000000000000002 1\n"
      "token 000000000000000000 0\n"
      "port call input call width:12\n"
      "token 0ff\n";
  const token_file file = read(text);
  ASSERT_EQ(file.tokens[0].size(), 2u);
  EXPECT_EQ(file.tokens[0][0], llvm::APInt(70, 1).shl(69) | llvm::APInt(70, 1).shl(68) | llvm::APInt(70, 2));
  EXPECT_EQ(file.tokens[1][0], llvm::APInt(12, 0xff));
  EXPECT_FALSE(file.given[2]);
  EXPECT_EQ(to_text(file, network_), text);
}

TEST_F(token_file_test, takes_comments_signals_in_any_order_and_short_numbers) {
  const token_file file = read("# a comment\n\nport in input stream tlast:1 tdata:69  # too\ntoken 1 0xA\n");
  EXPECT_EQ(file.tokens[0].at(0), llvm::APInt(70, 1).shl(69) | llvm::APInt(70, 10));
}

TEST_F(token_file_test, names_line_and_mistake) {
  EXPECT_EQ(refusal("port input\n"), ":1: error: the top has no port 'input': it has in, call, out");
  EXPECT_EQ(refusal("\nport in output stream tdata:69 tlast:1\n"),
            ":2: error: this port is 'port in input stream tdata:69 tlast:1' in the top");
  EXPECT_EQ(refusal("port in input stream tdata:68 tlast:1\n"),
            ":1: error: this port is 'port in input stream tdata:69 tlast:1' in the top");
  EXPECT_EQ(refusal("port in input stream tdata:69 tdata:69\n"),
            ":1: error: this port is 'port in input stream tdata:69 tlast:1' in the top");
  EXPECT_EQ(refusal("port out output stream tdata:8\nport out output stream tdata:8\n"),
            ":2: error: the port 'out' stands here for the second time");
  EXPECT_EQ(refusal("token 1\n"), ":1: error: a token before the first port: write a line 'port ...' above it");
  EXPECT_EQ(refusal("port out output stream tdata:8\ntoken 1 2\n"),
            ":2: error: 2 numbers for the 1 signals of port 'out'");
  EXPECT_EQ(refusal("port out output stream tdata:8\ntoken 1g\n"), ":2: error: '1g' is not a hexadecimal number");
  EXPECT_EQ(refusal("port out output stream tdata:8\ntoken 100\n"),
            ":2: error: '100' has more than the 8 bits of tdata");
  EXPECT_EQ(
      refusal("ports\n"),
      ":1: error: 'ports' begins no line of a token file: write 'port NAME input stream SIGNAL:WIDTH ...' or 'token "
      "HEXADECIMAL ...'");
}

TEST_F(token_file_test, says_that_there_is_no_file) {
  EXPECT_THROW((void)read_token_file("/nowhere/x.tokens", network_), std::invalid_argument);
  EXPECT_THROW((void)read_token_file("/tmp", network_), std::invalid_argument);
}

}  // namespace
}  // namespace epiline::check
