#include "emit/verilog.hpp"

#include <string_view>
#include <utility>

#include "emit/control.hpp"
#include "emit/handshakes.hpp"
#include "emit/interface.hpp"
#include "emit/logic.hpp"
#include "emit/memories.hpp"
#include "emit/module_signals.hpp"
#include "emit/module_text.hpp"
#include "emit/register_map.hpp"
#include "emit/state.hpp"
#include "emit/waiting_values.hpp"

namespace epiline::emit {

using dataflow::register_id;

namespace {

/// A module of its own, because synthesis makes one carry chain of it only when it is told how
/// (scripts/ecp5_operators.v); several generated files may be compiled together.
constexpr const char* add_or_subtract_module = R"(
`ifndef EPILINE_ADD_OR_SUBTRACT
`define EPILINE_ADD_OR_SUBTRACT
/* verilator lint_off DECLFILENAME */
module epiline_add_or_subtract #(
  parameter WIDTH = 8
) (
  input  wire [WIDTH-1:0] a,
  input  wire [WIDTH-1:0] b,
  input  wire             subtract,
  output wire [WIDTH-1:0] total
);
  // The lowest place only makes the carry: a - b is a + ~b + 1.
  wire [WIDTH:0] sum = {a, subtract} + {b ^ {WIDTH{subtract}}, subtract};
  assign total = sum[WIDTH:1];
endmodule
/* verilator lint_on DECLFILENAME */
`endif)";

/// A module of its own, because synthesis makes one flip-flop of several that hold the same bits unless each is one it
/// does not look into until the end (scripts/ecp5_copies.v).
constexpr const char* copy_module = R"(
`ifndef EPILINE_COPY
`define EPILINE_COPY
/* verilator lint_off DECLFILENAME */
module epiline_copy #(
  parameter WIDTH = 1
) (
  input  wire             clk,
  input  wire [WIDTH-1:0] d,
  output wire [WIDTH-1:0] q
);
  (* keep = "true", syn_preserve = 1, dont_merge *)
  reg [WIDTH-1:0] bits = {WIDTH{1'b0}};
  always @(posedge clk) bits <= d;
  assign q = bits;
endmodule
/* verilator lint_on DECLFILENAME */
`endif)";

void write_heading(module_text& m) {
  m.line("// {}: made by epiline-hls.", m.g.name);
  if (!m.options.heading.empty()) {
    std::string_view rest = m.options.heading;
    while (!rest.empty()) {
      const std::size_t end = rest.find('\n');
      m.line("// {}", rest.substr(0, end));
      rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
    }
  }
  m.line("// {} stages, one iteration every {} clock{}; period {:.2f} ns, target {}.", m.s.depth,
         m.s.initiation_interval, m.s.initiation_interval == 1 ? "" : "s", m.s.period, m.model.target());
  m.line("//");
  m.line(
      "// An iteration is issued (fire) when all it reads is there and every output has room for it. From then on it");
  m.line(
      "// moves one stage a clock and never stops: values of stage 3 are named ..._s3 once they have left the stage");
  m.line("// that made them. State changes only where the stage's valid bit is set.");
  m.line("//");
  m.line("// UNUSED is waived because a narrow user may take some bits only of a value, a token or a scalar.");
  m.line("// UNSIGNED and CMPCONST are waived because the range of its operands may decide a comparison.");
  m.line("/* verilator lint_off UNUSED */");
  m.line("/* verilator lint_off UNSIGNED */");
  m.line("/* verilator lint_off CMPCONST */");
  m.line("`default_nettype none");
  m.line("");
}

void write_stage(module_text& m, int stage) {
  m.title(fmt::format("stage {}", stage));
  for (const register_id r : m.registers_at[stage]) declare_register(m, r);
  write_waiting_values(m, stage);
  write_logic(m, stage);
  write_block_reads(m, stage);
  if (stage == 0) write_issue(m);
  write_state(m, stage);
  write_memory_writes(m, stage);
}

void write_module(module_text& m) {
  write_heading(m);
  m.out += module_head(m.g, m.interface);
  write_control_declarations(m);
  write_credits(m);
  write_inputs(m);
  write_reset_rows(m);
  write_settled(m);
  write_memory_declarations(m);
  write_delay_pointers(m);
  for (int stage = 0; stage < m.s.depth; ++stage) write_stage(m, stage);
  write_valids(m);
  write_patient(m);
  write_outputs(m);
  m.line("\nendmodule\n");
  if (m.options.axi_lite) m.line("{}", emit_axi_lite_slave(make_register_map(m.g)));
  if (m.adds_or_subtracts) m.line("{}", add_or_subtract_module);
  if (m.has_copies) m.line("{}", copy_module);
  m.line("`default_nettype wire");
}

}  // namespace

verilog_text emit_module(const dataflow::graph& g, const schedule::delay_model& model, const schedule::result& s,
                         const verilog_options& options) {
  module_text m(g, model, s, options);
  write_module(m);
  std::vector<signal> signals = signals_of(m);
  return {std::move(m.out), {{g.name, g.files, std::move(signals)}}};
}

std::string emit_verilog(const dataflow::graph& g, const schedule::delay_model& model, const schedule::result& s,
                         const verilog_options& options) {
  return emit_module(g, model, s, options).text;
}

}  // namespace epiline::emit
