// A board in simulation behind a pseudo-terminal: the same host command that speaks to a real board speaks to it.

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "board/simulation/board_model.hpp"
#include "board/simulation/serial_line.hpp"

namespace epiline::board {
namespace {

volatile std::sig_atomic_t stop_asked = 0;
void ask_to_stop(int /*signal*/) { stop_asked = 1; }

struct simulator_options {
  std::string core;
  std::string link;
  std::string statistics;
  double clocks_a_bit = 8;
  std::uint64_t seed = 1;
  line_faults faults;
  std::vector<std::uint64_t> reset_after;  // bytes from the host
  std::uint64_t silence_after = 0;
  std::uint64_t unplug_after = 0;
};

/// Both ends of a pseudo-terminal; the second stays open, so that programs may come and go.
class pseudo_terminal {
 public:
  pseudo_terminal() {
    master_ = posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK);
    if (master_ < 0 || grantpt(master_) != 0 || unlockpt(master_) != 0) fail("no pseudo-terminal");
    name_ = ptsname(master_);
    slave_ = open(name_.c_str(), O_RDWR | O_NOCTTY);
    termios settings{};
    if (slave_ < 0 || tcgetattr(slave_, &settings) != 0) fail(name_);
    cfmakeraw(&settings);
    if (tcsetattr(slave_, TCSANOW, &settings) != 0) fail(name_);
  }
  pseudo_terminal(const pseudo_terminal&) = delete;
  pseudo_terminal& operator=(const pseudo_terminal&) = delete;
  ~pseudo_terminal() { unplug(); }

  [[nodiscard]] const std::string& name() const { return name_; }

  /// What has come from the host, at most `most` bytes; waits up to `wait` milliseconds for the first.
  [[nodiscard]] std::vector<std::uint8_t> read(std::size_t most, int wait) const {
    if (wait > 0) {
      pollfd request{master_, POLLIN, 0};
      (void)poll(&request, 1, wait);
    }
    std::vector<std::uint8_t> buffer(most);
    const ssize_t count = ::read(master_, buffer.data(), buffer.size());
    buffer.resize(static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
    return buffer;
  }

  /// To the host, as far as there is room; removes that from `bytes`.
  void write(std::deque<std::uint8_t>& bytes) const {
    const std::vector<std::uint8_t> waiting(bytes.begin(), bytes.end());
    const ssize_t count = waiting.empty() ? 0 : ::write(master_, waiting.data(), waiting.size());
    if (count > 0) bytes.erase(bytes.begin(), bytes.begin() + count);
  }

  void unplug() {
    if (slave_ >= 0) close(slave_);
    if (master_ >= 0) close(master_);
    slave_ = master_ = -1;
  }

 private:
  [[noreturn]] static void fail(const std::string& what) {
    throw std::runtime_error(fmt::format("{}: {}", what, std::strerror(errno)));
  }

  int master_ = -1;
  int slave_ = -1;
  std::string name_;
};

class simulator {
 public:
  simulator(const simulator_options& options, board_model& board, pseudo_terminal& terminal)
      : options_(options),
        board_(board),
        terminal_(terminal),
        driver_(options.clocks_a_bit),
        listener_(options.clocks_a_bit),
        to_board_(options.faults, 2 * options.seed),
        to_host_(options.faults, 2 * options.seed + 1) {}

  void run() {
    while (stop_asked == 0) {
      // As many bytes as a USB chip holds, so that the host feels how fast the line is.
      const std::size_t most = chip_bytes - std::min(chip_bytes, to_board_.bytes().size());
      for (const std::uint8_t byte : terminal_.read(most, quiet() ? 20 : 0)) take_from_host(byte);
      if (unplugged_) return;
      for (int i = 0; i < clocks_at_once; ++i) clock();
      if (silent_) to_host_.bytes().clear();
      terminal_.write(to_host_.bytes());
    }
  }

  [[nodiscard]] nlohmann::ordered_json statistics() const {
    const auto counts = [](const fault_counts& of) {
      return nlohmann::ordered_json{
          {"bytes", of.bytes}, {"dropped", of.dropped}, {"flipped", of.flipped}, {"duplicated", of.duplicated}};
    };
    return {{"core", options_.core},
            {"clocks", clocks_},
            {"resets", resets_},
            {"silent", silent_},
            {"unplugged", unplugged_},
            {"to_board", counts(to_board_.counts())},
            {"to_host", counts(to_host_.counts())}};
  }

 private:
  static constexpr std::size_t chip_bytes = 512;
  static constexpr int clocks_at_once = 2'000;
  static constexpr std::uint64_t quiet_clocks = 100'000;  // without a byte: the design has come to rest
  static constexpr int button_clocks = 50;
  static constexpr unsigned testing_lamp = 1u << 3;

  /// Nothing happens until the host says something.
  [[nodiscard]] bool quiet() const {
    return clocks_ - last_byte_ > quiet_clocks && (board_.lamps() & testing_lamp) == 0;
  }

  void take_from_host(std::uint8_t byte) {
    ++host_bytes_;
    if (std::ranges::find(options_.reset_after, host_bytes_) != options_.reset_after.end()) button_ = button_clocks;
    if (options_.silence_after != 0 && host_bytes_ >= options_.silence_after) silent_ = true;
    if (options_.unplug_after != 0 && host_bytes_ >= options_.unplug_after) {
      unplugged_ = true;
      terminal_.unplug();
    }
    to_board_.put(byte);
  }

  void clock() {
    if (driver_.idle() && !to_board_.bytes().empty()) {
      driver_.send(to_board_.bytes().front());
      to_board_.bytes().pop_front();
      last_byte_ = clocks_;
    }
    if (button_ == button_clocks) ++resets_;
    board_.clock(driver_.step(), button_ > 0);
    if (button_ > 0) --button_;
    ++clocks_;
    if (const auto byte = listener_.step(board_.line_from_board())) {
      last_byte_ = clocks_;
      to_host_.put(*byte);
    }
  }

  const simulator_options& options_;
  board_model& board_;
  pseudo_terminal& terminal_;
  line_driver driver_;
  line_listener listener_;
  faulty_queue to_board_;
  faulty_queue to_host_;
  std::uint64_t clocks_ = 0;
  std::uint64_t last_byte_ = 0;
  std::uint64_t host_bytes_ = 0;
  std::uint64_t resets_ = 0;
  int button_ = 0;
  bool silent_ = false;
  bool unplugged_ = false;
};

void simulate(const simulator_options& options) {
  const auto found = std::ranges::find(simulated_cores, std::string_view(options.core),
                                       [](const simulated_core& core) { return std::string_view(core.name); });
  if (found == simulated_cores.end()) throw std::runtime_error(fmt::format("there is no core '{}'", options.core));
  const auto board = found->make(options.seed);
  pseudo_terminal terminal;
  if (!options.link.empty()) {
    std::filesystem::remove(options.link);
    std::filesystem::create_symlink(terminal.name(), options.link);
  }
  fmt::print("{} at {}\n", options.core, options.link.empty() ? terminal.name() : options.link);
  (void)std::fflush(stdout);
  simulator simulation(options, *board, terminal);
  simulation.run();
  if (!options.link.empty()) std::filesystem::remove(options.link);
  if (!options.statistics.empty()) {
    std::ofstream file(options.statistics);
    file << simulation.statistics().dump(2) << '\n';
    if (!file.flush()) throw std::runtime_error(fmt::format("cannot write '{}'", options.statistics));
  }
}

}  // namespace
}  // namespace epiline::board

int main(int argc, char** argv) {
  using namespace epiline::board;
  simulator_options options;
  options.core = simulated_cores.front().name;
  CLI::App application{"A board in simulation behind a pseudo-terminal; prints the port to give to epiline --port",
                       "epiline_board_simulator"};
  std::string cores;
  for (const auto& core : simulated_cores) cores += (cores.empty() ? "" : ", ") + std::string(core.name);
  const CLI::Range chance(0.0, 1.0);
  application.add_option("--core", options.core, "the design: " + cores)->option_text("NAME");
  application.add_option("--link", options.link, "a name for the port, removed at the end")->option_text("PATH");
  application.add_option("--clocks-a-bit", options.clocks_a_bit, "of the serial line, at least 4 (default 8)")
      ->option_text("N")
      ->check(CLI::Range(4.0, 10'000.0));
  application.add_option("--seed", options.seed, "of faults and of registers without reset (default 1)")
      ->option_text("N");
  application.add_option("--drop", options.faults.drop, "chance of a byte to get lost")
      ->option_text("P")
      ->check(chance);
  application.add_option("--flip", options.faults.flip, "chance of a byte to have one bit changed")
      ->option_text("P")
      ->check(chance);
  application.add_option("--duplicate", options.faults.duplicate, "chance of a byte to come twice")
      ->option_text("P")
      ->check(chance);
  application
      .add_option("--reset-after", options.reset_after, "press the reset button at this byte from the host; repeatable")
      ->option_text("N")
      ->allow_extra_args(false);
  application.add_option("--silence-after", options.silence_after, "say nothing any more from this byte on")
      ->option_text("N");
  application.add_option("--unplug-after", options.unplug_after, "pull the cable at this byte, and end")
      ->option_text("N");
  application.add_option("--statistics", options.statistics, "what happened, as JSON, at the end")->option_text("FILE");
  CLI11_PARSE(application, argc, argv);
  try {
    (void)std::signal(SIGTERM, ask_to_stop);
    (void)std::signal(SIGINT, ask_to_stop);
    simulate(options);
  } catch (const std::exception& error) {
    fmt::print(stderr, "epiline_board_simulator: error: {}\n", error.what());
    return 1;
  }
  return 0;
}
