// How iCE40 makes the copies of flip-flops in generated Verilog: read by scripts/synthesize.sh (Yosys techmap), after
// everything else, since Yosys merges flip-flops that hold the same bits.

(* techmap_celltype = "epiline_copy" *)
module ice40_copy #(
  parameter WIDTH = 1
) (
  input  wire             clk,
  input  wire [WIDTH-1:0] d,
  output wire [WIDTH-1:0] q
);
  genvar i;
  generate
    for (i = 0; i < WIDTH; i = i + 1) begin : bits
      SB_DFF flip_flop (.C(clk), .D(d[i]), .Q(q[i]));
    end
  endgenerate
endmodule
