#pragma once
// The scalar arguments of a top as registers: their addresses, and the same for software (C), tools (JSON) and people
// (Markdown). docs/rtl_interface.md says how they behave.

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "dataflow/graph.hpp"

namespace epiline::emit {

/// Bits of AXI4-Lite's data bus, and of a register's words.
inline constexpr unsigned axi_data_bits = 32;

// The registers every map has, and the control register's bits.
inline constexpr unsigned control_address = 0x0;
inline constexpr unsigned calls_address = 0x4;
inline constexpr unsigned first_argument_address = 0x10;
inline constexpr unsigned start_bit = 0;
inline constexpr unsigned hold_bit = 1;
inline constexpr unsigned keep_bit = 2;
inline constexpr unsigned control_bits = 3;

/// One scalar argument: `words` words from `address` on, low bits first.
struct argument_register {
  std::string name;
  unsigned address = 0;  // in bytes
  unsigned words = 1;
  unsigned width = 1;
  unsigned offset = 0;  // its lowest bit in the argument token
  bool is_signed = false;
};

struct register_map {
  std::string top;
  std::string place;  // of the top in its source, "kernel.cpp:12"; may be empty
  dataflow::source_location where;
  unsigned address_bits = 12;
  unsigned argument_bits = 0;   // of the argument token
  bool waits_for_input = true;  // calls start by themselves when input comes; else each one by the bit `start`
  std::vector<argument_register> arguments;

  [[nodiscard]] std::string module() const { return top + "_registers"; }
  /// Of the slave and of the arguments sampled for the call at work.
  [[nodiscard]] unsigned flip_flops() const;
};

/// Arguments in the order of the parameters, each from a word of its own on.
/// Throws std::invalid_argument when the graph has no scalar arguments.
[[nodiscard]] register_map make_register_map(const dataflow::graph& g);

/// Schema "epiline-registers/1".
[[nodiscard]] nlohmann::json to_json(const register_map& map);
/// A header for C99 and C++ with addresses and access functions.
[[nodiscard]] std::string to_c_header(const register_map& map);
[[nodiscard]] std::string to_markdown(const register_map& map);

/// The Verilog of the module map.module(): an AXI4-Lite slave that holds the registers.
[[nodiscard]] std::string emit_axi_lite_slave(const register_map& map);

}  // namespace epiline::emit
