// From debug information to the line a person looks at.

#include "frontend/source.hpp"

#include <gmock/gmock.h>

#include "small_module.hpp"

namespace epiline::frontend {
namespace {

// f, in kernel.cpp, has inlined code of a system header (called in line 20) and of line 0 (called in line 30).
constexpr const char* with_places = R"(
define i32 @f(i32 %x) !dbg !4 {
  %bare = add i32 %x, 1
  %own = add i32 %bare, 2, !dbg !7
  %lost = add i32 %own, 3
  %header = add i32 %lost, 4, !dbg !9
  %made = add i32 %header, 5, !dbg !12
  ret i32 %made
}
define i32 @g(i32 %x) !dbg !14 {
  ret i32 %x
}
define i32 @_ZN3one3twoEi(i32 %x) {
  ret i32 %x
}
!llvm.dbg.cu = !{!0}
!llvm.module.flags = !{!3}
!0 = distinct !DICompileUnit(language: DW_LANG_C_plus_plus_14, file: !1, emissionKind: FullDebug)
!1 = !DIFile(filename: "kernel.cpp", directory: "/nowhere/project")
!2 = !DIFile(filename: "/usr/include/something.h", directory: "/nowhere/project")
!3 = !{i32 2, !"Debug Info Version", i32 3}
!4 = distinct !DISubprogram(name: "f", scope: !1, file: !1, line: 5, type: !5, unit: !0, spFlags: DISPFlagDefinition)
!5 = !DISubroutineType(types: !6)
!6 = !{null}
!7 = !DILocation(line: 10, scope: !4)
!8 = distinct !DISubprogram(name: "inner", scope: !2, file: !2, line: 90, type: !5, unit: !0, spFlags: DISPFlagDefinition)
!9 = !DILocation(line: 99, scope: !8, inlinedAt: !10)
!10 = distinct !DILocation(line: 20, scope: !4)
!11 = distinct !DISubprogram(name: "made", scope: !1, file: !1, line: 50, type: !5, unit: !0, spFlags: DISPFlagDefinition)
!12 = !DILocation(line: 0, scope: !11, inlinedAt: !13)
!13 = distinct !DILocation(line: 30, scope: !4)
!14 = distinct !DISubprogram(name: "g", scope: !1, file: !1, line: 40, type: !5, unit: !0, spFlags: DISPFlagDefinition)
)";

class places : public testing::Test {
 protected:
  llvm::Instruction& named(const char* name) {
    for (llvm::Instruction& instruction : llvm::instructions(module_.function())) {
      if (instruction.getName() == name) return instruction;
    }
    throw std::invalid_argument(name);
  }
  small_module module_{with_places};
};

TEST_F(places, an_instruction_has_its_own_line) {
  const source_place place = place_of(named("own"));
  EXPECT_EQ(place.line, 10u);
  EXPECT_THAT(place.file, testing::EndsWith("project/kernel.cpp"));
}

TEST_F(places, code_of_a_header_has_the_line_that_called_it) { EXPECT_EQ(place_of(named("header")).line, 20u); }

TEST_F(places, code_that_the_compiler_made_has_the_line_of_its_caller) { EXPECT_EQ(place_of(named("made")).line, 30u); }

TEST_F(places, a_lost_line_is_that_of_the_nearest_instruction) {
  EXPECT_EQ(place_of(named("lost")).line, 10u);  // the one before
  EXPECT_EQ(place_of(named("bare")).line, 10u);  // none before: the one after
}

TEST_F(places, without_any_line_it_is_the_functions) {
  EXPECT_EQ(place_of(*llvm::instructions(module_.function("g")).begin()).line, 40u);
  EXPECT_EQ(place_of(module_.function("g")).line, 40u);
}

TEST_F(places, without_debug_information_there_is_none) {
  EXPECT_EQ(place_of(module_.function("_ZN3one3twoEi")).line, 0u);
  EXPECT_EQ(place_of(llvm::DebugLoc()).line, 0u);
}

TEST_F(places, a_function_is_called_as_in_the_source) {
  EXPECT_EQ(readable_name(module_.function("_ZN3one3twoEi")), "one::two(int)");
}

TEST(refusal, names_the_place_when_there_is_one) {
  EXPECT_EQ(refusal_of([] { refuse({"top.cpp", 12}, "too much: use less"); }), "top.cpp:12: error: too much: use less");
  EXPECT_EQ(refusal_of([] { refuse({}, "too much: use less"); }), "error: too much: use less");
}

}  // namespace
}  // namespace epiline::frontend
