#pragma once
// A serial port in raw mode, eight data bits, no parity, one stop bit, no flow control by wires.

#include <chrono>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace epiline::board {

/// The port cannot be opened or is gone; what() says what, where, and what to do.
class port_error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class serial_port {
 public:
  /// Opens it for this program alone and drops what it has received. Throws port_error.
  serial_port(std::string path, int baud);
  serial_port(const serial_port&) = delete;
  serial_port& operator=(const serial_port&) = delete;
  ~serial_port();

  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] int baud() const { return baud_; }

  /// Waits until something was received, or can be written if `to_write`, or the time is over.
  void wait(bool to_write, std::chrono::milliseconds longest);

  /// What was received so far; perhaps nothing. Throws port_error when the port is gone.
  [[nodiscard]] std::vector<std::uint8_t> read();

  /// Writes as much as there is room for, and returns how much that was. Throws port_error when the port is gone.
  [[nodiscard]] std::size_t write(std::span<const std::uint8_t> data);

 private:
  [[noreturn]] void gone(const std::string& why) const;

  std::string path_;
  int baud_;
  int descriptor_ = -1;
};

}  // namespace epiline::board
