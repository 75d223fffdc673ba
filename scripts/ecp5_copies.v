// How ECP5 makes the copies of flip-flops in generated Verilog: read by scripts/synthesize.sh (Yosys techmap), after
// everything else, since Yosys merges flip-flops that hold the same bits.

(* techmap_celltype = "epiline_copy" *)
module ecp5_copy #(
  parameter WIDTH = 1
) (
  input  wire             clk,
  input  wire [WIDTH-1:0] d,
  output wire [WIDTH-1:0] q
);
  genvar i;
  generate
    for (i = 0; i < WIDTH; i = i + 1) begin : bits
      TRELLIS_FF #(
        .GSR("DISABLED"), .CEMUX("1"), .CLKMUX("CLK"), .LSRMUX("LSR"), .REGSET("RESET")
      ) flip_flop (
        .CLK(clk), .LSR(1'b0), .DI(d[i]), .Q(q[i])
      );
    end
  endgenerate
endmodule
