#pragma once
// A graph as batches of equal instructions over words: what interpreter.hpp executes.

#include <cstdint>
#include <utility>
#include <vector>

#include "dataflow/graph.hpp"
#include "dataflow/words.hpp"

namespace epiline::dataflow {

// What a batch does. Operands of the first group have at most 64 bits.
enum class opcode : std::uint8_t {
  add,
  subtract,
  multiply,
  add_or_subtract,
  divide_unsigned,
  divide_signed,
  remainder_unsigned,
  remainder_signed,
  bit_and,
  bit_or,
  bit_xor,
  bit_not,
  shift_left,
  shift_right_logical,
  shift_right_arithmetic,
  equal,
  less_unsigned,
  less_signed,
  select,
  concat,
  slice,
  extend_sign,
  table,
  slice_of_wide,  // narrow result, wide operand
  wide,           // anything else pure with a wide value
  read,
  memory_read,
  memory_write,
  count
};

/// Word offsets into translation::values and shift counts; which fields mean something depends on the opcode.
struct instruction {
  std::uint32_t result = 0, a = 0, b = 0, c = 0;
  std::uint8_t result_shift = 0;   // 64 - width of the result
  std::uint8_t operand_shift = 0;  // signed operations: 64 - width of the operand; concat, slice: bits to shift
};

struct batch {
  opcode what;
  std::uint32_t begin, end;  // in translation::instructions
};

struct location {  // of a value in translation::values
  std::uint32_t offset;
  unsigned width;
};

struct wide_instruction {
  operation kind;
  unsigned low;
  location result;
  std::vector<location> operands;
  std::uint32_t table;
};

struct memory_access {
  memory_id memory;
  location address, data;  // data: the result of a read
  std::uint32_t enable;
};

struct port_access {
  port_id port;
  std::uint32_t predicate;
  location token;
};

struct register_update {  // offsets of its value, next value and enable
  std::uint32_t value, next, enable, words;
};

/// All of one iteration. The batches stand in an order in which every value is there when it is used, and a memory is
/// accessed in the order of the graph.
struct translation {
  std::vector<word> values;  // of all nodes and registers; constants are in their places
  std::vector<instruction> instructions;
  std::vector<batch> batches;
  std::vector<wide_instruction> wide;  // by instruction::a, as the next two
  std::vector<memory_access> memory_accesses;
  std::vector<port_access> reads;
  std::vector<memory_access> late_writes;  // no read of the same iteration follows them: done at its end
  std::vector<port_access> writes;
  std::vector<location> registers;                                       // where each one's value is
  std::vector<register_update> narrow_updates, wide_updates;             // of one word, of more
  std::vector<std::pair<register_id, std::uint32_t>> patient_registers;  // and their enables
  std::uint32_t patient = none;                                          // offset of the patient node's value
};

/// The graph must obey find_violation().
[[nodiscard]] translation translate(const graph& g);

}  // namespace epiline::dataflow
