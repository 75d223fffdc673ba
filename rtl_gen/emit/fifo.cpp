#include "emit/fifo.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cctype>

namespace epiline::emit {

using schedule::storage_kind;

namespace {

constexpr double luts_a_counter_bit = 3;  // two pointers and the fill, each with its next value

// tready comes from a flip-flop, and so do tvalid and tdata. A word is read in the clock after it was written at the
// earliest, and never from the place that is being written: no bypass is needed.
constexpr const char* text = R"(
`ifndef {macro}
`define {macro}
/* verilator lint_off DECLFILENAME */
module {name} #(
  parameter WIDTH = 8,
  parameter DEPTH = 2,
  parameter POINTER = 1,
  parameter [POINTER-1:0] LAST = 1'd1
) (
  input  wire clk,
  input  wire rst,
  input  wire [WIDTH-1:0] in_tdata,
  input  wire in_tvalid,
  output wire in_tready,
  output wire [WIDTH-1:0] out_tdata,
  output wire out_tvalid,
  input  wire out_tready
);
  (* ram_style = "{style}", no_rw_check *)
  reg [WIDTH-1:0] places [0:DEPTH-1];
  reg [POINTER-1:0] in_at, out_at;
  reg [POINTER:0] fill /* verilator public_flat_rd */;
  reg [WIDTH-1:0] word;
  reg word_there, room;
  wire push = in_tvalid & room;
  wire load = (fill != {{(POINTER + 1){{1'b0}}}}) & (out_tready | ~word_there);
  wire [POINTER:0] next_fill = fill + {{{{POINTER{{1'b0}}}}, push}} - {{{{POINTER{{1'b0}}}}, load}};
  assign in_tready = room;
  assign out_tdata = word;
  assign out_tvalid = word_there;
  always @(posedge clk) begin
    if (push) places[in_at] <= in_tdata;
    if (load) word <= places[out_at];
    if (push) in_at <= (in_at == LAST) ? {{POINTER{{1'b0}}}} : in_at + 1'b1;
    if (load) out_at <= (out_at == LAST) ? {{POINTER{{1'b0}}}} : out_at + 1'b1;
    fill <= next_fill;
    room <= next_fill <= {{1'b0, LAST}};
    word_there <= load | (word_there & ~out_tready);
    if (rst) begin
      in_at <= {{POINTER{{1'b0}}}};
      out_at <= {{POINTER{{1'b0}}}};
      fill <= {{(POINTER + 1){{1'b0}}}};
      room <= 1'b0;
      word_there <= 1'b0;
    end
  end
`ifndef SYNTHESIS
  // For testbenches: the largest fill since reset.
  reg [POINTER:0] peak /* verilator public_flat_rd */;
  always @(posedge clk) peak <= rst ? {{(POINTER + 1){{1'b0}}}} : (fill > peak) ? fill : peak;
`endif
endmodule
/* verilator lint_on DECLFILENAME */
`endif)";

}  // namespace

fifo_plan plan_fifo(const dataflow::fifo& f, const schedule::delay_model& model) {
  fifo_plan p;
  p.depth = std::max(2u, f.depth);  // with one place a token could pass every other clock only
  p.pointer_bits = static_cast<unsigned>(std::bit_width(p.depth - 1));
  const unsigned counters = 3 * p.pointer_bits + 1;
  p.flip_flops = f.width + counters + 2;
  p.luts = luts_a_counter_bit * counters;
  if (p.depth > model.parameters().distributed_max_words) {
    p.storage = storage_kind::block;
    p.block_rams = model.blocks(p.depth, f.width);
  } else {
    p.luts += model.distributed_area(p.depth, f.width);
  }
  return p;
}

std::string fifo_module_name(storage_kind storage) { return fmt::format("epiline_fifo_{}", name_of(storage)); }

std::string fifo_module(storage_kind storage) {
  const std::string name = fifo_module_name(storage);
  std::string macro = name;
  std::transform(macro.begin(), macro.end(), macro.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return fmt::format(text, fmt::arg("macro", macro), fmt::arg("name", name), fmt::arg("style", name_of(storage)));
}

}  // namespace epiline::emit
