#pragma once
// The host's end of the link to a board: finds out who is there, and moves bytes both ways over a line that may lose,
// change and repeat them, and to a board that may be reset meanwhile. The other end is boards/common/board_link.v.

#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <random>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "board/packet.hpp"
#include "board/serial_port.hpp"

namespace epiline::board {

/// The board does not answer, or not as it should; what() says what, where, and what to do.
class link_error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What a board says of itself.
struct board_identity {
  std::string board;
  std::string core;    // the generated module
  std::string design;  // the method it implements, of the table of designs
  int pixels_per_beat = 0;
  int max_width = 0;
  int max_height = 0;
  int max_levels = 0;
  double clock = 0;                    // of the design, in Hz
  std::vector<std::string> arguments;  // of a call, in order

  /// Throws link_error when the text is not understood; `where` names the port.
  [[nodiscard]] static board_identity parse(const std::string& text, const std::string& where);
};

struct link_statistics {
  std::uint64_t data_packets = 0;
  std::uint64_t resent_packets = 0;
  std::uint64_t repeated_reads = 0;        // results asked for again
  std::uint64_t restarts = 0;              // sessions begun again because the board was reset
  std::uint64_t bad_packets = 0;           // arrived damaged at the host
  std::uint64_t bad_packets_of_board = 0;  // at the board, since its reset, as far as it has said
};

struct link_options {
  std::chrono::milliseconds patience{5'000};  // for a board that says nothing
  std::chrono::milliseconds stuck{20'000};    // for one that answers but does not go on
};

class board_link {
 public:
  /// `port` must outlive the link.
  explicit board_link(serial_port& port, link_options options = {});

  /// Throws link_error when nobody answers within the patience, or someone who is no board of Epiline's; port_error
  /// when the port goes away.
  [[nodiscard]] board_identity identify();

  /// Sends `order_bytes` to the design and returns the `result_count` bytes that come back. If the board is reset
  /// meanwhile, begins again. `progress` is told the share done, 0..1, now and then; it may be empty. `longest_pause`,
  /// if longer than the options' `stuck`: how long the design may work without a byte moving.
  [[nodiscard]] bytes run(std::span<const std::uint8_t> order_bytes, std::size_t result_count,
                          const std::function<void(double)>& progress,
                          std::chrono::milliseconds longest_pause = std::chrono::milliseconds{0});

  [[nodiscard]] const link_statistics& statistics() const { return statistics_; }

 private:
  using clock = std::chrono::steady_clock;
  class session;
  friend class session;

  /// Sends what waits, as far as there is room, waits for an answer, and returns what came.
  [[nodiscard]] std::vector<packet> exchange(std::chrono::milliseconds longest);
  void send(const packet& packet);
  /// Lets the board measure the line's rate, in case it does not know it.
  void send_rate();
  void begin_session();

  serial_port& port_;
  link_options options_;
  link_statistics statistics_;
  packet_decoder decoder_;
  std::deque<std::uint8_t> to_send_;
  std::uint64_t received_bytes_ = 0;
  std::uint16_t session_ = 0;
  std::mt19937 random_;
};

}  // namespace epiline::board
