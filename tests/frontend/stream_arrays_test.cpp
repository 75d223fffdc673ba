// The sizes of a top's array parameters, read from the text: to the compiler they are pointers.
#include "frontend/stream_arrays.hpp"

#include <gmock/gmock.h>

namespace epiline::frontend {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::vector<std::string> sizes_of_array_parameters(const std::string& preprocessed, const std::string& top) {
  return frontend::sizes_of_array_parameters(preprocessed, std::vector<std::string>{top}).front();
}

TEST(stream_arrays, finds_the_sizes_of_the_definition) {
  EXPECT_THAT(sizes_of_array_parameters("void top(hls::stream<int> in[4]);\n"
                                        "void other() { top(x[7]); }\n"
                                        "# 12 \"k.cpp\"\n"
                                        "void top(hls::stream<pair<int, 3>> in[ N + (M > 2) ],\n"
                                        "# 99 \"k.cpp\" 2\n"
                                        "         s& out, int n, s (&r)[2], s matrix[2][3], s open[]) {\n",
                                        "space::top"),
              ElementsAre("N + (M > 2)", "", "", "", "2", ""));
}

TEST(stream_arrays, takes_no_other_functions_for_the_top) {
  EXPECT_THAT(sizes_of_array_parameters("void a_top(s x[2]) {} void top2(s x[3]) {} void top(s in[5]) {", "top"),
              ElementsAre("5"));
  EXPECT_THAT(sizes_of_array_parameters("void top(s in[5]);", "top"), IsEmpty());
  EXPECT_THAT(sizes_of_array_parameters("void top(s in[5", "top"), IsEmpty());
  EXPECT_THAT(sizes_of_array_parameters("", "top"), IsEmpty());
}

TEST(stream_arrays, counts_every_stream_as_a_parameter) {
  const std::map<unsigned, unsigned> arrays = {{1, 4}, {3, 2}};
  EXPECT_EQ(flat_index(arrays, 0), 0u);
  EXPECT_EQ(flat_index(arrays, 1), 1u);
  EXPECT_EQ(flat_index(arrays, 2), 5u);
  EXPECT_EQ(flat_index(arrays, 4), 8u);
}

}  // namespace
}  // namespace epiline::frontend
