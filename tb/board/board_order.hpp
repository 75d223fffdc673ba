#pragma once
// What a board is told to do, and what it sends back, as bytes: boards/common/board_job.v has the other side.

#include <array>
#include <cstdint>

#include "board/board_link.hpp"
#include "eval/engine.hpp"

namespace epiline::board {

/// The self-test's three sequences of pixels; see self_test.hpp.
struct generator_seeds {
  std::uint64_t left_near = 0;
  std::uint64_t left_far = 0;
  std::uint64_t right = 0;
};

/// What the self-test found out.
struct self_test_report {
  std::uint32_t crc = 0;                 // CRC-32 of the bytes of all disparities
  std::uint32_t first_frame_clocks = 0;  // from the first beat in to the first frame's last beat out, both counted
  std::uint32_t all_clocks = 0;          // to the last frame's
};
inline constexpr std::size_t self_test_report_bytes = 16;

/// Throws eval::engine_error when the request is too large for what the board holds, or the board wants an argument
/// that is no parameter of the request; `where` names the port.
void check_fits(const board_identity& identity, const eval::match_request& request, const std::string& where);

/// A frame: the order and both pictures. The request fits the board.
[[nodiscard]] bytes frame_order(const board_identity& identity, const eval::match_request& request);

/// A self-test of `frames` frames of the request's size, whose pixels do not matter.
[[nodiscard]] bytes self_test_order(const board_identity& identity, const eval::match_request& request,
                                    std::uint32_t frames, const generator_seeds& seeds);

/// Bytes of a frame's disparities.
[[nodiscard]] std::size_t result_bytes(const board_identity& identity, int width, int height);

/// Throws csim::malformed_frame when they are no map of this size.
[[nodiscard]] eval::disparity_map map_of_results(const board_identity& identity, const bytes& results, int width,
                                                 int height);
/// The counterpart.
[[nodiscard]] bytes results_of_map(const board_identity& identity, const eval::disparity_map& map);

/// `report` holds self_test_report_bytes.
[[nodiscard]] self_test_report report_of_results(const bytes& report);

}  // namespace epiline::board
