#include "schedule/delay_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>

namespace epiline::schedule {

using dataflow::graph;
using dataflow::node;
using dataflow::node_id;
using dataflow::operation;

namespace {

// Speed grade 8, from Lattice's data as nextpnr uses it, wires as measured after routing designs of 20k..60k LUTs.
constexpr delay_parameters ecp5{.launch = 1.22,
                                .capture = 0.10,
                                .lut_level = 0.94,
                                .carry_entry = 0.45,
                                .carry_bit = 0.035,
                                .carry_exit = 1.14,
                                .multiplier = 4.50,
                                .multiplier_width = 18,
                                .distributed_read = 1.10,
                                .distributed_max_words = 64,
                                .memory_setup = 0.30,
                                .block_wire = 1.20,
                                .issue = 1.60,
                                .spread_doubling = 0.40,
                                .block_bits = 18432,
                                .block_max_width = 36};

constexpr delay_parameters hx8k{.launch = 1.40,
                                .capture = 0.47,
                                .lut_level = 1.25,
                                .carry_entry = 0.66,
                                .carry_bit = 0.126,
                                .carry_exit = 1.40,
                                .multiplier = 0,
                                .multiplier_width = 0,
                                .distributed_read = 0,
                                .distributed_max_words = 0,
                                .memory_setup = 0.30,
                                .issue = 2.15,
                                .spread_doubling = 0.50,
                                .block_bits = 4096,
                                .block_max_width = 16};

constexpr delay_parameters generic{.launch = 1.00,
                                   .capture = 0.20,
                                   .lut_level = 0.90,
                                   .carry_entry = 0.50,
                                   .carry_bit = 0.05,
                                   .carry_exit = 0.90,
                                   .multiplier = 4.00,
                                   .multiplier_width = 18,
                                   .distributed_read = 1.20,
                                   .distributed_max_words = 64,
                                   .memory_setup = 0.30,
                                   .issue = 1.50,
                                   .spread_doubling = 0.40,
                                   .block_bits = 18432,
                                   .block_max_width = 36};

// LUTs that one block RAM has to save to be preferred: what a device has of both, roughly (ECP5-85F: 84k and 208).
constexpr double luts_worth_a_block = 100;

// Of a LUT level: a LUT4 holds up to three gates of two inputs.
constexpr double gate = 0.4;

bool is_constant(const graph& g, node_id id) { return g.nodes[id].kind == operation::constant; }

bool has_constant_operand(const graph& g, const node& n) {
  return std::any_of(n.operands.begin(), n.operands.end(), [&](node_id o) { return is_constant(g, o); });
}

/// Bits of an operand that can differ from its extension: what a multiplier really has to multiply.
unsigned significant_width(const graph& g, node_id id) {
  const node& n = g.nodes[id];
  if (n.kind == operation::constant) return std::max(1u, n.value.getSignificantBits());
  if (n.kind == operation::extend_sign) return g.nodes[n.operands[0]].width;
  if (n.kind == operation::extend_zero) return g.nodes[n.operands[0]].width + 1;
  return n.width;
}

/// LUT levels of a reduction of `inputs` bits, with the wide-function multiplexers making it a smooth function.
double reduction_levels(double inputs) { return std::max(0.5, std::log2(std::max(inputs, 1.0)) / 2.0); }

unsigned address_bits(std::uint64_t words) {
  return words <= 1 ? 1u : static_cast<unsigned>(std::bit_width(words - 1));
}

/// Selecting among `words` words of LUT RAM or LUT ROM beyond the 16 that one LUT holds.
double depth_levels(std::uint64_t words) { return 0.5 * std::max(0, static_cast<int>(address_bits(words)) - 4); }

}  // namespace

const char* name_of(storage_kind kind) {
  switch (kind) {
    case storage_kind::logic:
      return "logic";
    case storage_kind::distributed:
      return "distributed";
    case storage_kind::block:
      return "block";
  }
  return "";
}

bool is_wire(const graph& g, node_id id) {
  const node& n = g.nodes[id];
  switch (n.kind) {
    case operation::constant:
    case operation::register_value:
    case operation::concat:
    case operation::slice:
    case operation::extend_zero:
    case operation::extend_sign:
    case operation::bit_not:
      return true;
    case operation::bit_and:
    case operation::bit_or:
    case operation::bit_xor:
      return has_constant_operand(g, n);
    case operation::shift_left:
    case operation::shift_right_logical:
    case operation::shift_right_arithmetic:
      return is_constant(g, n.operands[1]);
    // Every bit is the condition, its inverse or a constant.
    case operation::select:
      return is_constant(g, n.operands[1]) && is_constant(g, n.operands[2]);
    default:
      return false;
  }
}

delay_model::delay_model(std::string_view target) : target_(target) {
  if (target == "ecp5") {
    parameters_ = ecp5;
  } else if (target == "hx8k") {
    parameters_ = hx8k;
  } else if (target == "generic") {
    parameters_ = generic;
  } else {
    throw std::invalid_argument(fmt::format("unknown target '{}': known are ecp5, hx8k and generic", target));
  }
}

double delay_model::delay(const graph& g, node_id id) const {
  const delay_parameters& p = parameters_;
  const node& n = g.nodes[id];
  if (is_wire(g, id)) return 0;
  const auto carry = [&](unsigned width) { return p.carry_entry + p.carry_bit * width + p.carry_exit; };
  switch (n.kind) {
    case operation::read:
      return 0.8 * p.lut_level;  // of one of two registers, masked by its predicate
    case operation::add:
    case operation::subtract:
    case operation::add_or_subtract:
      return n.width == 1 ? gate * p.lut_level : carry(n.width);
    case operation::less_unsigned:
    case operation::less_signed: {
      const unsigned width = g.nodes[n.operands[0]].width;
      return width <= 2 ? p.lut_level : carry(width);
    }
    case operation::multiply: {
      const unsigned a = significant_width(g, n.operands[0]);
      const unsigned b = significant_width(g, n.operands[1]);
      if (n.width == 1) return gate * p.lut_level;
      const unsigned narrow = std::min(a, b);
      if (p.multiplier_width != 0) {
        const unsigned parts = (std::max(a, b) + p.multiplier_width - 1) / p.multiplier_width +
                               (narrow + p.multiplier_width - 1) / p.multiplier_width;
        return p.multiplier + (parts - 2) * carry(n.width);
      }
      return std::max(1.0, std::ceil(std::log2(narrow))) * carry(std::min(n.width, a + b));
    }
    case operation::divide_unsigned:
    case operation::divide_signed:
    case operation::remainder_unsigned:
    case operation::remainder_signed:
      return n.width * (carry(n.width) + 0.8 * p.lut_level);
    case operation::bit_and:
    case operation::bit_or:
    case operation::bit_xor:
      return gate * p.lut_level;
    case operation::shift_left:
    case operation::shift_right_logical:
    case operation::shift_right_arithmetic: {
      const unsigned amount = g.nodes[n.operands[1]].width;
      return 0.75 * p.lut_level * std::min(amount, address_bits(n.width) + 1);
    }
    case operation::equal: {
      const unsigned width = g.nodes[n.operands[0]].width;
      return p.lut_level * reduction_levels(has_constant_operand(g, n) ? width : 2.0 * width);
    }
    case operation::select:
      return (has_constant_operand(g, n) ? gate : 0.8) * p.lut_level;
    case operation::table: {
      const dataflow::table& t = g.tables[n.object];
      return storage(t) == storage_kind::block ? 0 : p.lut_level * (1 + depth_levels(t.values.size()));
    }
    case operation::memory_read: {
      const dataflow::memory& m = g.memories[n.object];
      if (storage(m) == storage_kind::block) return 0;
      return p.distributed_read + p.lut_level * depth_levels(m.words);
    }
    default:
      return 0;
  }
}

int delay_model::latency(const graph& g, node_id id) const {
  const node& n = g.nodes[id];
  if (n.kind == operation::memory_read) return storage(g.memories[n.object]) == storage_kind::block ? 2 : 0;
  if (n.kind == operation::table) return storage(g.tables[n.object]) == storage_kind::block ? 2 : 0;
  return 0;
}

double delay_model::entry(const graph& g, node_id id, std::size_t index) const {
  const node& n = g.nodes[id];
  switch (n.kind) {
    case operation::memory_read:
    case operation::table:
      return latency(g, id) > 0 ? parameters_.memory_setup + parameters_.block_wire : 0;
    case operation::memory_write: {
      const bool block = storage(g.memories[n.object]) == storage_kind::block;
      return parameters_.memory_setup + (block ? parameters_.block_wire : 0) + (index == 2 ? enable_entry() : 0);
    }
    case operation::write:
      return parameters_.memory_setup + (index == 0 ? enable_entry() : 0);
    default:
      return 0;
  }
}

double delay_model::area(const graph& g, node_id id) const {
  const node& n = g.nodes[id];
  if (is_wire(g, id)) return 0;
  const auto operand_width = [&](std::size_t index) { return g.nodes[n.operands[index]].width; };
  switch (n.kind) {
    case operation::read:
      return 0.5 * n.width;
    case operation::add:
    case operation::subtract:
    case operation::add_or_subtract:
      return n.width;
    case operation::less_unsigned:
    case operation::less_signed:
      return operand_width(0);
    case operation::multiply: {
      const unsigned a = significant_width(g, n.operands[0]);
      const unsigned b = significant_width(g, n.operands[1]);
      if (parameters_.multiplier_width != 0) {
        if (std::max(a, b) <= parameters_.multiplier_width) return 0;
        return 2.0 * n.width;
      }
      return static_cast<double>(std::min(a, b)) * std::min(n.width, a + b);
    }
    case operation::divide_unsigned:
    case operation::divide_signed:
    case operation::remainder_unsigned:
    case operation::remainder_signed:
      return 2.0 * n.width * n.width;
    case operation::bit_and:
    case operation::bit_or:
    case operation::bit_xor:
      return 0.5 * n.width;
    case operation::shift_left:
    case operation::shift_right_logical:
    case operation::shift_right_arithmetic:
      return static_cast<double>(n.width) * std::min(operand_width(1), address_bits(n.width));
    case operation::equal:
      return (has_constant_operand(g, n) ? 1.0 : 2.0) * operand_width(0) / 3.0;
    case operation::select:
      return (has_constant_operand(g, n) ? 0.5 : 1.0) * n.width;
    case operation::table: {
      const dataflow::table& t = g.tables[n.object];
      if (storage(t) == storage_kind::block) return 0;
      return 1.2 * n.width * std::max(1.0, static_cast<double>(t.values.size()) / 16.0);
    }
    case operation::memory_read: {
      const dataflow::memory& m = g.memories[n.object];
      if (storage(m) == storage_kind::block) return 0;
      return distributed_area(m.words, n.width);
    }
    default:
      return 0;
  }
}

storage_kind delay_model::storage(const dataflow::memory& m) const {
  if (m.words > parameters_.distributed_max_words) return storage_kind::block;
  // A wide memory of few words: LUT RAM only while a block RAM in its place would save few LUTs.
  const double luts = distributed_area(m.words, m.width);
  return luts >= luts_worth_a_block * blocks(m.words, m.width) ? storage_kind::block : storage_kind::distributed;
}

double delay_model::distributed_area(std::uint64_t words, std::uint64_t width) const {
  // A RAM of 16 words of 4 bits takes the place of 6 LUTs (ECP5: four hold the bits, two the write port). From two of
  // them a bit a LUT chooses.
  const std::uint64_t parts = (words + 15) / 16;
  const double choice = parts < 2 ? 0 : static_cast<double>((parts + 1) / 2);
  return static_cast<double>(width) * (1.5 * static_cast<double>(parts) + choice);
}

storage_kind delay_model::storage(const dataflow::table& t) const {
  const std::uint64_t bits = static_cast<std::uint64_t>(t.values.size()) * t.width;
  return t.immediate || t.values.size() <= 64 || bits <= 2048 ? storage_kind::logic : storage_kind::block;
}

unsigned delay_model::blocks(std::uint64_t words, std::uint64_t width) const {
  // A block RAM trades depth for width in powers of two; the target's parity bits come with widths of 9 and more.
  std::uint64_t best = UINT64_MAX;
  for (std::uint64_t block_width = parameters_.block_max_width; block_width >= 1; block_width /= 2) {
    const std::uint64_t depth = std::bit_floor(static_cast<std::uint64_t>(parameters_.block_bits) / block_width);
    best = std::min(best, ((width + block_width - 1) / block_width) * ((words + depth - 1) / depth));
    if (block_width == 1) break;
  }
  return static_cast<unsigned>(best);
}

}  // namespace epiline::schedule
