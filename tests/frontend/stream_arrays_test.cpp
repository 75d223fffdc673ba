// A top's array parameters, read from the text: to the compiler they are pointers.
#include "frontend/stream_arrays.hpp"

#include <gmock/gmock.h>

namespace epiline::frontend {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::vector<array_parameter> parameters_of(const std::string& preprocessed, const std::string& top) {
  return find_array_parameters(preprocessed, {top}).front();
}

std::vector<std::string> sizes_of_array_parameters(const std::string& preprocessed, const std::string& top) {
  std::vector<std::string> sizes;
  for (const array_parameter& parameter : parameters_of(preprocessed, top)) sizes.push_back(parameter.size);
  return sizes;
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

TEST(stream_arrays, takes_the_definition_behind_those_of_headers) {
  EXPECT_THAT(sizes_of_array_parameters("int top(int x[3]) { return x[0]; }\n"
                                        "namespace mine { void top(s in[5]) {} }\n"
                                        "int main() { if (f(top(x))) { } }\n",
                                        "mine::top"),
              ElementsAre("5"));
}

TEST(stream_arrays, sees_which_arrays_pragmas_declare_to_be_streams) {
  const std::vector<array_parameter> parameters = parameters_of(
      "void other(int c[4]) {\n#pragma HLS INTERFACE axis port=c\n}\n"
      "void top(int a[4], int bb[4], const int\nc[4], int d[4][5], int e) {\n"
      "#pragma HLS INTERFACE axis register both port = a\n"
      "  #pragma hls interface mode=AP_FIFO port=d, e\n"
      "#pragma HLS INTERFACE s_axilite port=bb\n"
      "}\n"
      "#pragma HLS INTERFACE axis port=bb\n",
      "top");
  std::vector<bool> streams;
  for (const array_parameter& parameter : parameters) streams.push_back(parameter.is_stream);
  EXPECT_THAT(streams, ElementsAre(true, false, false, true, false));
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
