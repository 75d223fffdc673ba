// The ECP5 cells Yosys maps to, for simulation in Verilator: the same functions as Yosys's own cells_sim.v, without the
// delays, and a DP16KD, which Yosys has no model of. Verilator compiles these about as fast as plain logic.

/* verilator lint_off DECLFILENAME */
/* verilator lint_off UNUSED */

module LUT4 (input wire A, B, C, D, output wire Z);
  parameter [15:0] INIT = 16'h0000;
  assign Z = INIT[{D, C, B, A}];
endmodule

module PFUMX (input wire ALUT, BLUT, C0, output wire Z);
  assign Z = C0 ? ALUT : BLUT;
endmodule

module L6MUX21 (input wire D0, D1, SD, output wire Z);
  assign Z = SD ? D1 : D0;
endmodule

module CCU2C (input wire CIN, A0, B0, C0, D0, A1, B1, C1, D1, output wire S0, S1, COUT);
  parameter [15:0] INIT0 = 16'h0000;
  parameter [15:0] INIT1 = 16'h0000;
  parameter INJECT1_0 = "YES";
  parameter INJECT1_1 = "YES";

  wire propagate_0 = INIT0[{D0, C0, B0, A0}];
  wire generate_0 = INJECT1_0 == "YES" ? 1'b0 : INIT0[{2'b00, B0, A0}];
  wire carry_0 = propagate_0 ? CIN : generate_0;
  assign S0 = propagate_0 ^ (INJECT1_0 == "YES" ? 1'b0 : CIN);

  wire propagate_1 = INIT1[{D1, C1, B1, A1}];
  wire generate_1 = INJECT1_1 == "YES" ? 1'b0 : INIT1[{2'b00, B1, A1}];
  assign COUT = propagate_1 ? carry_0 : generate_1;
  assign S1 = propagate_1 ^ (INJECT1_1 == "YES" ? 1'b0 : carry_0);
endmodule

// Without asynchronous set or reset: epiline-hls writes none.
module TRELLIS_FF (input wire CLK, LSR, CE, DI, M, output reg Q);
  parameter GSR = "ENABLED";
  parameter CEMUX = "1";
  parameter CLKMUX = "CLK";
  parameter LSRMUX = "LSR";
  parameter SRMODE = "LSR_OVER_CE";
  parameter REGSET = "RESET";
  parameter LSRMODE = "LSR";

  wire enable = CEMUX == "1" ? 1'b1 : CEMUX == "0" ? 1'b0 : CEMUX == "INV" ? !CE : CE;
  wire set_reset = LSRMUX == "INV" ? !LSR : LSR;

  generate
    if (CLKMUX == "INV" || SRMODE == "ASYNC" || LSRMODE == "PRLD") begin : unsupported
      initial begin
        $display("TRELLIS_FF: inverted clock, asynchronous reset and preload are not modelled");
        $finish;
      end
    end
  endgenerate

  initial Q = REGSET == "SET";
  always @(posedge CLK) begin
    if (set_reset) Q <= REGSET == "SET";
    else if (enable) Q <= DI;
  end
endmodule

module TRELLIS_DPR16X4 (input wire [3:0] DI, WAD, RAD, input wire WRE, WCK, output wire [3:0] DO);
  parameter WCKMUX = "WCK";
  parameter WREMUX = "WRE";
  parameter [63:0] INITVAL = 64'h0;

  reg [3:0] words[0:15];
  integer i;
  initial for (i = 0; i < 16; i = i + 1) words[i] = INITVAL[4*i+:4];
  always @(posedge WCK) if (WREMUX == "1" || (WREMUX == "INV" ? !WRE : WRE)) words[WAD] <= DI;
  assign DO = words[RAD];
endmodule

// An 18x18 multiplier without registers.
module MULT18X18D (
    input wire
    A0, A1, A2, A3, A4, A5, A6, A7, A8, A9, A10, A11, A12, A13, A14, A15, A16, A17, B0, B1, B2, B3, B4, B5, B6, B7,
    B8, B9, B10, B11, B12, B13, B14, B15, B16, B17, C0, C1, C2, C3, C4, C5, C6, C7, C8, C9, C10, C11, C12, C13,
    C14, C15, C16, C17, SIGNEDA, SIGNEDB, SOURCEA, SOURCEB,
    output wire
    P0, P1, P2, P3, P4, P5, P6, P7, P8, P9, P10, P11, P12, P13, P14, P15, P16, P17, P18, P19, P20, P21, P22, P23,
    P24, P25, P26, P27, P28, P29, P30, P31, P32, P33, P34, P35
);
  wire [17:0] a =
      {A17, A16, A15, A14, A13, A12, A11, A10, A9, A8, A7, A6, A5, A4, A3, A2, A1, A0};
  wire [17:0] b =
      {B17, B16, B15, B14, B13, B12, B11, B10, B9, B8, B7, B6, B5, B4, B3, B2, B1, B0};
  wire signed [36:0] wide_a = {{19{SIGNEDA & a[17]}}, a};
  wire signed [36:0] wide_b = {{19{SIGNEDB & b[17]}}, b};
  wire [36:0] product = wide_a * wide_b;
  assign
      {P35, P34, P33, P32, P31, P30, P29, P28, P27, P26, P25, P24, P23, P22, P21, P20, P19, P18, P17, P16, P15,
      P14, P13, P12, P11, P10, P9, P8, P7, P6, P5, P4, P3, P2, P1, P0} = product[35:0];
endmodule

// The 18 kbit block RAM as Yosys uses it: no output registers, one clock, two ports of up to 18 bits or, with a data
// width of 36, one write port (A) and one read port (B). The memory is 1024 rows of 18 bits; bits 13..4 of an address are
// the row. What real silicon leaves open is inverted here: a word read by one port in the clock another port writes it.
module DP16KD (
    input wire CLKA, CEA, OCEA, WEA, RSTA, CSA0, CSA1, CSA2, CLKB, CEB, OCEB, WEB, RSTB, CSB0, CSB1, CSB2,
    input wire
    ADA0, ADA1, ADA2, ADA3, ADA4, ADA5, ADA6, ADA7, ADA8, ADA9, ADA10, ADA11, ADA12, ADA13, ADB0, ADB1, ADB2, ADB3,
    ADB4, ADB5, ADB6, ADB7, ADB8, ADB9, ADB10, ADB11, ADB12, ADB13, DIA0, DIA1, DIA2, DIA3, DIA4, DIA5, DIA6, DIA7,
    DIA8, DIA9, DIA10, DIA11, DIA12, DIA13, DIA14, DIA15, DIA16, DIA17, DIB0, DIB1, DIB2, DIB3, DIB4, DIB5, DIB6,
    DIB7, DIB8, DIB9, DIB10, DIB11, DIB12, DIB13, DIB14, DIB15, DIB16, DIB17,
    output wire
    DOA0, DOA1, DOA2, DOA3, DOA4, DOA5, DOA6, DOA7, DOA8, DOA9, DOA10, DOA11, DOA12, DOA13, DOA14, DOA15, DOA16,
    DOA17, DOB0, DOB1, DOB2, DOB3, DOB4, DOB5, DOB6, DOB7, DOB8, DOB9, DOB10, DOB11, DOB12, DOB13, DOB14, DOB15,
    DOB16, DOB17
);
  parameter DATA_WIDTH_A = 18;
  parameter DATA_WIDTH_B = 18;
  parameter REGMODE_A = "NOREG";
  parameter REGMODE_B = "NOREG";
  parameter RESETMODE = "SYNC";
  parameter ASYNC_RESET_RELEASE = "SYNC";
  parameter CSDECODE_A = "0b000";
  parameter CSDECODE_B = "0b000";
  parameter CLKAMUX = "CLKA";
  parameter CLKBMUX = "CLKB";
  parameter WRITEMODE_A = "NORMAL";
  parameter WRITEMODE_B = "NORMAL";
  parameter GSR = "ENABLED";
  parameter INIT_DATA = "STATIC";
  parameter [319:0] INITVAL_00 = 320'h0;
  parameter [319:0] INITVAL_01 = 320'h0;
  parameter [319:0] INITVAL_02 = 320'h0;
  parameter [319:0] INITVAL_03 = 320'h0;
  parameter [319:0] INITVAL_04 = 320'h0;
  parameter [319:0] INITVAL_05 = 320'h0;
  parameter [319:0] INITVAL_06 = 320'h0;
  parameter [319:0] INITVAL_07 = 320'h0;
  parameter [319:0] INITVAL_08 = 320'h0;
  parameter [319:0] INITVAL_09 = 320'h0;
  parameter [319:0] INITVAL_0A = 320'h0;
  parameter [319:0] INITVAL_0B = 320'h0;
  parameter [319:0] INITVAL_0C = 320'h0;
  parameter [319:0] INITVAL_0D = 320'h0;
  parameter [319:0] INITVAL_0E = 320'h0;
  parameter [319:0] INITVAL_0F = 320'h0;
  parameter [319:0] INITVAL_10 = 320'h0;
  parameter [319:0] INITVAL_11 = 320'h0;
  parameter [319:0] INITVAL_12 = 320'h0;
  parameter [319:0] INITVAL_13 = 320'h0;
  parameter [319:0] INITVAL_14 = 320'h0;
  parameter [319:0] INITVAL_15 = 320'h0;
  parameter [319:0] INITVAL_16 = 320'h0;
  parameter [319:0] INITVAL_17 = 320'h0;
  parameter [319:0] INITVAL_18 = 320'h0;
  parameter [319:0] INITVAL_19 = 320'h0;
  parameter [319:0] INITVAL_1A = 320'h0;
  parameter [319:0] INITVAL_1B = 320'h0;
  parameter [319:0] INITVAL_1C = 320'h0;
  parameter [319:0] INITVAL_1D = 320'h0;
  parameter [319:0] INITVAL_1E = 320'h0;
  parameter [319:0] INITVAL_1F = 320'h0;
  parameter [319:0] INITVAL_20 = 320'h0;
  parameter [319:0] INITVAL_21 = 320'h0;
  parameter [319:0] INITVAL_22 = 320'h0;
  parameter [319:0] INITVAL_23 = 320'h0;
  parameter [319:0] INITVAL_24 = 320'h0;
  parameter [319:0] INITVAL_25 = 320'h0;
  parameter [319:0] INITVAL_26 = 320'h0;
  parameter [319:0] INITVAL_27 = 320'h0;
  parameter [319:0] INITVAL_28 = 320'h0;
  parameter [319:0] INITVAL_29 = 320'h0;
  parameter [319:0] INITVAL_2A = 320'h0;
  parameter [319:0] INITVAL_2B = 320'h0;
  parameter [319:0] INITVAL_2C = 320'h0;
  parameter [319:0] INITVAL_2D = 320'h0;
  parameter [319:0] INITVAL_2E = 320'h0;
  parameter [319:0] INITVAL_2F = 320'h0;
  parameter [319:0] INITVAL_30 = 320'h0;
  parameter [319:0] INITVAL_31 = 320'h0;
  parameter [319:0] INITVAL_32 = 320'h0;
  parameter [319:0] INITVAL_33 = 320'h0;
  parameter [319:0] INITVAL_34 = 320'h0;
  parameter [319:0] INITVAL_35 = 320'h0;
  parameter [319:0] INITVAL_36 = 320'h0;
  parameter [319:0] INITVAL_37 = 320'h0;
  parameter [319:0] INITVAL_38 = 320'h0;
  parameter [319:0] INITVAL_39 = 320'h0;
  parameter [319:0] INITVAL_3A = 320'h0;
  parameter [319:0] INITVAL_3B = 320'h0;
  parameter [319:0] INITVAL_3C = 320'h0;
  parameter [319:0] INITVAL_3D = 320'h0;
  parameter [319:0] INITVAL_3E = 320'h0;
  parameter [319:0] INITVAL_3F = 320'h0;

  localparam pseudo_dual = DATA_WIDTH_A == 36 || DATA_WIDTH_B == 36;

  reg [17:0] rows[0:1023];
  integer row;
  wire [64*320-1:0] initial_rows = {
      INITVAL_3F, INITVAL_3E, INITVAL_3D, INITVAL_3C,
      INITVAL_3B, INITVAL_3A, INITVAL_39, INITVAL_38,
      INITVAL_37, INITVAL_36, INITVAL_35, INITVAL_34,
      INITVAL_33, INITVAL_32, INITVAL_31, INITVAL_30,
      INITVAL_2F, INITVAL_2E, INITVAL_2D, INITVAL_2C,
      INITVAL_2B, INITVAL_2A, INITVAL_29, INITVAL_28,
      INITVAL_27, INITVAL_26, INITVAL_25, INITVAL_24,
      INITVAL_23, INITVAL_22, INITVAL_21, INITVAL_20,
      INITVAL_1F, INITVAL_1E, INITVAL_1D, INITVAL_1C,
      INITVAL_1B, INITVAL_1A, INITVAL_19, INITVAL_18,
      INITVAL_17, INITVAL_16, INITVAL_15, INITVAL_14,
      INITVAL_13, INITVAL_12, INITVAL_11, INITVAL_10,
      INITVAL_0F, INITVAL_0E, INITVAL_0D, INITVAL_0C,
      INITVAL_0B, INITVAL_0A, INITVAL_09, INITVAL_08,
      INITVAL_07, INITVAL_06, INITVAL_05, INITVAL_04,
      INITVAL_03, INITVAL_02, INITVAL_01, INITVAL_00
  };
  initial begin
    for (row = 0; row < 1024; row = row + 1) rows[row] = initial_rows[20*row+:18];
    if (CLKAMUX != "CLKA" || CLKBMUX != "CLKB") begin
      $display("DP16KD: inverted clocks are not modelled");
      $finish;
    end
  end

  wire [13:0] address_a =
      {ADA13, ADA12, ADA11, ADA10, ADA9, ADA8, ADA7, ADA6, ADA5, ADA4, ADA3, ADA2, ADA1, ADA0};
  wire [17:0] data_a =
      {DIA17, DIA16, DIA15, DIA14, DIA13, DIA12, DIA11, DIA10, DIA9, DIA8, DIA7, DIA6, DIA5, DIA4, DIA3, DIA2,
      DIA1, DIA0};
  wire [13:0] address_b =
      {ADB13, ADB12, ADB11, ADB10, ADB9, ADB8, ADB7, ADB6, ADB5, ADB4, ADB3, ADB2, ADB1, ADB0};
  wire [17:0] data_b =
      {DIB17, DIB16, DIB15, DIB14, DIB13, DIB12, DIB11, DIB10, DIB9, DIB8, DIB7, DIB6, DIB5, DIB4, DIB3, DIB2,
      DIB1, DIB0};

  // Lowest bit, in its row, of a word narrower than 18 bits; the ninth bits serve widths 9 and 18 only.
  function [4:0] lowest_bit(input integer width, input [3:0] low);
    case (width)
      1: lowest_bit = (low[3] ? 5'd9 : 5'd0) + {2'd0, low[2:0]};
      2: lowest_bit = (low[3] ? 5'd9 : 5'd0) + {2'd0, low[2:1], 1'b0};
      4: lowest_bit = (low[3] ? 5'd9 : 5'd0) + {2'd0, low[2], 2'b00};
      9: lowest_bit = low[3] ? 5'd9 : 5'd0;
      default: lowest_bit = 5'd0;
    endcase
  endfunction

  function [17:0] ones(input integer width);
    ones = width >= 18 ? 18'h3ffff : (18'd1 << width) - 18'd1;
  endfunction

  // Bits of its row a port writes.
  function [17:0] written(input integer width, input [3:0] low, input enable);
    if (!enable) written = 18'd0;
    else if (width >= 18) written = {{9{low[1]}}, {9{low[0]}}};
    else written = ones(width) << lowest_bit(width, low);
  endfunction

  wire write_a = CEA && WEA;
  wire write_b = CEB && WEB && !pseudo_dual;
  wire [9:0] row_a = address_a[13:4];
  wire [9:0] row_b = address_b[13:4];
  wire [17:0] bits_a = written(DATA_WIDTH_A, address_a[3:0], write_a);
  wire [17:0] bits_b = written(DATA_WIDTH_B, address_b[3:0], write_b);
  // Of a 36-bit write, port A writes the even row and the data of port B the odd one.
  wire [17:0] bits_odd = {{9{address_a[3] && write_a}}, {9{address_a[2] && write_a}}};
  wire [9:0] even_a = DATA_WIDTH_A == 36 ? {row_a[9:1], 1'b0} : row_a;
  wire [17:0] shifted_a = data_a << lowest_bit(DATA_WIDTH_A, address_a[3:0]);
  wire [17:0] shifted_b = data_b << lowest_bit(DATA_WIDTH_B, address_b[3:0]);

  always @(posedge CLKA) begin
    if (write_a) rows[even_a] <= (rows[even_a] & ~bits_a) | (shifted_a & bits_a);
    if (write_a && DATA_WIDTH_A == 36) rows[{row_a[9:1], 1'b1}] <= (rows[{row_a[9:1], 1'b1}] & ~bits_odd) | (data_b & bits_odd);
    if (write_b) rows[row_b] <= (rows[row_b] & ~bits_b) | (shifted_b & bits_b);
  end

  // Bits of `wanted` that port A writes in this clock.
  function [17:0] collision(input [9:0] wanted);
    if (DATA_WIDTH_A == 36 && wanted == {row_a[9:1], 1'b1}) collision = bits_odd;
    else if (wanted == even_a) collision = bits_a;
    else collision = 18'd0;
  endfunction

  reg [17:0] read_a;
  reg [17:0] read_b;
  reg [17:0] read_low;  // of a 36-bit word
  initial begin
    read_a = 18'd0;
    read_b = 18'd0;
    read_low = 18'd0;
  end

  wire [17:0] old_a = rows[row_a];
  wire [17:0] new_a = (old_a & ~bits_a) | (shifted_a & bits_a);
  wire [17:0] seen_a = (WRITEMODE_A == "WRITETHROUGH" ? new_a : old_a) ^ (row_a == row_b ? bits_b : 18'd0);
  wire [17:0] old_b = rows[row_b];
  wire [17:0] new_b = (old_b & ~bits_b) | (shifted_b & bits_b);
  wire [17:0] seen_b = (WRITEMODE_B == "WRITETHROUGH" ? new_b : old_b) ^ collision(row_b);
  wire [9:0] low_row = {row_b[9:1], 1'b0};
  wire [9:0] high_row = {row_b[9:1], 1'b1};

  always @(posedge CLKA) begin
    if (RSTA) read_a <= 18'd0;
    else if (CEA && !pseudo_dual && !(WEA && WRITEMODE_A == "NORMAL"))
      read_a <= (seen_a >> lowest_bit(DATA_WIDTH_A, address_a[3:0])) & ones(DATA_WIDTH_A);
  end
  always @(posedge CLKB) begin
    if (RSTB) begin
      read_b <= 18'd0;
      read_low <= 18'd0;
    end else if (CEB && DATA_WIDTH_B == 36) begin
      read_b <= rows[high_row] ^ collision(high_row);
      read_low <= rows[low_row] ^ collision(low_row);
    end else if (CEB && !(write_b && WRITEMODE_B == "NORMAL")) begin
      read_b <= (seen_b >> lowest_bit(DATA_WIDTH_B, address_b[3:0])) & ones(DATA_WIDTH_B);
    end
  end

  // Without a reset the mode does not matter.
  always @(posedge CLKA) begin
    if (RESETMODE != "SYNC" && (RSTA || RSTB)) begin
      $display("DP16KD: asynchronous reset is not modelled");
      $finish;
    end
  end

  // Output registers (REGMODE "OUTREG"): one more clock. A 36-bit word leaves by both ports, clocked by port B.
  wire [17:0] word_a = DATA_WIDTH_B == 36 ? read_low : read_a;
  reg [17:0] held_a;
  reg [17:0] held_b;
  initial begin
    held_a = 18'd0;
    held_b = 18'd0;
  end
  always @(posedge CLKA) begin
    if (RSTA && !pseudo_dual) held_a <= 18'd0;
    else if (pseudo_dual ? OCEB : OCEA) held_a <= word_a;
  end
  always @(posedge CLKB) begin
    if (RSTB) held_b <= 18'd0;
    else if (OCEB) held_b <= read_b;
  end
  wire [17:0] out_a = REGMODE_A == "OUTREG" ? held_a : word_a;
  wire [17:0] out_b = REGMODE_B == "OUTREG" ? held_b : read_b;
  assign
      {DOA17, DOA16, DOA15, DOA14, DOA13, DOA12, DOA11, DOA10, DOA9, DOA8, DOA7, DOA6, DOA5, DOA4, DOA3, DOA2,
      DOA1, DOA0} = out_a;
  assign
      {DOB17, DOB16, DOB15, DOB14, DOB13, DOB12, DOB11, DOB10, DOB9, DOB8, DOB7, DOB6, DOB5, DOB4, DOB3, DOB2,
      DOB1, DOB0} = out_b;
endmodule
