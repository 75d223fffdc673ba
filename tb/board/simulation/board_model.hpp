#pragma once
// The whole board in simulation, from the pins: clock, serial line, button, lamps.

#include <verilated.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace epiline::board {

class board_model {
 public:
  board_model() = default;
  board_model(const board_model&) = delete;
  board_model& operator=(const board_model&) = delete;
  virtual ~board_model() = default;

  /// One clock of the design (the PLL's model lets its input through) with these levels at the pins.
  virtual void clock(bool line_to_board, bool reset_button) = 0;
  [[nodiscard]] virtual bool line_from_board() const = 0;
  [[nodiscard]] virtual unsigned lamps() const = 0;
};

/// `Top` is the class Verilator made of the board's top. Registers without a reset start with random bits of `seed`.
template <class Top>
class verilated_board final : public board_model {
 public:
  explicit verilated_board(std::uint64_t seed) {
    context_.randReset(2);
    context_.randSeed(static_cast<int>(seed % 0x7ffffffeu) + 1);
    top_ = std::make_unique<Top>(&context_);
  }
  ~verilated_board() override { top_->final(); }

  void clock(bool line_to_board, bool reset_button) override {
    top_->ftdi_txd = line_to_board;
    top_->fire1 = reset_button;
    top_->clk_25mhz = 0;
    top_->eval();
    top_->clk_25mhz = 1;
    top_->eval();
  }
  [[nodiscard]] bool line_from_board() const override { return top_->ftdi_rxd != 0; }
  [[nodiscard]] unsigned lamps() const override { return top_->led; }

 private:
  VerilatedContext context_;
  std::unique_ptr<Top> top_;
};

/// A design that the simulator was built with.
struct simulated_core {
  const char* name;
  std::unique_ptr<board_model> (*make)(std::uint64_t seed);
};
/// Written by CMake.
extern const std::vector<simulated_core> simulated_cores;

}  // namespace epiline::board
