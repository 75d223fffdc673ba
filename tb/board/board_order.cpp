#include "board/board_order.hpp"

#include <fmt/format.h>

#include "csim/frame_beats.hpp"

namespace epiline::board {
namespace {

constexpr std::size_t call_arguments = 16;  // of 16 bits each
constexpr std::uint8_t match_mode = 0;
constexpr std::uint8_t self_test_mode = 1;

std::size_t beats_a_frame(const board_identity& identity, int width, int height) {
  return std::size_t{csim::beats_a_row(width, identity.pixels_per_beat)} * static_cast<std::size_t>(height);
}

std::uint64_t argument_value(const eval::match_request& request, const std::string& name) {
  if (name == "width") return static_cast<std::uint64_t>(request.left.width);
  if (name == "height") return static_cast<std::uint64_t>(request.left.height);
  if (name == "levels") return static_cast<std::uint64_t>(request.levels);
  return static_cast<std::uint64_t>(request.parameters.at(name));
}

bytes order(const board_identity& identity, const eval::match_request& request, std::uint8_t mode, std::uint32_t frames,
            const generator_seeds& seeds) {
  bytes made{mode};
  append_little_endian(made, beats_a_frame(identity, request.left.width, request.left.height), 3);
  append_little_endian(made, frames, 4);
  append_little_endian(made, seeds.left_near, 8);
  append_little_endian(made, seeds.left_far, 8);
  append_little_endian(made, seeds.right, 8);
  for (std::size_t i = 0; i < call_arguments; ++i) {
    append_little_endian(made, i < identity.arguments.size() ? argument_value(request, identity.arguments[i]) : 0, 2);
  }
  return made;
}

/// The bytes of a lane's bits of a token, the lowest first.
void append_data(bytes& to, const csim::beat& token, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) to.push_back(static_cast<std::uint8_t>(token.data[i / 4] >> (8 * (i % 4))));
}

}  // namespace

void check_fits(const board_identity& identity, const eval::match_request& request, const std::string& where) {
  const auto require = [&](const char* what, int value, int most) {
    if (value <= most) return;
    throw eval::engine_error(fmt::format(
        "the board at {} holds {}, which takes at most {} {}, not {}: {}", where, identity.core, most, what, value,
        std::string_view(what) == "levels" ? "choose fewer --levels, or load a larger design"
                                           : "crop or shrink the images, or load a larger "
                                             "design"));
  };
  require("columns", request.left.width, identity.max_width);
  require("rows", request.left.height, identity.max_height);
  require("levels", request.levels, identity.max_levels);
  for (const std::string& name : identity.arguments) {
    if (name == "width" || name == "height" || name == "levels" || request.parameters.contains(name)) continue;
    throw eval::engine_error(fmt::format(
        "the board at {} wants a parameter '{}', which {} does not have here: load a bitstream of this version", where,
        name, identity.design));
  }
  if (identity.arguments.size() > call_arguments) {
    throw eval::engine_error(fmt::format("the board at {} wants {} parameters, which is more than {}", where,
                                         identity.arguments.size(), call_arguments));
  }
}

bytes frame_order(const board_identity& identity, const eval::match_request& request) {
  bytes made = order(identity, request, match_mode, 1, {});
  const auto left = csim::beats_of_image(request.left, identity.pixels_per_beat);
  const auto right = csim::beats_of_image(request.right, identity.pixels_per_beat);
  const std::size_t beat_bytes = static_cast<std::size_t>(identity.pixels_per_beat) * csim::input_lane_bits / 8;
  for (std::size_t i = 0; i < left.size(); ++i) {
    append_data(made, left[i], beat_bytes);
    append_data(made, right[i], beat_bytes);
  }
  return made;
}

bytes self_test_order(const board_identity& identity, const eval::match_request& request, std::uint32_t frames,
                      const generator_seeds& seeds) {
  return order(identity, request, self_test_mode, frames, seeds);
}

std::size_t result_bytes(const board_identity& identity, int width, int height) {
  return beats_a_frame(identity, width, height) * static_cast<std::size_t>(identity.pixels_per_beat);
}

eval::disparity_map map_of_results(const board_identity& identity, const bytes& results, int width, int height) {
  const unsigned row_beats = csim::beats_a_row(width, identity.pixels_per_beat);
  const auto lanes = static_cast<std::size_t>(identity.pixels_per_beat);
  // The board sends the disparities without their marks, which its design has proved in simulation.
  std::vector<csim::beat> beats(results.size() / lanes);
  for (std::size_t i = 0; i < beats.size(); ++i) {
    const auto in_row = static_cast<unsigned>(i % row_beats);
    beats[i].user = i == 0 ? 1 : 0;
    beats[i].last = in_row + 1 == row_beats;
    beats[i].keep = csim::keep_bits(width, in_row, identity.pixels_per_beat, csim::disparity_lane_bits);
    beats[i].data[0] = static_cast<std::uint32_t>(little_endian(results, i * lanes, lanes));
  }
  return csim::map_of_beats(beats, width, height, identity.pixels_per_beat);
}

bytes results_of_map(const board_identity& identity, const eval::disparity_map& map) {
  const int lanes = identity.pixels_per_beat;
  const int row = static_cast<int>(csim::beats_a_row(map.width, lanes)) * lanes;
  bytes results;
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < row; ++x) {
      const bool defined = x < map.width && map.defined[map.index(x, y)] != 0;
      results.push_back(defined ? static_cast<std::uint8_t>(0x80 | map.disparity[map.index(x, y)]) : 0);
    }
  }
  return results;
}

self_test_report report_of_results(const bytes& report) {
  return {static_cast<std::uint32_t>(little_endian(report, 0, 4)),
          static_cast<std::uint32_t>(little_endian(report, 4, 4)),
          static_cast<std::uint32_t>(little_endian(report, 8, 4))};
}

}  // namespace epiline::board
