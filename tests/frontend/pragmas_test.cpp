// #pragma HLS lines: calls where they are honoured, nothing where the flow does the same anyway, a note where they have
// no effect, and a refusal with file and line for all else.

#include "frontend/pragmas.hpp"

#include <gmock/gmock.h>

#include "small_module.hpp"

namespace epiline::frontend {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// What stands where `line` stood, in line 8 of top.cpp.
std::string rewritten(const std::string& line, std::vector<std::string>* notes = nullptr) {
  const pragma_rewrite result = rewrite_pragmas("# 7 \"top.cpp\"\nbefore();\n" + line + "\nafter();\n");
  if (notes != nullptr) *notes = result.notes;
  // The declarations of the calls behind a marker of theirs, the marker, before(), and the line itself.
  std::vector<std::string> lines;
  std::string rest = result.source;
  for (std::size_t end; (end = rest.find('\n')) != std::string::npos; rest.erase(0, end + 1)) {
    lines.push_back(rest.substr(0, end));
  }
  EXPECT_EQ(lines.size(), 6u) << "lines must stay where they are";
  EXPECT_EQ(lines.at(3), "before();");
  EXPECT_EQ(lines.at(5), "after();");
  return lines.at(4);
}

TEST(pragmas, that_are_honoured_become_calls) {
  const std::pair<const char*, const char*> cases[] = {
      {"#pragma HLS PIPELINE", "__epiline_pragma_pipeline(1);"},
      {"#pragma HLS PIPELINE II=3", "__epiline_pragma_pipeline(3);"},
      {"  #pragma  hls  pipeline ii = 2 ", "__epiline_pragma_pipeline(2);"},
      {"#pragma HLS PIPELINE off", ""},
      {"#pragma HLS UNROLL", "__epiline_pragma_unroll(0);"},
      {"#pragma HLS UNROLL factor=4 skip_exit_check", "__epiline_pragma_unroll(4);"},
      {"#pragma HLS ARRAY_PARTITION variable=x complete", "__epiline_partition(x, 1);"},
      {"#pragma HLS array_partition variable = x.y type=complete dim = 2", "__epiline_partition(x.y, 2);"},
      {"#pragma HLS DEPENDENCE variable=ram inter false", "__epiline_pragma_dependence((const void*)&(ram), 1);"},
      {"#pragma HLS DEPENDENCE variable=ram type=inter dependent=false",
       "__epiline_pragma_dependence((const void*)&(ram), 1);"},
      {"#pragma HLS DEPENDENCE variable=ram type=inter distance=4 true",
       "__epiline_pragma_dependence((const void*)&(ram), 4);"},
      {"#pragma HLS DEPENDENCE variable=ram type=inter distance=shortest true",
       "__epiline_pragma_dependence((const void*)&(ram), shortest);"},
      {"#pragma HLS DEPENDENCE variable=ram intra false", ""},
      {"#pragma HLS RESET variable=x off", "__epiline_pragma_reset((const void*)&(x));"},
      {"#pragma HLS reset variable=x", "(void)sizeof(x);"},
      {"#pragma HLS DATAFLOW", "__epiline_pragma_dataflow();"},
      {"#pragma HLS dataflow disable_start_propagation", "__epiline_pragma_dataflow();"},
      {"#pragma HLS STREAM variable = fifo depth = 16", "__epiline_pragma_stream((const void*)&(fifo), 16);"},
      {"#pragma HLS STREAM variable=fifo type=pipo", "__epiline_pragma_stream((const void*)&(fifo), 0);"},
      {"#pragma HLS UNROLL off", ""},
      // No code comes of it; clang says when there is no such parameter.
      {"#pragma HLS INTERFACE axis port=x", "(void)sizeof(x);"},
      // Lists speak of each of their names.
      {"#pragma HLS INTERFACE axis port = x, y", "(void)sizeof(x);(void)sizeof(y);"},
      {"#pragma HLS INTERFACE axis port=x ,return", "(void)sizeof(x);"},
      {"#pragma HLS ARRAY_PARTITION variable=x,t<1, 2>::y complete dim=0",
       "__epiline_partition(x, 0);__epiline_partition(t<1,2>::y, 0);"},
  };
  for (const auto& [line, call] : cases) EXPECT_EQ(rewritten(line), call) << line;
}

TEST(pragmas, that_ask_for_what_happens_anyway_vanish_without_a_word) {
  for (const char* line : {"#pragma HLS INLINE", "#pragma HLS LOOP_TRIPCOUNT min=1 max=9",
                           "#pragma HLS INTERFACE ap_ctrl_none port=return", "#pragma HLS LATENCY max=3"}) {
    std::vector<std::string> notes;
    EXPECT_EQ(rewritten(line, &notes), "") << line;
    EXPECT_THAT(notes, IsEmpty()) << line;
  }
}

TEST(pragmas, that_have_no_effect_leave_a_note_with_file_and_line) {
  std::vector<std::string> notes;
  EXPECT_EQ(rewritten("#pragma HLS BIND_STORAGE variable=x type=ram_2p", &notes), "");
  EXPECT_THAT(notes,
              ElementsAre("top.cpp:8: note: #pragma HLS BIND_STORAGE has no effect: the flow chooses this itself"));
}

TEST(pragmas, that_ask_for_banks_say_what_becomes_of_them) {
  std::vector<std::string> notes;
  EXPECT_EQ(rewritten("#pragma HLS ARRAY_PARTITION variable=x cyclic factor=2 dim=2", &notes),
            "__epiline_banks<2, 64>(x);");
  EXPECT_THAT(notes, ElementsAre(HasSubstr("top.cpp:8: note: ARRAY_PARTITION cyclic/block of 'x': a dimension of up to "
                                           "64 elements is taken apart as by 'complete'")));
}

TEST(pragmas, that_cannot_be_honoured_are_refused_with_file_and_line) {
  const std::pair<const char*, const char*> cases[] = {
      {"#pragma HLS STREAM depth=4", "STREAM without variable=NAME"},
      {"#pragma HLS INTERFACE m_axi port=x", "#pragma HLS INTERFACE m_axi: only stream and scalar interfaces"},
      {"#pragma HLS INTERFACE mode=bram port=x", "#pragma HLS INTERFACE bram: only stream and scalar interfaces"},
      {"#pragma HLS DEPENDENCE inter false", "DEPENDENCE without variable=NAME"},
      {"#pragma HLS ARRAY_PARTITION complete", "ARRAY_PARTITION without variable=NAME"},
      {"#pragma HLS PIPELYNE", "#pragma HLS PIPELYNE: not known: did you mean PIPELINE?"},
      {"#pragma HLS SOMETHING", "#pragma HLS SOMETHING: not known: remove it"},
      {"#pragma HLS", "#pragma HLS without a name"},
      {"#pragma HLS PIPELINE II=0", "PIPELINE II=0: give a number from 1 on"},
      {"#pragma HLS PIPELINE II=", "PIPELINE II=: give a number from 1 on"},
      {"#pragma HLS PIPELINE II=99999999999", "II=99999999999: give a number from 1 on"},
      {"#pragma HLS PIPELINE interval=2", "the option 'interval' is not known: it takes ii, off"},
      {"#pragma HLS ARRAY_PARTITION variable=x dim=-1", "DIM=-1: give a number from 0 on"},
      {"#pragma HLS ARRAY_PARTITION variable=x cyclic factor=0", "FACTOR=0: give a number from 1 on"},
      {"#pragma HLS ARRAY_PARTITION variable=x type=all", "type=all: it is complete, cyclic or block"},
      {"#pragma HLS DEPENDENCE variable=x inter distance=0", "DISTANCE=0: give a number from 1 on"},
      {"#pragma HLS INTERFACE port=x", "INTERFACE without a mode"},
      {"#pragma HLS INTERFACE axis port=x, ,y", "#pragma HLS INTERFACE: a name is missing in 'x,,y'"},
      {"#pragma HLS STREAM variable=x, depth=4", "#pragma HLS STREAM: a name is missing in"},
  };
  for (const auto& [line, words] : cases) {
    const std::string refusal = refusal_of([&] { static_cast<void>(rewritten(line)); });
    EXPECT_THAT(refusal, testing::StartsWith("top.cpp:8: error: ")) << line;
    EXPECT_THAT(refusal, HasSubstr(words)) << line;
  }
}

TEST(pragmas, of_others_and_text_that_looks_like_one_stay) {
  for (const char* line : {"#pragma once", "#pragma GCC unroll 4", "// #pragma HLS NONSENSE", "int pragma_HLS;"}) {
    EXPECT_EQ(rewritten(line), line);
  }
}

TEST(pragmas, are_counted_by_the_markers_of_their_file) {
  const std::string refusal = refusal_of([] {
    static_cast<void>(
        rewrite_pragmas("# 1 \"top.cpp\"\n# 1 \"kernel.hpp\" 1\na;\nb;\n#pragma HLS NONSENSE\n# 2 \"top.cpp\" 2\n"));
  });
  EXPECT_THAT(refusal, testing::StartsWith("kernel.hpp:3: error: "));
  const std::string after = refusal_of([] {
    static_cast<void>(rewrite_pragmas("# 1 \"kernel.hpp\" 1\na;\n# 41 \"top.cpp\" 2\nb;\n#pragma HLS NONSENSE\n"));
  });
  EXPECT_THAT(after, testing::StartsWith("top.cpp:42: error: "));
}

}  // namespace
}  // namespace epiline::frontend
