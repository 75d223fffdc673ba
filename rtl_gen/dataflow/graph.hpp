#pragma once
// The dataflow graph: one iteration of a hardware process, the level every pass, the interpreter, the scheduler and the
// emitter work on. It knows nothing of C++, LLVM IR or Verilog.
//
// Meaning. A graph describes a machine that performs iterations one after another, for ever. One iteration
//   1. evaluates all nodes in the order of `graph::nodes` (operands stand before their users);
//   2. a `read` whose predicate is 1 takes one token from its input port, a `write` whose predicate is 1 appends one
//      token to its output port; a port takes part in at most one access an iteration. The iteration waits, with no
//      effect, until every token it reads is there;
//   3. at its end every register whose enable is 1 takes its next value, all at once.
// Memory accesses take effect in the order of the nodes, within and across iterations. Values are bit vectors of
// 1..max_width bits without a sign; signedness is in the operations.

#include <llvm/ADT/APInt.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace epiline::dataflow {

using node_id = std::uint32_t;
using register_id = std::uint32_t;
using memory_id = std::uint32_t;
using port_id = std::uint32_t;
inline constexpr std::uint32_t none = 0xffffffffu;
inline constexpr unsigned max_width = 1u << 16;

/// Where in the user's C++ a thing comes from. `file` indexes graph::files; line 0 = unknown.
struct source_location {
  std::uint32_t file = 0;
  std::uint32_t line = 0;
};

enum class operation : std::uint8_t {
  constant,        // `value`
  read,            // (predicate:1) token of input port `object`; all zero when the predicate is 0
  write,           // (predicate:1, token) to output port `object`; no result (width 0)
  register_value,  // () value of register `object` at the start of the iteration
  memory_read,     // (address, enable:1) word of memory `object`; unspecified when enable is 0 (interpreter: 0)
  memory_write,    // (address, data, enable:1) to memory `object`; no result (width 0)
  table,           // (address) word of constant table `object`; an address past its end gives 0
  add,
  subtract,
  multiply,         // (a, b): all three widths equal, wraps
  add_or_subtract,  // (a, b, subtract:1): a - b if subtract, otherwise a + b; three widths equal, wraps
  divide_unsigned,
  divide_signed,  // (a, b): equal widths, truncates toward zero; b = 0: all ones
  remainder_unsigned,
  remainder_signed,  // (a, b): equal widths, sign of a; b = 0: a
  bit_and,
  bit_or,
  bit_xor,  // (a, b): equal widths
  bit_not,  // (a)
  shift_left,
  shift_right_logical,
  shift_right_arithmetic,  // (a, amount): amount unsigned of any width; >= width shifts all out
  equal,
  less_unsigned,
  less_signed,  // (a, b): equal operand widths, result 1 bit
  select,       // (condition:1, if one, if zero)
  concat,       // (high, ..., low): two or more operands, first on top
  slice,        // (a): bits [low, low + width)
  extend_zero,
  extend_sign,  // (a): width > a's width
};

struct node {
  operation kind = operation::constant;
  unsigned width = 0;  // of the result; 0 for write and memory_write
  std::vector<node_id> operands;
  std::uint32_t object = none;  // port, register, memory or table id, by kind
  unsigned low = 0;             // slice only
  llvm::APInt value{1, 0};      // constant only; its bit width equals `width`
  std::string name;             // from the source, may be empty; not unique
  source_location where;
};

/// Whether operand `index` of `n` decides if a word is written.
[[nodiscard]] inline bool is_write_enable(const node& n, std::size_t index) {
  return n.kind == operation::memory_write && index == 2;
}

/// A loop-carried value. Its next value and enable are nodes of the same iteration.
struct register_state {
  std::string name;
  unsigned width = 1;
  std::optional<llvm::APInt> initial;  // value at power-up; empty: unspecified (interpreter: 0)
  bool resets = true;                  // a reset brings `initial` back (#pragma HLS RESET off: only power-up does)
  node_id next = none;
  node_id enable = none;  // a 1-bit node
  /// Every update of this register happens in an iteration that `graph::patient` marks: the next iteration is issued
  /// only after that update has taken place, so its next value may take any number of clocks.
  bool patient = false;
  source_location where;
  /// Its number in the graph that the pass now running was given; none: the pass made it. Kept only while somebody
  /// watches the passes (passes::pipeline_options::observer).
  register_id origin = none;
};

struct memory {
  std::string name;
  unsigned words = 1;
  unsigned width = 1;
  std::vector<llvm::APInt> initial;  // empty, or one value a word (loaded once, at power-up; never by reset)
  /// An iteration's reads need to see only the writes of iterations at least this many iterations earlier (1 = all
  /// earlier ones); reading a word written less long ago is a broken promise of the source (#pragma HLS DEPENDENCE):
  /// the interpreter reports it. Within one iteration a read that stands before a write sees the old word.
  unsigned distance = 1;
  bool distance_promised = false;  // by the source, not established by a pass
  source_location where;
  /// Like register_state::origin: the memories whose words stand side by side in this one's, the lowest bits first.
  std::vector<memory_id> origins;
};

struct table {
  std::string name;
  unsigned width = 1;
  std::vector<llvm::APInt> values;
  bool immediate = false;  // its word is needed in the clock of its address: it must not be a block RAM
  source_location where;
  std::uint32_t origin = none;  // like register_state::origin
};

/// One signal group of a port; `signal` is the RTL suffix ("tdata", "tuser", "tlast", ...) or, for a call port, the
/// name of the scalar itself. `offset` is the field's lowest bit in the token.
struct field {
  std::string name;
  std::string signal;
  unsigned width = 1;
  unsigned offset = 0;
  bool is_signed = false;  // the source's type, for people and software; the logic's signs are in its operations
};

enum class port_kind : std::uint8_t {
  stream,  // s_axis_NAME_* / m_axis_NAME_*
  call,    // scalars by value: one token a call; call_tvalid, call_tready and one input port a scalar
  result,  // a scalar by reference: m_axis_NAME_*, one token a call
};

struct port {
  std::string name;
  port_kind kind = port_kind::stream;
  bool input = true;
  unsigned width = 0;         // of a token: the sum of the fields
  std::vector<field> fields;  // low bits first, without gaps
  source_location where;
};

struct graph {
  std::string name;                // the top function's
  std::vector<std::string> files;  // source file names, as given to the compiler
  std::vector<port> ports;
  std::vector<register_state> registers;
  std::vector<memory> memories;
  std::vector<table> tables;
  std::vector<node> nodes;  // topologically sorted; accesses to one memory stand in program order
  /// A 1-bit node: this iteration updates patient registers, so the next one waits for the pipeline; none = never.
  node_id patient = none;
};

/// Checks every rule stated in this file (widths, order, ids, one access a port ...).
/// Returns an empty string, or one sentence naming the first rule broken and where.
[[nodiscard]] std::string find_violation(const graph& g);

[[nodiscard]] const char* name_of(operation kind);
[[nodiscard]] const char* name_of(port_kind kind);

}  // namespace epiline::dataflow
