// How ECP5 makes the operators that generated Verilog has as modules: read by scripts/synthesize.sh (Yosys techmap).

// a + b or a - b in one carry chain: a CCU2C cell can invert its second operand on the way.
(* techmap_celltype = "epiline_add_or_subtract" *)
module ecp5_add_or_subtract #(
  parameter WIDTH = 8
) (
  input  wire [WIDTH-1:0] a,
  input  wire [WIDTH-1:0] b,
  input  wire             subtract,
  output wire [WIDTH-1:0] total
);
  wire [WIDTH-1:0] differ, carry;
  \$alu #(
    .A_SIGNED(0), .B_SIGNED(0), .A_WIDTH(WIDTH), .B_WIDTH(WIDTH), .Y_WIDTH(WIDTH)
  ) chain (
    .A(a), .B(b), .BI(subtract), .CI(subtract), .X(differ), .Y(total), .CO(carry)
  );
endmodule
