// The host against the whole board in simulation, behind a pseudo-terminal: the map is native's, bit for bit, whatever
// happens on the line; and where nothing can be done, one clear error comes soon.

#include <fcntl.h>
#include <gmock/gmock.h>

#include "board/board_order.hpp"
#include "board/engines.hpp"
#include "board/self_test.hpp"
#include "csim/engines.hpp"
#include "csim/frame_beats.hpp"
#include "eval/random_images.hpp"
#include "simulated_board.hpp"
#include "tops/adaptive_ca.hpp"
#include "tops/color_fuzzy.hpp"

namespace epiline::board {
namespace {

using testing::HasSubstr;
using namespace std::chrono_literals;

// A machine with much else to do is no silent board.
constexpr link_options patient{.patience = 60s, .stuck = 120s};

const eval::engine_registry& engines() {
  static const eval::engine_registry registry = [] {
    eval::engine_registry made;
    csim::register_engines(made);
    register_engines(made);
    return made;
  }();
  return registry;
}

eval::match_request request_of(unsigned seed, const char* design, int width, int height) {
  std::mt19937 random(seed);
  test::image_pair pair = test::random_pair(random, width, height, 7, 256);
  eval::match_request request;
  request.left = std::move(pair.left);
  request.right = std::move(pair.right);
  request.levels = 8;
  request.parameters = eval::default_parameters(*eval::find_design(design));
  return request;
}

eval::match_result match(const char* design, const char* engine, const eval::match_request& request,
                         const eval::run_options& options = {}) {
  return engines().find(design, engine)->make(*eval::find_design(design))->match(request, options);
}

eval::disparity_map native(const char* design, const eval::match_request& request) {
  return match(design, "native", request).map;
}

std::string error_of(const eval::match_request& request, const eval::run_options& options,
                     const char* design = "color_fuzzy") {
  try {
    (void)match(design, "board", request, options);
  } catch (const eval::engine_error& error) {
    return error.what();
  }
  return "no error";
}

/// What came back for a request over this link.
eval::disparity_map run(board_link& link, const eval::match_request& request) {
  const board_identity identity = link.identify();
  const bytes results =
      link.run(frame_order(identity, request), result_bytes(identity, request.left.width, request.left.height), {});
  return map_of_results(identity, results, request.left.width, request.left.height);
}

TEST(board, matches_frames_of_any_size_like_native) {
  test::simulated_board board({});
  eval::run_options options;
  options.port = board.port();
  options.patience_milliseconds = 60'000;
  double last = 0;
  options.progress = [&](double done) {
    EXPECT_GE(done, last);
    last = done;
  };
  for (const auto& [width, height] : {std::pair{64, 12}, {33, 9}, {1, 1}, {7, 20}}) {
    eval::match_request request = request_of(static_cast<unsigned>(width), "color_fuzzy", width, height);
    request.levels = 1 + width % 8;
    request.parameters["fuzzy"] = width % 3;
    last = 0;
    const eval::match_result result = match("color_fuzzy", "board", request, options);
    EXPECT_EQ(result.map, native("color_fuzzy", request)) << width << "x" << height;
    EXPECT_THAT(result.note, HasSubstr("color_fuzzy_small"));
    EXPECT_EQ(last, 1.0);
  }
}

TEST(board, holds_the_other_method_too) {
  test::simulated_board board({"--core", "adaptive_ca_small"});
  eval::run_options options;
  options.port = board.port();
  options.patience_milliseconds = 60'000;
  const eval::match_request request = request_of(4, "adaptive_ca", 40, 14);
  EXPECT_EQ(match("adaptive_ca", "board", request, options).map, native("adaptive_ca", request));
}

TEST(board, measures_the_rate_of_the_line) {
  for (const char* clocks_a_bit : {"5.3", "20", "77.7"}) {
    test::simulated_board board({"--clocks-a-bit", clocks_a_bit});
    serial_port port(board.port(), 3'000'000);
    board_link link(port, patient);
    const eval::match_request request = request_of(5, "color_fuzzy", 12, 4);
    EXPECT_EQ(run(link, request), native("color_fuzzy", request)) << clocks_a_bit;
  }
}

class faulty_line : public testing::TestWithParam<const char*> {};

TEST_P(faulty_line, loses_nothing) {
  std::uint64_t repaired = 0;
  for (const char* seed : {"1", "2", "3"}) {
    test::simulated_board board({std::string("--") + GetParam(), "0.003", "--seed", seed});
    serial_port port(board.port(), 3'000'000);
    board_link link(port, patient);
    const eval::match_request request = request_of(6, "color_fuzzy", 40, 10);
    EXPECT_EQ(run(link, request), native("color_fuzzy", request)) << "seed " << seed;
    const auto statistics = board.end();
    const std::string happened = GetParam() == std::string("drop")   ? "dropped"
                                 : GetParam() == std::string("flip") ? "flipped"
                                                                     : "duplicated";
    EXPECT_GT(statistics["to_board"][happened].get<int>(), 0);
    repaired += link.statistics().resent_packets + link.statistics().repeated_reads;
  }
  EXPECT_GT(repaired, 0u);
}
INSTANTIATE_TEST_SUITE_P(board, faulty_line, testing::Values("drop", "flip", "duplicate"),
                         [](const auto& info) { return std::string(info.param); });

TEST(board, begins_again_after_a_reset_in_the_middle_of_a_frame) {
  test::simulated_board board({"--reset-after", "900", "--reset-after", "2900"});
  serial_port port(board.port(), 3'000'000);
  board_link link(port, patient);
  const eval::match_request request = request_of(7, "color_fuzzy", 40, 10);
  EXPECT_EQ(run(link, request), native("color_fuzzy", request));
  EXPECT_EQ(link.statistics().restarts, 2u);
  EXPECT_EQ(board.end()["resets"], 2);
}

TEST(board, serves_a_host_that_comes_after_one_that_went_away_in_the_middle) {
  test::simulated_board board({});
  const eval::match_request request = request_of(8, "color_fuzzy", 30, 8);
  {
    serial_port port(board.port(), 3'000'000);
    board_link link(port, patient);
    const board_identity identity = link.identify();
    bytes order = frame_order(identity, request);
    // The order and two rows, too few for a result; then half a packet.
    order.resize(order.size() - std::size_t{6} * 30 * 6);
    (void)link.run(order, 0, {});
    const bytes half = encode({packet_kind::data, 1, 2, {3, 4, 5}});
    (void)port.write(std::span(half).first(8));
  }
  serial_port port(board.port(), 3'000'000);
  board_link link(port, patient);
  EXPECT_EQ(run(link, request), native("color_fuzzy", request));
}

TEST(board, that_goes_silent_is_an_error_within_its_time) {
  test::simulated_board board({"--silence-after", "1500"});
  eval::run_options options;
  options.port = board.port();
  options.patience_milliseconds = 3'000;
  const auto start = std::chrono::steady_clock::now();
  EXPECT_THAT(error_of(request_of(9, "color_fuzzy", 40, 20), options),
              testing::AnyOf(HasSubstr("went silent after"), HasSubstr("no board answers")));
  EXPECT_LT(std::chrono::steady_clock::now() - start, 30s);
  EXPECT_EQ(board.end()["silent"], true);
}

TEST(board, that_is_unplugged_is_an_error) {
  test::simulated_board board({"--unplug-after", "1500"});
  eval::run_options options;
  options.port = board.port();
  options.patience_milliseconds = 20'000;
  EXPECT_THAT(error_of(request_of(10, "color_fuzzy", 40, 20), options), HasSubstr("was the board unplugged?"));
}

TEST(board, that_holds_something_else_says_what) {
  test::simulated_board board({});
  eval::run_options options;
  options.port = board.port();
  options.patience_milliseconds = 60'000;
  EXPECT_THAT(error_of(request_of(11, "adaptive_ca", 8, 8), options, "adaptive_ca"),
              HasSubstr("holds color_fuzzy_small (design color_fuzzy), not design adaptive_ca"));
  eval::match_request large = request_of(12, "color_fuzzy", 65, 8);
  EXPECT_THAT(error_of(large, options), HasSubstr("takes at most 64 columns, not 65"));
  eval::match_request tall = request_of(12, "color_fuzzy", 4, 256);
  EXPECT_THAT(error_of(tall, options), HasSubstr("takes at most 255 rows, not 256"));
  eval::match_request deep = request_of(12, "color_fuzzy", 8, 8);
  deep.levels = 9;
  EXPECT_THAT(error_of(deep, options), HasSubstr("takes at most 8 levels, not 9"));
}

TEST(board, port_that_is_missing_or_none_or_taken_is_an_error) {
  const eval::match_request request = request_of(13, "color_fuzzy", 8, 8);
  eval::run_options options;
  options.patience_milliseconds = 300;
  EXPECT_THAT(error_of(request, options), HasSubstr("needs --port"));
  options.port = "/dev/epiline-no-such-port";
  EXPECT_THAT(error_of(request, options), HasSubstr("there is no serial port '/dev/epiline-no-such-port'"));
  options.port = "/dev/null";
  EXPECT_THAT(error_of(request, options), HasSubstr("'/dev/null' is not a serial port"));
  // A terminal at which nobody sits.
  const int master = posix_openpt(O_RDWR | O_NOCTTY);
  ASSERT_EQ(grantpt(master) + unlockpt(master), 0);
  options.port = ptsname(master);
  EXPECT_THAT(error_of(request, options), HasSubstr("no board answers at"));
  options.baud = 12;
  EXPECT_THAT(error_of(request, options), HasSubstr("--baud 12: choose one of"));
  options.baud = 115'200;
  const serial_port other(options.port, options.baud);
  EXPECT_THAT(error_of(request, options), HasSubstr("in use by another program"));
  close(master);
}

TEST(board, identity_that_is_not_understood_is_an_error) {
  EXPECT_THROW((void)board_identity::parse("epiline 2;board=x", "here"), link_error);
  EXPECT_THROW((void)board_identity::parse("epiline 1;board=x;core=y", "here"), link_error);
  EXPECT_THROW((void)board_identity::parse("", "here"), link_error);
  const auto identity = board_identity::parse(
      "epiline 1;board=b;core=c;design=d;lanes=2;size=10x20x30;clock=100000000;call=width,height", "here");
  EXPECT_EQ(identity.max_levels, 30);
  EXPECT_EQ(identity.pixels_per_beat, 2);
  EXPECT_EQ(identity.clock, 1e8);
  EXPECT_THAT(identity.arguments, testing::ElementsAre("width", "height"));
}

TEST(board, whose_design_gives_more_or_less_than_its_size_is_an_error) {
  test::simulated_board board({});
  serial_port port(board.port(), 3'000'000);
  board_link link(port, {.patience = 60s, .stuck = 3s});
  const eval::match_request request = request_of(16, "color_fuzzy", 20, 6);
  const board_identity identity = link.identify();
  const bytes order = frame_order(identity, request);
  const auto error = [&](std::size_t count) -> std::string {
    try {
      (void)link.run(order, count, {});
    } catch (const link_error& caught) {
      return caught.what();
    }
    return "no error";
  };
  EXPECT_THAT(error(20 * 6 + 1), HasSubstr("its design does not go on"));
  EXPECT_THAT(error(10), HasSubstr("sends more than the 10 bytes"));
  EXPECT_EQ(run(link, request), native("color_fuzzy", request));  // and the link is none the worse for it
}

/// At full speed: the CRC is native's, and hardly more clocks go by than there are pixels.
TEST(board, tests_itself_at_full_speed) {
  test::simulated_board board({});
  serial_port port(board.port(), 3'000'000);
  board_link link(port, patient);
  const board_identity identity = link.identify();
  eval::match_request request = request_of(14, "color_fuzzy", 64, 30);
  const auto engine = engines().find("color_fuzzy", "native")->make(*eval::find_design("color_fuzzy"));
  for (const std::uint64_t seed : {1u, 2u}) {
    const generator_seeds seeds = seeds_of(seed, request.levels, identity.pixels_per_beat);
    const self_test_report report = run_self_test(link, identity, request, 3, seeds);
    EXPECT_EQ(report.crc, expected_crc(identity, request, 3, seeds, *engine));
    EXPECT_NE(report.crc, expected_crc(identity, request, 2, seeds, *engine));
    const std::uint32_t pixels = 64 * 30;
    EXPECT_GT(report.first_frame_clocks, pixels);
    EXPECT_EQ((report.all_clocks - report.first_frame_clocks) % 2, 0u);  // each further frame takes the same
    const std::uint32_t a_frame = (report.all_clocks - report.first_frame_clocks) / 2;
    EXPECT_GT(a_frame, pixels);
    EXPECT_LT(a_frame, pixels * 3 / 2);  // small frames have large borders
  }
}

TEST(board, test_pictures_have_two_disparities) {
  eval::match_request request = request_of(15, "color_fuzzy", 128, 20);
  request.levels = 16;
  self_test_frames frames(seeds_of(3, 16, 1), 1);
  frames.next(request.left, request.right);
  std::array<int, 256> found{};
  const eval::disparity_map map = native("color_fuzzy", request);
  for (std::size_t i = 0; i < map.disparity.size(); ++i) found[map.defined[i] != 0 ? map.disparity[i] : 255] += 1;
  EXPECT_GT(found[8], 600);
  EXPECT_GT(found[4], 600);
}

/// boards/cores.json says how large the designs are; the designs' sources do, too.
TEST(board, table_of_cores_agrees_with_the_designs) {
  std::ifstream file(EPILINE_BOARDS "/cores.json");
  const auto cores = nlohmann::json::parse(file);
  const auto expect = [&]<class Config>(const char* core) {
    EXPECT_EQ(cores[core]["max_width"], Config::max_width) << core;
    EXPECT_EQ(cores[core]["max_height"], Config::max_height) << core;
    EXPECT_EQ(cores[core]["max_levels"], Config::levels) << core;
  };
  expect.operator()<tops::color_fuzzy_config>("color_fuzzy");
  expect.operator()<tops::adaptive_ca_config>("adaptive_ca");
  expect.operator()<tops::few_levels_of<tops::color_fuzzy_config>>("color_fuzzy_small");
  expect.operator()<tops::few_levels_of<tops::adaptive_ca_config>>("adaptive_ca_small");
}

}  // namespace
}  // namespace epiline::board
