#include "report/timing.hpp"

#include <gmock/gmock.h>

#include "eval/output_file.hpp"
#include "eval/scratch_folder.hpp"

namespace epiline::report {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr const char* good = R"({"schema": "epiline-timing/1", "designs": {"color_fuzzy": {
  "clock": {"megahertz": 150.5, "source": "an estimate"}, "cycles_source": "counted",
  "frames": [{"width": 640, "height": 480, "levels": 80, "cycles": 310000}]}}})";

class timing : public testing::Test {
 protected:
  timings read(const std::string& text) {
    test::write_file(file_, text);
    return read_timings(file_);
  }
  /// Expects an error that names the file and has the parts; `from` in the good file is replaced.
  template <class... Part>
  void expect_error(const std::string& from, const std::string& to, const Part&... parts) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    EXPECT_THAT([&] { (void)read(text); },
                ThrowsMessage<eval::file_error>(AllOf(HasSubstr(file_), HasSubstr(parts)...)));
  }
  test::scratch_folder folder_;
  std::string file_ = folder_ / "timing.json";
};

TEST_F(timing, gives_frames_a_second_of_the_sizes_that_were_run) {
  const auto found = read(good);
  const auto& design = found.at("color_fuzzy");
  EXPECT_DOUBLE_EQ(*design.cycles({640, 480}), 310000);
  EXPECT_DOUBLE_EQ(*design.frames_a_second({640, 480}), 150.5e6 / 310000);
  EXPECT_FALSE(design.cycles({480, 640}).has_value());
  EXPECT_FALSE(design.frames_a_second({320, 240}).has_value());
  EXPECT_EQ(design.clock_source, "an estimate");
  EXPECT_EQ(design.cycles_source, "counted");
}

TEST_F(timing, names_the_place_of_a_mistake) {
  expect_error("epiline-timing/1", "epiline-timing/2", "schema", "epiline-timing/1");
  expect_error("150.5", "0", "designs.color_fuzzy.clock.megahertz", "above 0");
  expect_error("150.5", "\"fast\"", "designs.color_fuzzy.clock.megahertz", "fast");
  expect_error("\"cycles\": 310000", "\"cycels\": 310000", "designs.color_fuzzy.frames[0].cycels",
               "did you mean cycles");
  expect_error("640", "0", "designs.color_fuzzy.frames[0].width", "1 to 65535");
  expect_error("310000", "3.5", "designs.color_fuzzy.frames[0].cycles");
  expect_error("\"cycles_source\": \"counted\",", "", "designs.color_fuzzy", "cycles_source", "missing");
  expect_error("]}}}", "]}}", "not valid JSON");
  EXPECT_THAT([&] { (void)read_timings(folder_ / "missing.json"); },
              ThrowsMessage<eval::file_error>(HasSubstr("missing.json")));
}

}  // namespace
}  // namespace epiline::report
