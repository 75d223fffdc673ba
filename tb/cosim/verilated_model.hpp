#pragma once
// What the bindings written by make_model.py share: moving bits between token words and Verilator's signal types, and
// the clocking of a Verilator model.

#include <verilated.h>
#include <verilated_syms.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "cosim/model.hpp"
#include "cosim/token_list.hpp"

namespace epiline::cosim {

/// Bits [offset, offset + width) of `token` into a signal of that width.
template <class Signal>
void put_field(Signal& signal, std::span<const std::uint32_t> token, unsigned offset, unsigned width) {
  signal = static_cast<Signal>(bits_at(token, offset, width));
}
template <std::size_t Words>
void put_field(VlWide<Words>& signal, std::span<const std::uint32_t> token, unsigned offset, unsigned width) {
  for (unsigned word = 0; word < Words; ++word) {
    const unsigned rest = width - 32 * word;
    signal[word] = static_cast<EData>(bits_at(token, offset + 32 * word, rest < 32 ? rest : 32));
  }
}

/// A signal of `width` bits into bits [offset, offset + width) of `token`.
template <class Signal>
void get_field(const Signal& signal, std::span<std::uint32_t> token, unsigned offset, unsigned width) {
  set_bits_at(token, offset, width, signal);
}
template <std::size_t Words>
void get_field(const VlWide<Words>& signal, std::span<std::uint32_t> token, unsigned offset, unsigned width) {
  for (unsigned word = 0; word < Words; ++word) {
    const unsigned rest = width - 32 * word;
    set_bits_at(token, offset + 32 * word, rest < 32 ? rest : 32, signal[word]);
  }
}

/// `Top` is the class Verilator wrote. Registers and memories without a reset start with random bits of `seed`, so that
/// a design which trusts them gives results that change with the seed.
template <class Top>
class verilated_model : public rtl_model {
 public:
  /// `more`: what the constructor of `Top` takes after the context.
  template <class... More>
  explicit verilated_model(std::uint64_t seed, More&&... more) {
    context_.randReset(2);
    context_.randSeed(static_cast<int>(seed % 0x7ffffffeu) + 1);
    top_ = std::make_unique<Top>(&context_, std::forward<More>(more)...);
  }
  ~verilated_model() override { top_->final(); }

  /// The FIFO's counters are public signals; the scope they are in ends with the module's, or its instance's, name.
  std::optional<fifo_fill> fill(std::size_t fifo) const override {
    for (const char* instance : {"", "_instance"}) {
      const std::string wanted = "." + name_ + instance + "." + fifos_.at(fifo).instance;
      for (const auto& [name, scope] : *Verilated::scopeNameMap()) {
        const VerilatedVar* fill = scope->varFind("fill");
        const VerilatedVar* peak = scope->varFind("peak");
        if (std::string_view(name).ends_with(wanted) && fill != nullptr && peak != nullptr)
          return fifo_fill{number_of(*fill), number_of(*peak)};
      }
    }
    return {};
  }

  void set_reset(bool active) override { top_->rst = active; }
  void settle() override {
    top_->clk = 0;
    top_->eval();
  }
  void rising_edge() override {
    top_->clk = 1;
    top_->eval();
  }

 private:
  static unsigned number_of(const VerilatedVar& variable) {
    switch (variable.vltype()) {
      case VLVT_UINT8:
        return *static_cast<const CData*>(variable.datap());
      case VLVT_UINT16:
        return *static_cast<const SData*>(variable.datap());
      case VLVT_UINT32:
        return *static_cast<const IData*>(variable.datap());
      default:
        return 0;  // no FIFO is that deep
    }
  }

 protected:
  VerilatedContext context_;
  std::unique_ptr<Top> top_;
};

}  // namespace epiline::cosim
