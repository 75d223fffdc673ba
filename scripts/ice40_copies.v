// How iCE40 makes the copies of flip-flops in generated Verilog: read by scripts/synthesize.sh (Yosys techmap), after
// everything else, since Yosys merges flip-flops that hold the same bits.

(* techmap_celltype = "epiline_copy" *)
module ice40_copy #(
  parameter WIDTH = 1
) (
  input  wire             clk,
  input  wire             clear,
  input  wire [WIDTH-1:0] d,
  output wire [WIDTH-1:0] q
);
  // A clear that is constant 0 would still be routed, as one of the few global resets.
  parameter _TECHMAP_CONSTMSK_clear_ = 0;
  parameter _TECHMAP_CONSTVAL_clear_ = 0;
  genvar i;
  generate
    for (i = 0; i < WIDTH; i = i + 1) begin : bits
      if (_TECHMAP_CONSTMSK_clear_ && !_TECHMAP_CONSTVAL_clear_) begin : never_cleared
        SB_DFF flip_flop (.C(clk), .D(d[i]), .Q(q[i]));
      end else begin : cleared
        SB_DFFSR flip_flop (.C(clk), .R(clear), .D(d[i]), .Q(q[i]));
      end
    end
  endgenerate
endmodule
