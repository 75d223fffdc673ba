// Models of the iCE40 cells that Yosys maps generated Verilog to, for simulating netlists. Only what synth_ice40 makes of
// one clock: rising edges, synchronous set and reset, block RAM with one port to read and one to write.

module SB_LUT4 #(
  parameter [15:0] LUT_INIT = 16'h0000
) (
  input  wire I0, I1, I2, I3,
  output wire O
);
  assign O = LUT_INIT[{I3, I2, I1, I0}];
endmodule

module SB_CARRY (
  input  wire I0, I1, CI,
  output wire CO
);
  assign CO = (I0 & I1) | ((I0 | I1) & CI);
endmodule

// Set and reset of the cells with an enable happen only when it is set.

module SB_DFF (
  input  wire C, D,
  output reg  Q
);
  always @(posedge C) Q <= D;
endmodule

module SB_DFFSR (
  input  wire C, R, D,
  output reg  Q
);
  always @(posedge C) Q <= R ? 1'b0 : D;
endmodule

module SB_DFFSS (
  input  wire C, S, D,
  output reg  Q
);
  always @(posedge C) Q <= S ? 1'b1 : D;
endmodule

module SB_DFFE (
  input  wire C, E, D,
  output reg  Q
);
  always @(posedge C) if (E) Q <= D;
endmodule

module SB_DFFESR (
  input  wire C, E, R, D,
  output reg  Q
);
  always @(posedge C) if (E) Q <= R ? 1'b0 : D;
endmodule

module SB_DFFESS (
  input  wire C, E, S, D,
  output reg  Q
);
  always @(posedge C) if (E) Q <= S ? 1'b1 : D;
endmodule

// 4 kbit: 256 words of 16 bits; in mode m a word is 16 >> m bits wide, and the address's upper bits choose which bit of
// every group of 1 << m bits it takes. Both ports see what stood there before a write in the same clock.
module SB_RAM40_4K #(
  parameter [1:0] WRITE_MODE = 0,
  parameter [1:0] READ_MODE = 0,
  parameter [255:0] INIT_0 = 256'd0,
  parameter [255:0] INIT_1 = 256'd0,
  parameter [255:0] INIT_2 = 256'd0,
  parameter [255:0] INIT_3 = 256'd0,
  parameter [255:0] INIT_4 = 256'd0,
  parameter [255:0] INIT_5 = 256'd0,
  parameter [255:0] INIT_6 = 256'd0,
  parameter [255:0] INIT_7 = 256'd0,
  parameter [255:0] INIT_8 = 256'd0,
  parameter [255:0] INIT_9 = 256'd0,
  parameter [255:0] INIT_A = 256'd0,
  parameter [255:0] INIT_B = 256'd0,
  parameter [255:0] INIT_C = 256'd0,
  parameter [255:0] INIT_D = 256'd0,
  parameter [255:0] INIT_E = 256'd0,
  parameter [255:0] INIT_F = 256'd0
) (
  input  wire        RCLK, RCLKE, RE,
  input  wire [10:0] RADDR,
  output wire [15:0] RDATA,
  input  wire        WCLK, WCLKE, WE,
  input  wire [10:0] WADDR,
  input  wire [15:0] MASK,
  input  wire [15:0] WDATA
);
  localparam integer WRITE_GROUP = 1 << WRITE_MODE;
  localparam integer READ_GROUP = 1 << READ_MODE;
  localparam [4095:0] INITIAL = {INIT_F, INIT_E, INIT_D, INIT_C, INIT_B, INIT_A, INIT_9, INIT_8,
                                 INIT_7, INIT_6, INIT_5, INIT_4, INIT_3, INIT_2, INIT_1, INIT_0};
  reg [15:0] words [0:255];
  reg [15:0] written;
  reg [15:0] read;
  reg [2:0] read_bit;
  integer i;
  initial for (i = 0; i < 256; i = i + 1) words[i] = INITIAL[16*i+:16];

  always @(posedge WCLK) begin
    if (WE && WCLKE) begin
      written = words[WADDR[7:0]];
      for (i = 0; i < 16; i = i + 1) begin
        // The bits of a narrow word lie in the middle of their groups.
        if (WRITE_MODE == 0 ? !MASK[i] : i % WRITE_GROUP == WADDR[10:8] % WRITE_GROUP) begin
          written[i] = WDATA[i - i % WRITE_GROUP + (WRITE_GROUP - 1) / 2];
        end
      end
      words[WADDR[7:0]] <= written;
    end
  end

  always @(posedge RCLK) begin
    if (RE && RCLKE) begin
      read <= words[RADDR[7:0]];
      read_bit <= RADDR[10:8];
    end
  end
  genvar k;
  generate
    for (k = 0; k < 16; k = k + 1) begin : outputs
      if (k % READ_GROUP == (READ_GROUP - 1) / 2) begin : used
        assign RDATA[k] = read[k - k % READ_GROUP + read_bit % READ_GROUP];
      end else begin : unused
        assign RDATA[k] = 1'b0;
      end
    end
  endgenerate
endmodule
