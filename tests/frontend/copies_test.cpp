// Copies of whole objects as loads and stores of their scalars.

#include "frontend/copies.hpp"

#include <gmock/gmock.h>

#include "small_module.hpp"

namespace epiline::frontend {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* declarations = R"(
%pair = type { i32, i16 }
%padded = type <{ i8, [3 x i8], i32, i8, [3 x i8] }>
declare void @llvm.memcpy.p0.p0.i64(ptr, ptr, i64, i1)
declare void @llvm.memmove.p0.p0.i64(ptr, ptr, i64, i1)
declare void @llvm.memset.p0.i64(ptr, i8, i64, i1)
)";

std::string with_body(const std::string& body, const std::string& parameters = "ptr %p, i64 %n, i8 %v, i1 %c") {
  return declarations + ("define void @f(" + parameters + ") {\n" + body + "  ret void\n}\n");
}

TEST(copies, of_a_struct_move_its_members) {
  small_module module(with_body(R"(
  %a = alloca %pair
  %b = alloca %pair
  call void @llvm.memcpy.p0.p0.i64(ptr %a, ptr %b, i64 8, i1 false)
)"));
  expand_copies(module.function(), unknown_types::refused);
  EXPECT_EQ(module.problem(), "");
  EXPECT_EQ(module.count("call"), 0u);
  EXPECT_EQ(module.count("load"), 2u);
  EXPECT_EQ(module.count("store"), 2u);
}

TEST(copies, read_everything_before_they_write) {
  small_module module(with_body(R"(
  %a = alloca [4 x i16]
  %b = getelementptr [4 x i16], ptr %a, i64 0, i64 1
  call void @llvm.memmove.p0.p0.i64(ptr %b, ptr %a, i64 6, i1 false)
)"));
  expand_copies(module.function(), unknown_types::refused);
  EXPECT_EQ(module.problem(), "");
  std::vector<std::string> accesses;
  for (const std::string& opcode : module.opcodes()) {
    if (opcode == "load" || opcode == "store") accesses.push_back(opcode);
  }
  EXPECT_THAT(accesses, ElementsAre("load", "load", "load", "store", "store", "store"));
}

TEST(copies, take_the_type_from_the_source_when_the_destination_has_none) {
  small_module module(with_body(R"(
  %b = alloca %pair
  call void @llvm.memcpy.p0.p0.i64(ptr %p, ptr %b, i64 8, i1 false)
)"));
  expand_copies(module.function(), unknown_types::refused);
  EXPECT_EQ(module.count("load"), 2u);
}

TEST(copies, may_end_before_the_padding) {
  small_module module(with_body(R"(
  %a = alloca %padded
  %b = alloca %padded
  call void @llvm.memcpy.p0.p0.i64(ptr %a, ptr %b, i64 9, i1 false)
)"));
  expand_copies(module.function(), unknown_types::refused);
  EXPECT_EQ(module.problem(), "");
  EXPECT_EQ(module.count("call"), 0u);
  EXPECT_GE(module.count("load"), 3u);
}

TEST(copies, through_a_choice_have_the_type_of_the_chosen) {
  small_module module(with_body(R"(
  %a = alloca %pair
  %b = alloca %pair
  %one = select i1 %c, ptr %a, ptr %b
  call void @llvm.memcpy.p0.p0.i64(ptr %one, ptr %p, i64 8, i1 false)
)"));
  expand_copies(module.function(), unknown_types::refused);
  EXPECT_EQ(module.count("store"), 2u);
}

TEST(copies, of_a_constant_repeat_its_byte) {
  small_module module(with_body(R"(
  %a = alloca %pair
  call void @llvm.memset.p0.i64(ptr %a, i8 165, i64 8, i1 false)
)"));
  expand_copies(module.function(), unknown_types::refused);
  std::vector<std::uint64_t> stored;
  for (const llvm::Instruction& instruction : llvm::instructions(module.function())) {
    if (const auto* store = llvm::dyn_cast<llvm::StoreInst>(&instruction)) {
      stored.push_back(llvm::cast<llvm::ConstantInt>(store->getValueOperand())->getZExtValue());
    }
  }
  EXPECT_THAT(stored, ElementsAre(0xa5a5a5a5u, 0xa5a5u));
}

TEST(copies, of_nothing_vanish) {
  small_module module(with_body("  call void @llvm.memcpy.p0.p0.i64(ptr %p, ptr %p, i64 0, i1 false)\n"));
  expand_copies(module.function(), unknown_types::refused);
  EXPECT_THAT(module.opcodes(), ElementsAre("ret"));
}

TEST(copies, of_unknown_type_are_kept_or_refused_as_asked) {
  const std::string text = with_body("  call void @llvm.memcpy.p0.p0.i64(ptr %p, ptr %p, i64 12, i1 false)\n");
  small_module kept(text);
  expand_copies(kept.function(), unknown_types::kept);
  EXPECT_EQ(kept.count("call"), 1u);
  small_module refusing(text);
  EXPECT_THAT(refusal_of([&] { expand_copies(refusing.function(), unknown_types::refused); }),
              HasSubstr("copy of 12 bytes of unknown type: assign the members or elements one by one"));
}

TEST(copies, that_no_clock_can_do_are_refused) {
  const std::pair<const char*, const char*> cases[] = {
      {"  %a = alloca %pair\n  call void @llvm.memcpy.p0.p0.i64(ptr %a, ptr %p, i64 %n, i1 false)\n",
       "copy of a run-time number of bytes: write a loop"},
      {"  %a = alloca %pair\n  call void @llvm.memset.p0.i64(ptr %a, i8 %v, i64 8, i1 false)\n",
       "memset with a run-time value: write a loop"},
      {"  %a = alloca [8193 x i8]\n  call void @llvm.memset.p0.i64(ptr %a, i8 0, i64 8193, i1 false)\n",
       "a whole array is cleared or copied at once"},
  };
  for (const auto& [body, words] : cases) {
    small_module module(with_body(body));
    EXPECT_THAT(refusal_of([&] { expand_copies(module.function(), unknown_types::refused); }), HasSubstr(words));
  }
}

TEST(whole_structs, are_loaded_and_stored_member_by_member) {
  small_module module(with_body(R"(
  %whole = load { i64, i8 }, ptr %p
  store { i64, i8 } %whole, ptr %q
)",
                                "ptr %p, ptr %q"));
  split_whole_structs(module.function());
  EXPECT_EQ(module.problem(), "");
  std::vector<unsigned> widths;
  for (const llvm::Instruction& instruction : llvm::instructions(module.function())) {
    if (llvm::isa<llvm::LoadInst>(instruction)) widths.push_back(instruction.getType()->getIntegerBitWidth());
    if (const auto* store = llvm::dyn_cast<llvm::StoreInst>(&instruction)) {
      widths.push_back(store->getValueOperand()->getType()->getIntegerBitWidth());
    }
  }
  EXPECT_THAT(widths, ElementsAre(64u, 8u, 64u, 8u));
}

}  // namespace
}  // namespace epiline::frontend
