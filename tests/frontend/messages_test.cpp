// Clang's messages in the user's terms: his file and line, without wrappers, headers of the flow and words of
// compilers.

#include "frontend/messages.hpp"

#include <gtest/gtest.h>

namespace epiline::frontend {
namespace {

TEST(messages, keep_line_text_and_excerpt_and_lose_the_rest) {
  EXPECT_EQ(explain_messages("In file included from /tmp/epiline-hls-1/wrapper.cpp:1:\n"
                             "/k/fir.cpp:5:23: error: expected ';' after expression [-Wsomething]\n"
                             "    5 |   f()\n      |      ^\n1 error generated.\n",
                             {}),
            "/k/fir.cpp:5: error: expected ';' after expression\n    5 |   f()\n      |      ^");
}

TEST(messages, say_what_to_do) {
  EXPECT_EQ(explain_messages("/k/fir.cpp:1:10: fatal error: 'hls_streamofblocks.h' file not found\n", {}),
            "/k/fir.cpp:1: error: 'hls_streamofblocks.h' file not found: streams of blocks and memory bursts are not "
            "supported: use functions over hls::stream");
  EXPECT_EQ(explain_messages("/k/fir.cpp:1:10: fatal error: 'other.h' file not found\n", {}),
            "/k/fir.cpp:1: error: 'other.h' file not found: name its folder with -I");
}

TEST(messages, of_a_header_of_the_flow_are_told_at_the_users_line) {
  EXPECT_EQ(explain_messages(
                "/usr/include/thing.h:3:1: error: static assertion failed due to requirement '0 > 0': too small\n"
                "    3 |   static_assert\n"
                "/usr/include/other.h:9:1: note: in instantiation of template class 'a' requested here\n"
                "/k/fir.cpp:7:16: note: in instantiation of member function 'b' requested here\n"
                "    7 |   thing<0> x;\n"
                "/k/fir.cpp:7:13: error: no viable conversion\n",
                {}),
            "/k/fir.cpp:7: error: too small\n    7 |   thing<0> x;");
}

TEST(messages, of_a_call_that_stands_for_a_pragma_speak_of_the_pragma) {
  const pragma_places places = {{{"/k/fir.cpp", 6}, "ARRAY_PARTITION"}};
  EXPECT_EQ(explain_messages("/k/fir.cpp:6:43: error: use of undeclared identifier 'tabs'; did you mean 'taps'?\n"
                             "    6 | __epiline_pragma_partition((const void*)&(tabs), 1);\n",
                             places),
            "/k/fir.cpp:6: error: #pragma HLS ARRAY_PARTITION: there is no variable 'tabs' here; did you mean 'taps'?");
  EXPECT_NE(explain_messages("/k/fir.cpp:6:1: error: a type specifier is required for all declarations\n", places)
                .find("stands outside of a function"),
            std::string::npos);
}

TEST(messages, end_after_ten_errors) {
  std::string many;
  for (int i = 1; i <= 30; ++i) many += "/k/fir.cpp:" + std::to_string(i) + ":1: error: wrong\n";
  const std::string told = explain_messages(many, {});
  EXPECT_NE(told.find("fir.cpp:10: error"), std::string::npos);
  EXPECT_EQ(told.find("fir.cpp:11: error"), std::string::npos);
}

TEST(messages, without_an_error_are_passed_on) {
  EXPECT_EQ(explain_messages("something strange\n", {}), "error: the source does not compile:\nsomething strange");
}

TEST(explain_top, tells_what_the_name_is) {
  const auto listing = [](const std::string& name, const std::string& declaration) {
    return "Dumping " + name + ":\n" + declaration + "\n`-More\n\n";
  };
  const std::string function = "FunctionDecl 0x55f0 <k.cpp:3:1, col:11> col:6 f 'void (int)'";
  const std::string other = "FunctionDecl 0x55f8 <k.cpp:4:1, col:11> col:6 f 'void (char)'";
  const std::pair<std::string, const char*> cases[] = {
      {listing("f", function) + listing("f", other), "k.cpp:4: error: 'f' is overloaded"},
      {listing("f", "FunctionTemplateDecl 0x1 <k.cpp:1:1, line:2:3> line:2:6 f"), "k.cpp:1: error: 'f' is a template"},
      {listing("f", "FunctionDecl 0x1 <k.cpp:3:1, col:9> col:5 f 'int *(int)'"),
       "k.cpp:3: error: 'f' returns a pointer or reference"},
      {listing("f", "FunctionDecl 0x1 <k.cpp:3:1, col:9> col:5 f 'void (int, ...)'"),
       "k.cpp:3: error: 'f' takes a variable number of arguments"},
      {listing("f", "VarDecl 0x1 <k.cpp:5:1, col:9> col:5 f 'int'"), "k.cpp:5: error: 'f' is a variable"},
      {listing("f", "CXXRecordDecl 0x1 <k.cpp:5:1, col:9> col:8 struct f definition"), "k.cpp:5: error: 'f' is a type"},
      {listing("s::f", "CXXMethodDecl 0x1 <k.cpp:1:12, col:22> col:17 f 'void (int)'"),
       "k.cpp:1: error: 'f' is a member function"},
      {listing("n::f", function), "k.cpp:3: error: 'f' is in a namespace: name it with that, --top n::f"},
      {listing("ff", function), "dir/k.cpp: error: there is no function 'f' in this file"},
      {"", "dir/k.cpp: error: there is no function 'f' in this file"},
  };
  for (const auto& [text, words] : cases)
    EXPECT_EQ(explain_top("f", "dir/k.cpp", text).rfind(words, 0), 0u) << explain_top("f", "dir/k.cpp", text);
}

}  // namespace
}  // namespace epiline::frontend
