#include "board/serial_port.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/serial.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

namespace epiline::board {
namespace {

struct line_rate {
  int baud;
  speed_t code;
};
constexpr line_rate rates[] = {{115'200, B115200},    {230'400, B230400},    {460'800, B460800},
                               {500'000, B500000},    {921'600, B921600},    {1'000'000, B1000000},
                               {1'500'000, B1500000}, {2'000'000, B2000000}, {3'000'000, B3000000}};

speed_t code_of(int baud) {
  const auto* const found = std::ranges::find(rates, baud, &line_rate::baud);
  if (found != std::end(rates)) return found->code;
  std::string known;
  for (const auto& rate : rates) known += fmt::format("{}{}", known.empty() ? "" : ", ", rate.baud);
  throw port_error(fmt::format("--baud {}: choose one of {}", baud, known));
}

std::string why_not_opened(const std::string& path, int error) {
  switch (error) {
    case ENOENT:
    case ENODEV:
    case ENXIO:
      return fmt::format(
          "there is no serial port '{}': is the board plugged in and powered? ls /dev/ttyUSB* shows the ports", path);
    case EACCES:
    case EPERM:
      return fmt::format(
          "no permission to open '{}': add yourself to the group dialout (sudo adduser $USER dialout) and log in anew",
          path);
    case EBUSY:
      return fmt::format("serial port '{}' is in use by another program: close that", path);
    default:
      return fmt::format("cannot open serial port '{}': {}", path, std::strerror(error));
  }
}

}  // namespace

serial_port::serial_port(std::string path, int baud) : path_(std::move(path)), baud_(baud) {
  const speed_t speed = code_of(baud);
  descriptor_ = open(path_.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor_ < 0) throw port_error(why_not_opened(path_, errno));
  const auto refuse = [this](const std::string& why) {
    close(descriptor_);
    throw port_error(why);
  };
  if (isatty(descriptor_) == 0) refuse(fmt::format("'{}' is not a serial port", path_));
  if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0) refuse(why_not_opened(path_, EBUSY));
  termios settings{};
  if (tcgetattr(descriptor_, &settings) != 0) {
    refuse(fmt::format("'{}' is not a serial port: {}", path_, std::strerror(errno)));
  }
  cfmakeraw(&settings);
  settings.c_cflag &= ~static_cast<tcflag_t>(CSTOPB | CRTSCTS);
  settings.c_cflag |= CLOCAL | CREAD;
  settings.c_cc[VMIN] = 0;
  settings.c_cc[VTIME] = 0;
  cfsetispeed(&settings, speed);
  cfsetospeed(&settings, speed);
  if (tcsetattr(descriptor_, TCSANOW, &settings) != 0) {
    refuse(fmt::format("serial port '{}' does not take {} baud: {}; try a lower --baud", path_, baud,
                       std::strerror(errno)));
  }
  // USB chips hold short answers back for 16 ms unless asked not to; a port that knows nothing of it says so, and is
  // right.
  serial_struct details{};
  if (ioctl(descriptor_, TIOCGSERIAL, &details) == 0) {
    details.flags |= ASYNC_LOW_LATENCY;
    (void)ioctl(descriptor_, TIOCSSERIAL, &details);
  }
  tcflush(descriptor_, TCIOFLUSH);
}

serial_port::~serial_port() { close(descriptor_); }

void serial_port::gone(const std::string& why) const {
  throw port_error(fmt::format("serial port '{}' is gone ({}): was the board unplugged?", path_, why));
}

void serial_port::wait(bool to_write, std::chrono::milliseconds longest) {
  pollfd request{descriptor_, static_cast<short>(POLLIN | (to_write ? POLLOUT : 0)), 0};
  if (poll(&request, 1, static_cast<int>(longest.count())) < 0 && errno != EINTR) gone(std::strerror(errno));
  if ((request.revents & (POLLERR | POLLNVAL)) != 0 || (request.revents & (POLLHUP | POLLIN)) == POLLHUP) {
    gone("the line was hung up");
  }
}

std::vector<std::uint8_t> serial_port::read() {
  std::array<std::uint8_t, 4096> buffer{};
  const ssize_t count = ::read(descriptor_, buffer.data(), buffer.size());
  if (count < 0) {
    if (errno == EAGAIN || errno == EINTR) return {};
    gone(std::strerror(errno));
  }
  return {buffer.begin(), buffer.begin() + count};
}

std::size_t serial_port::write(std::span<const std::uint8_t> data) {
  if (data.empty()) return 0;
  const ssize_t count = ::write(descriptor_, data.data(), data.size());
  if (count < 0) {
    if (errno == EAGAIN || errno == EINTR) return 0;
    gone(std::strerror(errno));
  }
  return static_cast<std::size_t>(count);
}

}  // namespace epiline::board
