#include "board/board_link.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <sstream>

namespace epiline::board {
namespace {

using namespace std::chrono_literals;
using milliseconds = std::chrono::milliseconds;

// Bytes 0x55: start, data and stop bits alternate, and the board measures the length of a bit.
constexpr std::size_t rate_bytes = 24;
constexpr milliseconds rate_pause = 4ms;        // the line rests before the first packet
constexpr milliseconds question_pause = 200ms;  // before a question is asked again
constexpr std::size_t most_to_send = 1024;  // bytes that wait for the port; more would delay what is to be sent again
constexpr std::uint64_t most_restarts = 20;

/// The board lost the session: it was reset, or another program spoke to it.
struct session_lost {};

int to_int(std::string_view text) {
  int value = -1;
  (void)std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

/// The payload of a state packet.
struct board_state {
  std::uint16_t session;
  std::size_t expected;
  std::size_t room;
  std::uint32_t produced;
  std::uint16_t bad_packets;
  std::uint8_t question;  // the number of the last STATUS
};
constexpr std::size_t state_bytes = 10;

board_state state_of(const packet& from) {
  return {from.session,
          from.place,
          static_cast<std::size_t>(little_endian(from.payload, 0, 2)),
          static_cast<std::uint32_t>(little_endian(from.payload, 2, 4)),
          static_cast<std::uint16_t>(little_endian(from.payload, 6, 2)),
          from.payload[9]};
}

bool is_state(const packet& from) { return from.kind == packet_kind::state && from.payload.size() == state_bytes; }

}  // namespace

board_identity board_identity::parse(const std::string& text, const std::string& where) {
  const auto parts = split(text, ';');
  if (parts.empty() || parts[0] != "epiline 1") {
    throw link_error(
        fmt::format("the board at {} says '{}', which this version does not understand: load a bitstream that was made "
                    "with the same version",
                    where, text));
  }
  std::map<std::string, std::string> values;
  for (std::size_t i = 1; i < parts.size(); ++i) {
    const std::size_t equals = std::min(parts[i].find('='), parts[i].size());
    values[parts[i].substr(0, equals)] = parts[i].substr(std::min(equals + 1, parts[i].size()));
  }
  board_identity identity;
  identity.board = values["board"];
  identity.core = values["core"];
  identity.design = values["design"];
  identity.pixels_per_beat = to_int(values["lanes"]);
  const auto sizes = split(values["size"], 'x');
  if (sizes.size() == 3) {
    identity.max_width = to_int(sizes[0]);
    identity.max_height = to_int(sizes[1]);
    identity.max_levels = to_int(sizes[2]);
  }
  identity.clock = to_int(values["clock"]);
  identity.arguments = split(values["call"], ',');
  if (identity.core.empty() || identity.design.empty() || identity.pixels_per_beat < 1 || identity.max_width < 1 ||
      identity.max_height < 1 || identity.max_levels < 1 || identity.clock < 1 || identity.arguments.empty()) {
    throw link_error(
        fmt::format("the board at {} says '{}', which lacks something: load its bitstream again", where, text));
  }
  return identity;
}

board_link::board_link(serial_port& port, link_options options)
    : port_(port), options_(options), random_(std::random_device{}()) {}

void board_link::send(const packet& packet) {
  for (const std::uint8_t byte : encode(packet)) to_send_.push_back(byte);
}

void board_link::send_rate() {
  to_send_.push_back(0x7e);  // ends what was under way
  to_send_.insert(to_send_.end(), rate_bytes, 0x55);
  const auto deadline = clock::now() + question_pause;
  while (!to_send_.empty() && clock::now() < deadline) (void)exchange(1ms);
  // The port still holds some of it.
  const auto on_the_line = milliseconds(1 + 10'000 * (rate_bytes + 1) / static_cast<std::size_t>(port_.baud()));
  const auto rested = clock::now() + on_the_line + rate_pause;
  while (clock::now() < rested) (void)exchange(1ms);
}

std::vector<packet> board_link::exchange(milliseconds longest) {
  port_.wait(!to_send_.empty(), longest);
  const bytes waiting(to_send_.begin(), to_send_.end());
  const std::size_t written = port_.write(waiting);
  to_send_.erase(to_send_.begin(), to_send_.begin() + static_cast<std::ptrdiff_t>(written));
  std::vector<packet> packets;
  for (const std::uint8_t byte : port_.read()) {
    ++received_bytes_;
    if (auto found = decoder_.take(byte)) packets.push_back(std::move(*found));
  }
  statistics_.bad_packets = decoder_.bad_packets();
  return packets;
}

board_identity board_link::identify() {
  const auto deadline = clock::now() + options_.patience;
  while (clock::now() < deadline) {
    send_rate();
    send({packet_kind::identify, 0, 0, {}});
    const auto again = clock::now() + question_pause;
    while (clock::now() < again) {
      for (const packet& answer : exchange(10ms)) {
        if (answer.kind != packet_kind::identity) continue;
        return board_identity::parse(std::string(answer.payload.begin(), answer.payload.end()), port_.path());
      }
    }
  }
  if (received_bytes_ == 0) {
    throw link_error(fmt::format(
        "no board answers at {} ({} baud, {:.1f} s): is the bitstream loaded (docs/board.md), and is this the "
        "board's port?",
        port_.path(), port_.baud(), std::chrono::duration<double>(options_.patience).count()));
  }
  throw link_error(fmt::format(
      "what answers at {} is no board of Epiline's, or the line is bad: {} bytes came, but no whole packet; "
      "load the bitstream (docs/board.md) or try a lower --baud",
      port_.path(), received_bytes_));
}

void board_link::begin_session() {
  std::uint16_t fresh = session_;
  while (fresh == session_ || fresh == 0) fresh = static_cast<std::uint16_t>(random_());
  session_ = fresh;
  const auto deadline = clock::now() + options_.patience;
  for (int attempt = 0; clock::now() < deadline; ++attempt) {
    if (attempt % 3 == 2) send_rate();
    send({packet_kind::start, session_, 0, {}});
    const auto again = clock::now() + question_pause;
    while (clock::now() < again) {
      for (const packet& answer : exchange(10ms)) {
        if (is_state(answer) && answer.session == session_) return;
      }
    }
  }
  throw link_error(fmt::format("the board at {} stopped answering: reset it or plug it in again", port_.path()));
}

/// One try to bring the bytes over. Data packets go out while the board has room, by go-back-N: after a loss,
/// everything from the lost one on is sent again. Packets are answered in their order, so a loss shows without a clock:
/// the answer to a STATUS tells what became of all that was sent before it. Only a STATUS without an answer is asked
/// again after a while.
class board_link::session {
 public:
  session(board_link& link, std::span<const std::uint8_t> data, std::size_t result_count, milliseconds stuck)
      : link_(link), data_(data), result_count_(result_count), stuck_(stuck) {
    results_.reserve(result_count);
  }

  bytes run(const std::function<void(double)>& progress) {
    while (!complete()) {
      send_reads();
      send_data();
      ask();
      for (const packet& answer : link_.exchange(2ms)) take(answer);
      give_up();
      if (progress) progress(share_done());
    }
    return std::move(results_);
  }

 private:
  /// What had been sent when a STATUS was.
  struct question {
    bool open = false;
    std::size_t sent = 0;   // bytes for the design
    std::size_t asked = 0;  // results that were asked for
  };

  static constexpr std::size_t longest_payload = 512;
  static constexpr std::size_t shortest_payload = 32;
  static constexpr std::size_t first_window = 2048;  // bytes under way; as many more as are acknowledged
  static constexpr std::size_t most_reads = 4;       // of longest_payload; the board queues 15
  static constexpr auto shortest_pause = 50ms;       // for an answer to a STATUS
  static constexpr auto longest_pause = 400ms;
  static constexpr auto pause_of_idle = 4ms;  // between an answer and the next question
  static constexpr auto long_silence = 1s;    // after which the board may have been reset

  [[nodiscard]] bool complete() const { return acknowledged_ == data_.size() && results_.size() == result_count_; }
  [[nodiscard]] double share_done() const {
    return static_cast<double>(acknowledged_ + results_.size()) / static_cast<double>(data_.size() + result_count_);
  }
  [[nodiscard]] bool line_is_full() const { return link_.to_send_.size() >= most_to_send; }

  void send_data() {
    const std::size_t end = std::min(data_.size(), acknowledged_ + std::min(room_, window_));
    while (next_ < end && !line_is_full()) {
      const auto payload = data_.subspan(next_, std::min(payload_, end - next_));
      link_.send({packet_kind::data, link_.session_, static_cast<std::uint32_t>(next_),
                  bytes(payload.begin(), payload.end())});
      ++link_.statistics_.data_packets;
      if (next_ < most_sent_) ++link_.statistics_.resent_packets;
      next_ += payload.size();
      most_sent_ = std::max(most_sent_, next_);
    }
  }

  void send_reads() {
    while (asked_ < produced_ && asked_ - results_.size() < most_reads * longest_payload && !line_is_full()) {
      const std::size_t count = std::min(read_payload_, produced_ - asked_);
      packet read{packet_kind::read, link_.session_, static_cast<std::uint32_t>(asked_), {}};
      append_little_endian(read.payload, count, 2);
      append_little_endian(read.payload, results_.size(), 4);  // the board may drop what lies before
      link_.send(read);
      asked_ += count;
    }
  }

  /// A question when there is nothing else to send, and the last one was answered or has waited too long.
  void ask() {
    const auto now = clock::now();
    if (now - heard_ > long_silence && now - woken_ > long_silence) {
      woken_ = now;
      link_.send_rate();  // after a reset it does not know the rate
    } else if (line_is_full() ||
               now - asked_when_ < (questions_[number_].open ? clock::duration(pause_) : pause_of_idle)) {
      return;
    }
    if (questions_[number_].open) pause_ = std::min<clock::duration>(longest_pause, 2 * pause_);
    ++number_;
    questions_[number_] = {true, next_, asked_};
    asked_when_ = now;
    link_.send({packet_kind::status, link_.session_, number_, {}});
  }

  void take(const packet& answer) {
    if (is_state(answer)) {
      take(state_of(answer));
    } else if (answer.kind == packet_kind::result && answer.session == link_.session_) {
      take_results(answer);
    }
  }

  void take(const board_state& state) {
    heard_ = clock::now();
    if (state.session != link_.session_) throw session_lost{};
    link_.statistics_.bad_packets_of_board = state.bad_packets;
    if (state.expected < acknowledged_ || state.expected > most_sent_) return;  // no answer to anything of this session
    produced_ = std::max<std::size_t>(produced_, state.produced);
    room_ = state.room;
    if (state.expected > acknowledged_) {
      window_ += state.expected - acknowledged_;
      payload_ = std::min(longest_payload, payload_ + 32);
      acknowledged_ = state.expected;
      next_ = std::max(next_, acknowledged_);
      progressed_ = heard_;
    }
    question& asked = questions_[state.question];
    if (!asked.open) return;
    asked.open = false;
    pause_ = shortest_pause;
    if (asked.sent > acknowledged_) send_again();
    if (asked.asked > results_.size()) read_again();
  }

  void take_results(const packet& answer) {
    heard_ = clock::now();
    if (answer.place != results_.size()) return;  // one before it was lost: the next answer to a STATUS tells
    if (results_.size() + answer.payload.size() > result_count_) {
      throw link_error(
          fmt::format("the board at {} sends more than the {} bytes of this size: is it another bitstream?",
                      link_.port_.path(), result_count_));
    }
    results_.insert(results_.end(), answer.payload.begin(), answer.payload.end());
    asked_ = std::max(asked_, results_.size());
    read_payload_ = std::min(longest_payload, read_payload_ + 32);
    progressed_ = heard_;
  }

  void give_up() const {
    const auto now = clock::now();
    if (now - heard_ > link_.options_.patience) {
      throw link_error(fmt::format(
          "the board at {} went silent after {:.0f} % of the work: reset it or plug it in again, and repeat",
          link_.port_.path(), 100 * share_done()));
    }
    if (now - progressed_ > stuck_) {
      throw link_error(fmt::format(
          "the board at {} answers, but its design does not go on after {:.0f} % of the work: press FIRE1 to "
          "reset it, and repeat",
          link_.port_.path(), 100 * share_done()));
    }
  }

  void send_again() {
    next_ = acknowledged_;
    payload_ = std::max(shortest_payload, payload_ / 2);
    window_ = std::max(4 * payload_, window_ / 2);
    for (question& asked : questions_) asked.sent = 0;  // what they knew of was sent before
  }

  void read_again() {
    ++link_.statistics_.repeated_reads;
    asked_ = results_.size();
    read_payload_ = std::max(shortest_payload, read_payload_ / 2);
    for (question& asked : questions_) asked.asked = 0;
  }

  board_link& link_;
  std::span<const std::uint8_t> data_;
  std::size_t result_count_;
  milliseconds stuck_;

  // Bytes of data_: the board has those before acknowledged_, the one at next_ goes out next.
  std::size_t acknowledged_ = 0;
  std::size_t next_ = 0;
  std::size_t most_sent_ = 0;  // next_ at its furthest
  std::size_t room_ = 0;       // for bytes from acknowledged_ on, as the board said last
  std::size_t window_ = first_window;
  std::size_t payload_ = longest_payload;

  bytes results_;
  std::size_t produced_ = 0;  // bytes that the design has put out
  std::size_t asked_ = 0;     // bytes of them that were asked for
  std::size_t read_payload_ = longest_payload;

  std::array<question, 256> questions_{};
  std::uint8_t number_ = 0;  // of the last one

  clock::time_point heard_ = clock::now();  // anything of this session
  clock::time_point asked_when_ = clock::now() - longest_pause;
  clock::time_point woken_ = clock::now();
  clock::time_point progressed_ = clock::now();
  clock::duration pause_ = shortest_pause;
};

bytes board_link::run(std::span<const std::uint8_t> order_bytes, std::size_t result_count,
                      const std::function<void(double)>& progress, milliseconds longest_pause) {
  for (std::uint64_t restarts = 0;; ++restarts) {
    begin_session();
    try {
      return session(*this, order_bytes, result_count, std::max(options_.stuck, longest_pause)).run(progress);
    } catch (const session_lost&) {
      ++statistics_.restarts;
      if (restarts == most_restarts) {
        throw link_error(fmt::format(
            "the board at {} was reset {} times during one frame: is its supply good, or does another program use it?",
            port_.path(), restarts + 1));
      }
    }
  }
}

}  // namespace epiline::board
