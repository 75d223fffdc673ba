#pragma once
// The graphs that the tests of scheduler, emitter and report share.

#include "graph_builder.hpp"

namespace epiline::testing {

/// out = number of the token, 0, 1, 2, ...; input tokens are dropped.
graph make_counter();
/// out = ((a * 3 + b) ^ c) and more additions than fit one stage.
graph make_adder_pipeline();
/// Eight taps with constant coefficients, a shift register of samples.
graph make_filter();
/// A histogram in block RAM: read, add one, write; the source promises that a bin returns after 4 tokens at the
/// earliest.
graph make_histogram(unsigned distance);
/// Reads `b` only when the token of `a` before asked for it, writes only odd sums.
graph make_conditional_streams();
/// A running sum of `width` bits: a recurrence through `adders` adders of that width one after another.
graph make_accumulator(unsigned width, unsigned adders);
/// A call with a length parameter: the next `length` tokens are scaled by a patient parameter; a result a call.
graph make_calls();
/// A value that waits for a long chain of other operations: delay lines. `chain` additions of 32 bits.
graph make_long_wait(unsigned chain);
/// Tokens of `streams` streams, of 64 bits, that wait for a sum of one of them.
graph make_many_waits(unsigned streams);
/// `levels` sums, of which one condition chooses the terms and another one enables most: both have many readers.
graph make_many_readers(unsigned levels);
/// `levels` registers that one bit, known long before, clears.
graph make_cleared_levels(unsigned levels);
/// Small RAM (LUT RAM) and a constant table past whose end addresses go.
graph make_small_memory();
/// A RAM of `rams` times 18 bits whose words are long in coming, long after the condition under which they are written.
graph make_late_write(unsigned rams);
/// Two writes to one memory under conditions that exclude each other (or visibly do not).
graph make_two_writes(bool exclusive);
/// All operations on tokens of odd widths.
graph make_all_operations();

/// Block matching as large as method 2's core: colour differences, column sums in RAM, sliding window sums and a
/// minimum search over `levels` disparities.
graph make_block_matcher(unsigned levels);

}  // namespace epiline::testing
