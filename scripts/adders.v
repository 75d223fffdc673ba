// A carry chain for every sum and difference: read by scripts/synthesize.sh (Yosys techmap), for all devices.
//
// Left alone, Yosys makes one sum of three operands of a + (b + c): two LUTs a bit add three bits to two, a carry chain
// adds those. A second chain takes half the LUTs, and the operand that comes last goes through one chain only.

(* techmap_celltype = "$add $sub" *)
module carry_chain_sum #(
  parameter A_SIGNED = 0,
  parameter B_SIGNED = 0,
  parameter A_WIDTH = 1,
  parameter B_WIDTH = 1,
  parameter Y_WIDTH = 1,
  parameter _TECHMAP_CELLTYPE_ = ""
) (
  input  wire [A_WIDTH-1:0] A,
  input  wire [B_WIDTH-1:0] B,
  output wire [Y_WIDTH-1:0] Y
);
  localparam SUBTRACTS = _TECHMAP_CELLTYPE_ == "$sub";
  wire [Y_WIDTH-1:0] differ, carry;
  \$alu #(
    .A_SIGNED(A_SIGNED), .B_SIGNED(B_SIGNED), .A_WIDTH(A_WIDTH), .B_WIDTH(B_WIDTH), .Y_WIDTH(Y_WIDTH)
  ) chain (
    .A(A), .B(B), .BI(SUBTRACTS), .CI(SUBTRACTS), .X(differ), .Y(Y), .CO(carry)
  );
endmodule
