#pragma once
// A testbench in plain Verilog-2005 for any generated module: it knows docs/rtl_interface.md and the tokens, nothing
// else, and runs in every simulator.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "check/answer.hpp"
#include "dataflow/network.hpp"

namespace epiline::check {

/// The testbench `epiline_check_bench` with the input `clk`, and `epiline_check_clock` around it, which makes the
/// clock. It reads in_PORT.hex (write_inputs) and takes from the command line
///   +pattern=N   0: no pauses, 1: half of the clocks everywhere, 2: each port its own share, 3: the same, and outputs
///                are taken only after they are seen
///   +seed=N      of the pauses
///   +out=NAME    the file for what comes out: lines `out PORT HEXADECIMAL`, `rule TEXT`, `fifo NUMBER PEAK`, `clocks
///   N`
/// It ends when all outputs of `wanted` have come and for some clocks no more, or after `patience` clocks in which no
/// token moved. `sees_fifos`: the module still has its FIFOs as instances, and the testbench tells their peak fills.
[[nodiscard]] std::string bench_text(const dataflow::network& n, const reference& wanted, std::uint64_t patience,
                                     bool sees_fifos);

inline constexpr unsigned bench_patterns = 4;
[[nodiscard]] const char* pattern_name(unsigned pattern);

/// Writes the files that the testbench reads.
void write_inputs(const std::filesystem::path& folder, const dataflow::network& n, const reference& wanted);

struct bench_answer {
  std::vector<token_list> outputs;        // by port
  std::vector<std::uint64_t> peak_fills;  // by FIFO; empty: the testbench did not see them
  std::uint64_t clocks = 0;
  std::string problem;  // a rule of the interface that was broken, or a value that is not known (X); empty: none
};
/// Throws std::runtime_error for a file that is not complete.
[[nodiscard]] bench_answer read_bench_answer(const std::filesystem::path& file, const dataflow::network& n);

}  // namespace epiline::check
