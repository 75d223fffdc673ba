#include "board/commands.hpp"

#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "board/self_test.hpp"
#include "eval/frame_job.hpp"
#include "eval/output_file.hpp"

namespace epiline::board {
namespace {

struct board_options {
  std::string port;
  int baud = 3'000'000;
  int patience_milliseconds = 5'000;

  void add_to(CLI::App& command) {
    command.add_option("--port", port, "the board's serial port, for example /dev/ttyUSB0")
        ->option_text("PORT")
        ->required();
    command.add_option("--baud", baud, "its rate (default 3000000)")->option_text("N");
    command.add_option("--patience", patience_milliseconds, "milliseconds that it may say nothing (default 5000)")
        ->option_text("N")
        ->check(CLI::Range(100, 600'000));
  }
  [[nodiscard]] link_options link() const { return {.patience = std::chrono::milliseconds(patience_milliseconds)}; }
};

struct self_test_options : board_options {
  std::uint32_t frames = 10;
  std::optional<int> width;
  std::optional<int> height;
  std::optional<int> levels;
  std::uint64_t seed = 1;
  std::vector<std::string> settings;
  std::string json;
};

std::string text_of(const board_identity& identity) {
  return fmt::format("{}: {} (design {}), {} pixel{} a clock, up to {}x{}, {} levels, {:g} MHz", identity.board,
                     identity.core, identity.design, identity.pixels_per_beat, identity.pixels_per_beat == 1 ? "" : "s",
                     identity.max_width, identity.max_height, identity.max_levels, identity.clock / 1e6);
}

void identify(const board_options& options) {
  serial_port port(options.port, options.baud);
  fmt::print("{}\n", text_of(board_link(port, options.link()).identify()));
}

bool self_test(const self_test_options& options, const eval::engine_registry& registry) {
  if (!options.json.empty()) eval::require_writable(options.json);
  serial_port port(options.port, options.baud);
  board_link link(port, options.link());
  const board_identity identity = link.identify();
  fmt::print("{}\n", text_of(identity));

  const eval::design_description& design = eval::require_design(identity.design);
  eval::match_request request;
  const int width = options.width.value_or(std::min(640, identity.max_width));
  const int height = options.height.value_or(std::min(480, identity.max_height));
  request.left = request.right = eval::rgb_image(width, height);
  request.levels = options.levels.value_or(identity.max_levels);
  request.parameters = eval::default_parameters(design);
  for (const auto& setting : options.settings) eval::apply_setting(request, setting);
  check_request(design, request);
  check_fits(identity, request, options.port);

  const generator_seeds seeds = seeds_of(options.seed, request.levels, identity.pixels_per_beat);
  const self_test_report report = run_self_test(link, identity, request, options.frames, seeds);
  const auto native = registry.find(design.name, "native")->make(design);
  const std::uint32_t expected = expected_crc(identity, request, options.frames, seeds, *native);

  // The first frame also fills the pipeline; each further one takes what the rate is made of.
  const double a_frame = options.frames > 1
                             ? static_cast<double>(report.all_clocks - report.first_frame_clocks) / (options.frames - 1)
                             : static_cast<double>(report.all_clocks);
  const double frames_a_second = identity.clock / a_frame;
  const bool equal = report.crc == expected;
  fmt::print("{} frames of {}x{}, {} levels: {} clocks, {:.1f} a frame = {:.1f} frames/s at {:g} MHz\n", options.frames,
             width, height, request.levels, report.all_clocks, a_frame, frames_a_second, identity.clock / 1e6);
  fmt::print("CRC-32 of all disparities {:08x}, native {:08x}: {}\n", report.crc, expected,
             equal ? "equal" : "DIFFERENT");
  if (!options.json.empty()) {
    nlohmann::ordered_json json;
    json["board"] = identity.board;
    json["core"] = identity.core;
    json["design"] = identity.design;
    json["frames"] = options.frames;
    json["width"] = width;
    json["height"] = height;
    json["levels"] = request.levels;
    json["parameters"] = request.parameters;
    json["seed"] = options.seed;
    json["clocks"] = report.all_clocks;
    json["first_frame_clocks"] = report.first_frame_clocks;
    json["clocks_a_frame"] = a_frame;
    json["clock_hz"] = identity.clock;
    json["frames_per_second"] = frames_a_second;
    json["crc"] = report.crc;
    json["native_crc"] = expected;
    json["equal"] = equal;
    eval::write_whole_file(options.json, json.dump(2) + "\n");
  }
  return equal;
}

}  // namespace

void add_board_command(CLI::App& application, const eval::engine_registry& registry, int& exit_code) {
  auto* command =
      application.add_subcommand("board", "ask a board at a serial port who it is, or test it at full speed");
  command->require_subcommand(1);

  auto* identify_command = command->add_subcommand("identify", "say what the board holds");
  const auto identify_options = std::make_shared<board_options>();
  identify_options->add_to(*identify_command);
  identify_command->callback([identify_options] { identify(*identify_options); });

  auto* test = command->add_subcommand(
      "self-test", "the board matches frames that it generates, without a pause; compare with native and count clocks");
  const auto options = std::make_shared<self_test_options>();
  options->add_to(*test);
  test->add_option("--frames", options->frames, "how many (default 10)")
      ->option_text("N")
      ->check(CLI::Range(1, 1'000'000));
  test->add_option("--width", options->width, "columns (default 640, or the most)")->option_text("N");
  test->add_option("--height", options->height, "rows (default 480, or the most)")->option_text("N");
  test->add_option("--levels", options->levels, "disparity levels (default the most)")->option_text("N");
  test->add_option("--seed", options->seed, "of the pictures (default 1)")
      ->option_text("N")
      ->check(CLI::NonNegativeNumber);
  test->add_option("--set", options->settings, "run-time parameter NAME=VALUE; may be repeated")
      ->option_text("NAME=VALUE")
      ->allow_extra_args(false);
  test->add_option("--json", options->json, "the figures")->option_text("FILE");
  test->callback([options, &registry, &exit_code] { exit_code = self_test(*options, registry) ? 0 : 1; });
}

}  // namespace epiline::board
