#include "board/self_test.hpp"

#include <algorithm>
#include <chrono>
#include <random>

#include "csim/frame_beats.hpp"

namespace epiline::board {

generator_seeds seeds_of(std::uint64_t seed, int levels, int pixels_per_beat) {
  // A frame's left pixel is the right picture's pixel `disparity` columns before: an older stage of one sequence.
  const auto whole_beats = [&](int disparity) {
    return static_cast<unsigned>(disparity / pixels_per_beat * pixels_per_beat);
  };
  const unsigned far = whole_beats(levels / 4);
  const unsigned near = whole_beats(levels / 2);
  std::mt19937_64 random(seed);
  std::uint64_t start = random();
  while (start == 0) start = random();  // the one state that never changes
  const auto stage = [&](unsigned pixels) {
    pixel_sequence sequence(start);
    sequence.advance(pixels * csim::input_lane_bits);
    return sequence.state();
  };
  return {.left_near = stage(0), .left_far = stage(near - far), .right = stage(near)};
}

self_test_frames::self_test_frames(const generator_seeds& seeds, int pixels_per_beat)
    : left_near_(seeds.left_near),
      left_far_(seeds.left_far),
      right_(seeds.right),
      lanes_(static_cast<unsigned>(pixels_per_beat)) {}

void self_test_frames::next(eval::rgb_image& left, eval::rgb_image& right) {
  const auto put = [](eval::rgb_image& image, int x, int y, std::uint64_t pixel) {
    for (unsigned color = 0; color < 3; ++color)
      image.at(x, y)[color] = static_cast<std::uint8_t>(pixel >> (8 * color));
  };
  const int lanes = static_cast<int>(lanes_);
  for (int y = 0; y < left.height; ++y) {
    for (int first = 0; first < left.width; first += lanes) {
      const std::uint64_t left_beat = ((beat_ / 32) % 2 == 0 ? left_near_ : left_far_).state();
      for (int lane = 0; lane < std::min(lanes, left.width - first); ++lane) {
        const unsigned low = static_cast<unsigned>(lane) * csim::input_lane_bits;
        put(left, first + lane, y, left_beat >> low);
        put(right, first + lane, y, right_.state() >> low);
      }
      for (pixel_sequence* sequence : {&left_near_, &left_far_, &right_}) {
        sequence->advance(lanes_ * csim::input_lane_bits);
      }
      ++beat_;
    }
  }
}

std::uint32_t expected_crc(const board_identity& identity, eval::match_request request, std::uint32_t frames,
                           const generator_seeds& seeds, eval::engine& engine,
                           const std::function<void(double)>& progress) {
  self_test_frames generator(seeds, identity.pixels_per_beat);
  std::uint32_t crc = 0;
  for (std::uint32_t frame = 0; frame < frames; ++frame) {
    generator.next(request.left, request.right);
    crc = crc32_of(results_of_map(identity, engine.match(request, {}).map), crc);
    if (progress) progress(static_cast<double>(frame + 1) / frames);
  }
  return crc;
}

self_test_report run_self_test(board_link& link, const board_identity& identity, const eval::match_request& request,
                               std::uint32_t frames, const generator_seeds& seeds) {
  const double pixels = static_cast<double>(request.left.width) * request.left.height * frames;
  // The board says nothing of how far it is; its simulation runs a thousandth as fast.
  const std::chrono::milliseconds longest(60'000 + static_cast<std::int64_t>(pixels / 100));
  return report_of_results(
      link.run(self_test_order(identity, request, frames, seeds), self_test_report_bytes, {}, longest));
}

}  // namespace epiline::board
