// Frames as tokens and the engines that run a top token by token, on tops of a few lines: what they pass on, and what
// they refuse.

#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "cosim/engines.hpp"
#include "cosim/frame_tokens.hpp"
#include "csim/frame_beats.hpp"

namespace epiline::cosim {
namespace {

using testing::HasSubstr;

constexpr eval::parameter_description parameters[] = {{"threshold", 0, 15, 3, "only passed on"}};

eval::design_description toy_design(int pixels_per_beat) {
  return {.name = "toy",
          .meaning = "",
          .max_width = 64,
          .max_height = 64,
          .max_levels = 80,
          .default_levels = 80,
          .pixels_per_beat = pixels_per_beat,
          .parameters = parameters};
}

model_port video(std::string name, bool input, unsigned data_bits) {
  return {.name = std::move(name),
          .kind = port_kind::stream,
          .input = input,
          .width = data_bits + data_bits / 8 + 2,
          .fields = {{"tdata", data_bits, 0},
                     {"tkeep", data_bits / 8, data_bits},
                     {"tuser", 1, data_bits + data_bits / 8},
                     {"tlast", 1, data_bits + data_bits / 8 + 1}}};
}

model_port call() {
  return {.name = "call",
          .kind = port_kind::call,
          .input = true,
          .width = 25,
          .fields = {{"width", 7, 0}, {"height", 7, 7}, {"levels", 7, 14}, {"threshold", 4, 21}}};
}

eval::match_request request_of(int width, int height) {
  eval::match_request request;
  request.left = eval::rgb_image(width, height);
  request.right = eval::rgb_image(width, height);
  for (std::size_t index = 0; index < request.left.pixels.size(); ++index) {
    request.left.pixels[index] = static_cast<std::uint8_t>(index * 7 + 1);
    request.right.pixels[index] = static_cast<std::uint8_t>(index * 5 + 2);
  }
  request.levels = 80;
  request.parameters = {{"threshold", 9}};
  return request;
}

TEST(frame_tokens, lay_an_image_out_as_video_and_the_scalars_as_a_call) {
  const frame_tokens frames({video("left", true, 48), video("right", true, 48), video("found", false, 16), call()}, 2);
  EXPECT_EQ(frames.output(), "found");
  EXPECT_EQ(frames.output_tokens(5, 3), 9u);
  std::map<std::string, token_list> inputs;
  const eval::match_request request = request_of(5, 3);
  frames.append_frame(request, inputs);
  const token_list& left = inputs.at("left");
  ASSERT_EQ(left.size(), 9u);
  // Beat 1: pixels 2 and 3 of the first row, all kept, neither first nor last.
  for (unsigned byte = 0; byte < 6; ++byte) EXPECT_EQ(bits_at(left[1], 8 * byte, 8), request.left.at(2, 0)[byte]);
  EXPECT_EQ(bits_at(left[1], 48, 8), 0x3fu);
  // Beat 2: one pixel, the end of the row.
  EXPECT_EQ(bits_at(left[2], 24, 24), 0u);
  EXPECT_EQ(bits_at(left[2], 48, 8), 0x87u);
  EXPECT_EQ(bits_at(left[0], 54, 2), 1u);
  EXPECT_EQ(bits_at(inputs.at("right")[8], 0, 8), request.right.at(4, 2)[0]);
  EXPECT_EQ(inputs.at("call").size(), 1u);
  EXPECT_EQ(inputs.at("call").integer(0), 5u | 3u << 7 | 80u << 14 | 9u << 21);

  frames.append_frame(request, inputs);
  EXPECT_EQ(inputs.at("left").size(), 18u);
  EXPECT_EQ(inputs.at("call").size(), 2u);
}

TEST(frame_tokens, read_a_map_from_the_middle_of_the_tokens) {
  const frame_tokens frames({video("left", true, 24), video("right", true, 24), video("found", false, 8)}, 1);
  token_list tokens(11);
  tokens.push_integer(0x7ff);  // of the frame before
  tokens.push_integer(0x85u | 1u << 8 | 1u << 9);
  tokens.push_integer(0x00u | 1u << 8 | 1u << 10);
  const eval::disparity_map map = frames.map_of(tokens, 1, 2, 1);
  EXPECT_THAT(map.disparity, testing::ElementsAre(5, 0));
  EXPECT_THAT(map.defined, testing::ElementsAre(1, 0));
  EXPECT_THROW(static_cast<void>(frames.map_of(tokens, 0, 2, 1)), csim::malformed_frame);
  EXPECT_THROW(static_cast<void>(frames.map_of(tokens, 1, 2, 2)), csim::malformed_frame);
  EXPECT_THROW(static_cast<void>(frames.map_of(tokens, 9, 2, 1)), csim::malformed_frame);
}

template <class Action>
std::string refusal(const Action& action) {
  try {
    action();
  } catch (const unsuitable_ports& error) {
    return error.what();
  }
  return "accepted";
}

TEST(frame_tokens, refuse_ports_of_another_kind_of_top) {
  const auto made_of = [](std::vector<model_port> ports) {
    return refusal([&] { const frame_tokens frames(std::move(ports), 1); });
  };
  const model_port left = video("left", true, 24);
  const model_port right = video("right", true, 24);
  const model_port out = video("out", false, 8);
  EXPECT_EQ(made_of({left, right, out}), "accepted");
  EXPECT_THAT(made_of({left, right}), HasSubstr("no output stream"));
  EXPECT_THAT(made_of({left, out}), HasSubstr("'left' and 'right'"));
  EXPECT_THAT(made_of({left, right, out, video("third", true, 24)}), HasSubstr("port 'third'"));
  EXPECT_THAT(made_of({left, right, out, video("more", false, 8)}), HasSubstr("port 'more'"));
  EXPECT_THAT(made_of({left, video("right", true, 48), out}), HasSubstr("'right' has 48 bits of tdata, not 24"));
  model_port odd = out;
  odd.fields[1].name = "tdest";
  EXPECT_THAT(made_of({left, right, odd}), HasSubstr("'tdest'"));
}

TEST(frame_tokens, refuse_scalars_they_have_no_value_for) {
  const auto appended = [](const model_port& port, const eval::match_request& request) {
    return refusal([&] {
      const frame_tokens frames({video("left", true, 24), video("right", true, 24), video("out", false, 8), port}, 1);
      std::map<std::string, token_list> inputs;
      frames.append_frame(request, inputs);
    });
  };
  eval::match_request request = request_of(2, 2);
  EXPECT_EQ(appended(call(), request), "accepted");
  model_port more = call();
  more.fields.push_back({"colour", 1, 25});
  more.width = 26;
  EXPECT_THAT(appended(more, request), HasSubstr("scalar 'colour' is unknown"));
  request.parameters["threshold"] = 16;
  EXPECT_THAT(appended(call(), request), HasSubstr("'threshold' has 4 bits, too few for 16"));
  request.parameters["threshold"] = 3;
  request.parameters["ring"] = 1;
  EXPECT_THAT(appended(call(), request), HasSubstr("no scalar for parameter 'ring'"));
}

// Passes the low 7 bits of left's red on as the disparity of every pixel.
constexpr const char* pass_red = R"(
graph "toy"
file "toy.cpp"
input stream "left" 26 @0:1
  field "data" "tdata" 24
  field "user" "tuser" 1
  field "last" "tlast" 1
input stream "right" 26 @0:1
  field "data" "tdata" 24
  field "user" "tuser" 1
  field "last" "tlast" 1
output stream "found" 10 @0:1
  field "data" "tdata" 8
  field "user" "tuser" 1
  field "last" "tlast" 1
%0 = constant 1 0x1
%1 = read 26 port 0 (%0)
%2 = read 26 port 1 (%0)
%3 = slice 7 low 0 (%1)
%4 = slice 2 low 24 (%1)
%5 = concat 10 (%4, %0, %3)
%6 = write 0 port 2 (%0, %5)
)";

class graph_engine : public testing::Test {
 protected:
  void SetUp() override {
    const testing::TestInfo& info = *testing::UnitTest::GetInstance()->current_test_info();
    file_ = std::filesystem::temp_directory_path() / ("epiline_" + std::to_string(getpid()) + info.name() + ".graph");
  }
  void TearDown() override { std::filesystem::remove(file_); }

  /// Writes pass_red to the file with some of its text replaced.
  void write(std::initializer_list<std::pair<std::string_view, std::string_view>> replacements) const {
    std::string text = pass_red;
    for (const auto& [old_text, new_text] : replacements) {
      const std::size_t place = text.find(old_text);
      ASSERT_NE(place, std::string::npos) << old_text;
      text.replace(place, old_text.size(), new_text);
    }
    std::ofstream(file_) << text;
  }

  [[nodiscard]] eval::match_result match(int width, int height) const {
    eval::match_request request = request_of(width, height);
    request.parameters.clear();
    return make_graph_engine(toy_design(1), file_)->match(request, {});
  }

  [[nodiscard]] std::string error() const {
    try {
      static_cast<void>(match(4, 3));
    } catch (const eval::engine_error& caught) {
      return caught.what();
    }
    return "no error";
  }

  std::filesystem::path file_;
};

TEST_F(graph_engine, runs_a_frame) {
  write({});
  const eval::match_result result = match(4, 3);
  const eval::match_request request = request_of(4, 3);
  EXPECT_FALSE(result.cycles.has_value());
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 4; ++x) {
      EXPECT_EQ(result.map.disparity[result.map.index(x, y)], request.left.at(x, y)[0] & 0x7f);
      EXPECT_EQ(result.map.defined[result.map.index(x, y)], 1);
    }
  }
}

TEST_F(graph_engine, names_a_stream_left_with_unread_tokens) {
  write({{"%2 = read 26 port 1 (%0)", "%2 = constant 26 0x0"}});
  EXPECT_THAT(error(), HasSubstr("'right' is left with 12 of 12 tokens unread"));
}

TEST_F(graph_engine, counts_the_output) {
  // Writes only the pixels whose red is odd.
  write({{"%6 = write 0 port 2 (%0, %5)", "%6 = slice 1 low 0 (%1)\n%7 = write 0 port 2 (%6, %5)"}});
  EXPECT_THAT(error(), HasSubstr("'found' got 6 tokens, not 12"));
}

TEST_F(graph_engine, stops_a_graph_that_never_waits) {
  write({{"%1 = read 26 port 0 (%0)", "%1 = constant 26 0x0"}, {"%2 = read 26 port 1 (%0)", "%2 = constant 26 0x0"}});
  EXPECT_THAT(error(), HasSubstr("no end after"));
}

TEST_F(graph_engine, names_a_file_it_cannot_read_or_understand) {
  EXPECT_THAT(error(), HasSubstr("cannot read the dataflow graph"));
  std::ofstream(file_) << "graph \"toy\"\nnonsense\n";
  EXPECT_THAT(error(), testing::AllOf(HasSubstr(file_.string()), HasSubstr("line 2")));
  std::ofstream(file_) << "graph \"toy\"\n";
  EXPECT_THAT(error(), HasSubstr("'left' and 'right'"));
}

/// A module without a simulator behind it: takes one left and one right token a clock and sends left's red on, or
/// stops for ever after some tokens.
class pass_red_model final : public rtl_model {
 public:
  explicit pass_red_model(std::size_t stop_after) : stop_after_(stop_after) {
    name_ = "toy";
    ports_ = {video("left", true, 24), video("right", true, 24), video("found", false, 8)};
  }
  void set_reset(bool active) override { reset_ = active; }
  void settle() override { take_ = valid_[0] && valid_[1] && (!full_ || ready_) && taken_ < stop_after_; }
  void rising_edge() override {
    if (full_ && ready_) full_ = false;
    if (take_) {
      full_ = true;
      ++taken_;
      out_ = static_cast<std::uint32_t>(bits_at(token_, 0, 7) | 0x80u | 1u << 8 | bits_at(token_, 27, 2) << 9);
    }
    if (reset_) full_ = false;
  }
  void set_token(std::size_t port, const std::uint32_t* token) override {
    if (port == 0) token_ = {token[0]};
  }
  void set_valid(std::size_t port, bool value) override { valid_[port] = value; }
  [[nodiscard]] bool ready(std::size_t) const override { return take_; }
  void get_token(std::size_t, std::uint32_t* token) const override { *token = out_; }
  [[nodiscard]] bool valid(std::size_t) const override { return full_; }
  void set_ready(std::size_t, bool value) override { ready_ = value; }

 private:
  std::size_t stop_after_;
  std::size_t taken_ = 0;
  std::array<std::uint32_t, 1> token_{};
  std::array<bool, 2> valid_{};
  bool reset_ = false, take_ = false, full_ = false, ready_ = false;
  std::uint32_t out_ = 0;
};

TEST(model_engine, runs_a_frame_and_counts_its_clocks) {
  const auto engine =
      make_model_engine(toy_design(1), [](std::uint64_t) { return std::make_unique<pass_red_model>(99); });
  eval::match_request request = request_of(4, 3);
  request.parameters.clear();
  const eval::match_result result = engine->match(request, {});
  EXPECT_EQ(result.cycles, 13u);
  EXPECT_EQ(result.map.disparity[5], request.left.at(1, 1)[0] & 0x7f);
  eval::run_options slow;
  slow.input_gap_percent = 50;
  slow.output_stall_percent = 50;
  const eval::match_result stalled = engine->match(request, slow);
  EXPECT_EQ(stalled.map, result.map);
  EXPECT_GT(stalled.cycles, 13u);
}

TEST(model_engine, passes_errors_on_in_words) {
  const auto engine =
      make_model_engine(toy_design(1), [](std::uint64_t) { return std::make_unique<pass_red_model>(5); });
  eval::match_request request = request_of(4, 3);
  request.parameters.clear();
  const auto message = [&](const eval::match_request& asked) -> std::string {
    try {
      static_cast<void>(engine->match(asked, {}));
    } catch (const eval::engine_error& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_THAT(message(request), testing::AllOf(HasSubstr("no token moved"), HasSubstr("'found': 5 of 12")));
  request.parameters = {{"threshold", 1}};
  EXPECT_THAT(message(request), HasSubstr("no scalar for parameter 'threshold'"));
}

TEST(netlist_engine, names_the_command_that_failed_and_the_library_it_cannot_load) {
  const auto message = [](const std::filesystem::path& library, const std::string& command) -> std::string {
    const eval::design_description design = toy_design(1);
    try {
      static_cast<void>(make_netlist_engine(design, library, command)->match(request_of(4, 3), {}));
    } catch (const eval::engine_error& error) {
      return error.what();
    }
    return "no error";
  };
  const std::filesystem::path library =
      std::filesystem::temp_directory_path() / ("epiline_" + std::to_string(getpid()) + ".so");
  std::filesystem::remove(library);
  EXPECT_THAT(message(library, "false"), testing::AllOf(HasSubstr("could not be built by 'false'"), HasSubstr(".log")));
  std::ofstream(library) << "no library";
  EXPECT_THAT(message(library, "true"), HasSubstr("cannot load the netlist's simulation model"));
  std::filesystem::remove(library);
  std::filesystem::remove(library.string() + ".log");
}

}  // namespace
}  // namespace epiline::cosim
