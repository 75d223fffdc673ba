// What counts as equal: a level may neither say something else, nor less than it has to, nor more than there is.
#include "check/answer.hpp"

#include <gmock/gmock.h>

namespace epiline::check {
namespace {

using testing::HasSubstr;

/// One process that reads `in` and writes `out`, both with the fields data (8 bits) and last (1 bit).
dataflow::network small_network() {
  dataflow::graph g;
  g.name = "top";
  for (const bool input : {true, false})
    g.ports.push_back({.name = input ? "in" : "out",
                       .kind = dataflow::port_kind::stream,
                       .input = input,
                       .width = 9,
                       .fields = {{"data", "tdata", 8, 0}, {"last", "tlast", 1, 8}},
                       .where = {}});
  return dataflow::network_of(std::move(g));
}

token_list tokens(std::initializer_list<unsigned> values) {
  token_list list;
  for (const unsigned value : values) list.emplace_back(9, value);
  return list;
}

answer native(const token_list& out, ending end, std::uint64_t done) {
  answer a;
  a.outputs = {{}, out};
  a.done = {0, done};
  a.end = end;
  return a;
}

std::string difference_of(const answer& native_run, tolerance how, const token_list& found) {
  const dataflow::network n = small_network();
  return compare(n, make_reference(n, native_run, {{}, {}}, how), {{}, found}).text;
}

TEST(answer, names_the_first_token_that_differs) {
  const answer run = native(tokens({1, 0x102, 3}), ending::boundary, 3);
  EXPECT_EQ(difference_of(run, tolerance::none, tokens({1, 0x102, 3})), "");
  EXPECT_EQ(difference_of(run, tolerance::none, tokens({1, 2, 4})),
            "output 'out': token 1 of 3 is tdata=2 tlast=0, native tdata=2 tlast=1");
}

TEST(answer, says_what_lacks_and_what_is_too_many) {
  const answer run = native(tokens({1, 2, 3}), ending::boundary, 3);
  EXPECT_THAT(difference_of(run, tolerance::iteration, tokens({1, 2})), HasSubstr("2 tokens, native 3"));
  EXPECT_THAT(difference_of(run, tolerance::iteration, tokens({1, 2, 3, 4})), HasSubstr("first too many is tdata=4"));
}

TEST(answer, allows_an_iteration_not_to_take_place_when_a_call_lacks_a_token) {
  const answer run = native(tokens({1, 2, 3}), ending::blocked, 0);
  EXPECT_EQ(difference_of(run, tolerance::iteration, tokens({1, 2})), "");
  EXPECT_NE(difference_of(run, tolerance::iteration, tokens({1})), "");
  EXPECT_NE(difference_of(run, tolerance::none, tokens({1, 2})), "");
}

TEST(answer, lets_a_run_without_end_go_on_but_not_stop) {
  const answer run = native(tokens({1, 2}), ending::endless, 2);
  EXPECT_EQ(difference_of(run, tolerance::none, tokens({1, 2, 7})), "");
  EXPECT_NE(difference_of(run, tolerance::none, tokens({1})), "");
}

TEST(answer, asks_processes_for_the_calls_that_came_to_their_end) {
  dataflow::network n = small_network();
  n.fifos.push_back({"between", 8, 2, {}});  // no single graph any more
  const reference wanted =
      make_reference(n, native(tokens({1, 2, 3}), ending::blocked, 1), {{}, {}}, tolerance::iteration);
  EXPECT_EQ(compare(n, wanted, {{}, tokens({1})}).text, "");
  EXPECT_EQ(compare(n, wanted, {{}, tokens({1, 2, 3, 4})}).text, "");
  EXPECT_NE(compare(n, wanted, {{}, tokens({})}).text, "");
  EXPECT_NE(compare(n, wanted, {{}, tokens({1, 3})}).text, "");
}

TEST(answer, writes_numbers_without_leading_zeros) {
  EXPECT_EQ(to_hexadecimal(llvm::APInt(100, 0)), "0");
  EXPECT_EQ(to_hexadecimal(llvm::APInt(100, 0xabc).shl(64)), "abc0000000000000000");
}

}  // namespace
}  // namespace epiline::check
