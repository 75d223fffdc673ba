// The board with a design of 80 levels, on a part of a real pair: the map is native's, and the self-test's clocks a
// frame are hardly more than its pixels. Skipped without real pairs.

#include <gtest/gtest.h>

#include "board/board_order.hpp"
#include "board/self_test.hpp"
#include "csim/engines.hpp"
#include "eval/image_files.hpp"
#include "simulated_board.hpp"

namespace epiline::board {
namespace {

eval::rgb_image part_of(const std::filesystem::path& folder, const std::string& stem, int left, int top, int width,
                        int height) {
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    if (file.path().stem() != stem) continue;
    const eval::rgb_image whole = eval::read_stereo_image(file.path());
    eval::rgb_image part(width, height);
    for (int y = 0; y < height; ++y) std::copy_n(whole.at(left, top + y), 3 * width, part.at(0, y));
    return part;
  }
  throw std::runtime_error("no " + stem + " in " + folder.string());
}

TEST(full_size_board, matches_a_part_of_a_real_pair_like_native) {
  const char* data = std::getenv("EPILINE_DATA");
  const std::filesystem::path folder =
      std::filesystem::path(data != nullptr ? data : EPILINE_SOURCE_FOLDER "/../shared/data") / "tsukuba";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no real pair in " << folder;

  test::simulated_board board({});
  serial_port port(board.port(), 3'000'000);
  board_link link(port, {.patience = std::chrono::seconds(300), .stuck = std::chrono::seconds(600)});
  const board_identity identity = link.identify();
  eval::engine_registry engines;
  csim::register_engines(engines);
  const auto native = engines.find(identity.design, "native")->make(*eval::find_design(identity.design));

  const int width = std::min(160, identity.max_width);
  const int height = 48;
  eval::match_request request;
  request.left = part_of(folder, "left", 100, 100, width, height);
  request.right = part_of(folder, "right", 100, 100, width, height);
  request.levels = std::min(16, identity.max_levels);
  request.parameters = eval::default_parameters(*eval::find_design(identity.design));
  const bytes results = link.run(frame_order(identity, request), result_bytes(identity, width, height), {});
  const eval::disparity_map expected = native->match(request, {}).map;
  EXPECT_EQ(map_of_results(identity, results, width, height), expected);
  EXPECT_GT(std::ranges::count(expected.defined, 1), width * height / 2);

  request.levels = identity.max_levels;
  const generator_seeds seeds = seeds_of(1, request.levels, identity.pixels_per_beat);
  const self_test_report report = run_self_test(link, identity, request, 3, seeds);
  EXPECT_EQ(report.crc, expected_crc(identity, request, 3, seeds, *native));
}

}  // namespace
}  // namespace epiline::board
