// How C++ types become tokens: leaves, padding, AXI4-Stream members.

#include "frontend/payload.hpp"

#include <gmock/gmock.h>

#include "small_module.hpp"

namespace epiline::frontend {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// The layouts of hls/types: u17 = ap_uint<17>, s5 = ap_int<5>.
constexpr const char* vendor_types = R"(
%u17 = type { i32, [0 x [17 x i8]] }
%s5 = type <{ i8, [0 x [5 x i16]] }>
%u63 = type { i64, [0 x [63 x i8]] }
)";

/// Keeps a type in the module, which has only those that are used.
std::string with(const std::string& types, const std::string& used) {
  return vendor_types + types + "@keep = external global " + used + "\n";
}

std::vector<std::string> text_of(const std::vector<leaf>& leaves) {
  std::vector<std::string> texts;
  for (const leaf& one : leaves) {
    std::string path;
    for (const unsigned index : one.path) path += "." + std::to_string(index);
    texts.push_back(path + (one.is_signed ? " s" : " u") + std::to_string(one.width));
  }
  return texts;
}

TEST(arbitrary_precision, width_and_sign_are_in_the_tag) {
  small_module module(with("%all = type { %u17, %s5, { i8, i8 }, { i8 }, { float, [0 x [5 x i8]] } }\n", "%all"));
  llvm::StructType* all = module.type("all");
  unsigned width = 0;
  bool is_signed = true;
  EXPECT_TRUE(is_arbitrary_precision(all->getElementType(0), width, is_signed));
  EXPECT_EQ(width, 17u);
  EXPECT_FALSE(is_signed);
  EXPECT_TRUE(is_arbitrary_precision(all->getElementType(1), width, is_signed));
  EXPECT_EQ(width, 5u);
  EXPECT_TRUE(is_signed);
  for (unsigned index = 2; index < 5; ++index) {
    EXPECT_FALSE(is_arbitrary_precision(all->getElementType(index), width, is_signed)) << index;
  }
}

TEST(leaves, come_in_the_order_of_the_members_with_paths_to_them) {
  small_module module(with("%pair = type { i16, %s5 }\n%all = type { %u17, [2 x %pair], i1 }\n", "%all"));
  const std::vector<leaf> leaves = leaves_of(module.type("all"), module.module(), {});
  EXPECT_THAT(text_of(leaves),
              ElementsAre(".0.0 u17", ".1.0.0 u16", ".1.0.1.0 s5", ".1.1.0 u16", ".1.1.1.0 s5", ".2 u1"));
  EXPECT_EQ(width_of(leaves), 17u + 2 * (16 + 5) + 1);
  EXPECT_TRUE(leaves[0].storage->isIntegerTy(32));
}

TEST(leaves, padding_takes_no_part) {
  small_module module(with("%all = type <{ i8, [3 x i8], i32, %s5, [3 x i8] }>\n", "%all"));
  EXPECT_THAT(text_of(leaves_of(module.type("all"), module.module(), {})), ElementsAre(".0 u8", ".2 u32", ".3.0 s5"));
}

TEST(leaves, what_is_not_built_of_integers_is_refused_at_its_place) {
  small_module module(
      with("%number = type { i8, double }\n%link = type { ptr }\n%all = type { %number, %link }\n", "%all"));
  EXPECT_THAT(refusal_of([&] { static_cast<void>(leaves_of(module.type("number"), module.module(), {"top.cpp", 7})); }),
              HasSubstr("top.cpp:7: error: floating point"));
  EXPECT_THAT(refusal_of([&] { static_cast<void>(leaves_of(module.type("link"), module.module(), {"top.cpp", 8})); }),
              HasSubstr("top.cpp:8: error: a stream or parameter of pointers"));
}

struct padding_case {
  const char* what;
  const char* type;
  unsigned index;
  bool padding;
};

TEST(padding, is_what_clang_fills_before_a_c_integer_or_at_the_end) {
  const padding_case cases[] = {
      {"before an int", "<{ i8, [3 x i8], i32 }>", 1, true},
      {"before a long", "<{ i32, [4 x i8], i64 }>", 1, true},
      {"before a struct that holds an int", "<{ i8, [3 x i8], { i32, i8 } }>", 1, true},
      {"before an array of shorts", "<{ i8, [1 x i8], [2 x i16] }>", 1, true},
      {"at the end", "<{ i32, i8, [3 x i8] }>", 2, true},
      {"in a struct that is not packed", "{ i8, [3 x i8], i32 }", 1, false},
      {"before a byte", "<{ i8, [3 x i8], i8 }>", 1, false},
      {"before a value of hls/types, which has no alignment", "<{ i8, [3 x i8], %u17 }>", 1, false},
      {"before a struct of such values", "<{ i8, [7 x i8], { %u63, %u17 } }>", 1, false},
      {"at the end of a struct of such values", "<{ %u17, i8, [3 x i8] }>", 2, false},
      {"of the wrong length", "<{ i8, [2 x i8], i32 }>", 1, false},
      {"where no gap is", "<{ i32, [4 x i8], i32 }>", 1, false},
      {"longer than any gap", "<{ i8, [7 x i8], i32 }>", 1, false},
      {"not of bytes", "<{ i16, [1 x i16], i32 }>", 1, false},
      {"no array", "<{ i8, i8, i16 }>", 1, false},
  };
  for (const padding_case& one : cases) {
    small_module module(with("%all = type " + std::string(one.type) + "\n", "%all"));
    EXPECT_EQ(is_padding(*module.type("all"), one.index, module.layout()), one.padding) << one.what << ": " << one.type;
  }
}

// struct record { unsigned char kind; unsigned char bytes[3]; int length; ... } of 16 bytes, and one with a gap
// instead.
constexpr const char* two_records = R"(
%"struct.space::record.7" = type <{ i8, [3 x i8], i32, i8, %u17, [3 x i8] }>
%struct.gap = type <{ i8, [3 x i8], i32, i8, %u17, [3 x i8] }>
@record = external global [2 x %"struct.space::record.7"]
@gap = external global %struct.gap
!llvm.dbg.cu = !{!0}
!llvm.module.flags = !{!9}
!0 = distinct !DICompileUnit(language: DW_LANG_C_plus_plus_14, file: !1, emissionKind: FullDebug, retainedTypes: !2)
!1 = !DIFile(filename: "kernel.cpp", directory: "/nowhere")
!2 = !{!3, !4}
!3 = !DICompositeType(tag: DW_TAG_structure_type, name: "record", file: !1, size: 128, elements: !{!5, !6, !7})
!4 = !DICompositeType(tag: DW_TAG_structure_type, name: "gap", file: !1, size: 128, elements: !{!5, !7})
!5 = !DIDerivedType(tag: DW_TAG_member, name: "kind", baseType: !8, size: 8)
!6 = !DIDerivedType(tag: DW_TAG_member, name: "bytes", baseType: !8, size: 24, offset: 8)
!7 = !DIDerivedType(tag: DW_TAG_member, name: "length", baseType: !8, size: 32, offset: 32)
!8 = !DIBasicType(name: "unsigned char", size: 8, encoding: DW_ATE_unsigned_char)
!9 = !{i32 2, !"Debug Info Version", i32 3}
)";

TEST(padding, a_member_that_looks_like_it_is_refused_and_a_gap_is_not) {
  small_module module(std::string(vendor_types) + two_records);
  llvm::StructType* record = module.type("struct.space::record.7");
  ASSERT_TRUE(is_padding(*record, 1, module.layout()));
  const char* const words = "top.cpp:9: error: the bytes 'bytes' of struct 'record' stand where padding would be";
  EXPECT_THAT(refusal_of([&] { refuse_members_like_padding(record, module.module(), {"top.cpp", 9}); }),
              HasSubstr(words));
  EXPECT_THAT(refusal_of([&] {
                refuse_members_like_padding(llvm::ArrayType::get(record, 2), module.module(), {"top.cpp", 9});
              }),
              HasSubstr(words));
  EXPECT_EQ(
      refusal_of([&] { refuse_members_like_padding(module.type("struct.gap"), module.module(), {"top.cpp", 9}); }), "");
}

TEST(fields, one_group_for_each_axi_stream_member) {
  // As ap_axi_sdata.h tags its members: 1 tdata, 2 tkeep, 4 tuser, 5 tlast.
  small_module module(with(R"(
%data = type { [0 x [1 x i32]], { %u17, %s5 } }
%beat = type { %data, { [0 x [2 x i32]], i8 }, { [0 x [4 x i32]], %s5 }, { [0 x [5 x i32]], i1 } }
)",
                           "%beat"));
  const std::vector<dataflow::field> fields = fields_of(leaves_of(module.type("beat"), module.module(), {}));
  ASSERT_EQ(fields.size(), 4u);
  const auto expect = [&](std::size_t index, const char* signal, unsigned width, unsigned offset, bool is_signed) {
    EXPECT_EQ(fields[index].signal, signal);
    EXPECT_EQ(fields[index].name, std::string(signal).substr(1));
    EXPECT_EQ(fields[index].width, width) << signal;
    EXPECT_EQ(fields[index].offset, offset) << signal;
    EXPECT_EQ(fields[index].is_signed, is_signed) << signal;
  };
  expect(0, "tdata", 22, 0, false);  // two numbers: no common sign
  expect(1, "tkeep", 8, 22, false);
  expect(2, "tuser", 5, 30, true);
  expect(3, "tlast", 1, 35, false);
}

}  // namespace
}  // namespace epiline::frontend
