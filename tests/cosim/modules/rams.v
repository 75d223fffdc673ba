// Every way Yosys uses a block RAM of ECP5, behind the RTL interface: a delay of some tokens through RAMs of several
// widths and depths, a LUT RAM, a ROM in block RAM and a multiplier. One token in, one token out.
module rams (
    input  wire         clk,
    input  wire         rst,
    input  wire         s_axis_in_tvalid,
    output wire         s_axis_in_tready,
    input  wire [79:0]  s_axis_in_tdata,
    output wire         m_axis_out_tvalid,
    input  wire         m_axis_out_tready,
    output wire [79:0]  m_axis_out_tdata
);
  // The oldest token leaves when the next one comes in.
  reg [10:0] write_address;
  reg        full;
  reg        loaded;
  wire       advance = s_axis_in_tvalid && s_axis_in_tready;
  assign s_axis_in_tready = !full || m_axis_out_tready;
  assign m_axis_out_tvalid = full;

  (* no_rw_check *) reg [39:0] wide[0:511];      // 36 bits a word and a rest
  (* no_rw_check *) reg [17:0] deep[0:1023];     // 18 bits a word
  (* no_rw_check *) reg [8:0]  deeper[0:2047];   // 9 bits a word
  reg [3:0]  little[0:15];                        // LUT RAM
  reg [15:0] squares[0:511];                     // ROM
  integer i;
  reg [31:0] squared;
  initial begin
    for (i = 0; i < 512; i = i + 1) begin
      squared = i * i;
      squares[i] = squared[15:0];
    end
  end

  reg [39:0] wide_out;
  reg [17:0] deep_out;
  reg [8:0]  deeper_out;
  reg [3:0]  little_out;
  reg [15:0] square;
  reg [35:0] product;
  wire [10:0] read_address = write_address - 11'd9;

  always @(posedge clk) begin
    if (m_axis_out_tready) full <= 1'b0;
    if (advance) begin
      wide[write_address[8:0]] <= s_axis_in_tdata[39:0];
      deep[write_address[9:0]] <= s_axis_in_tdata[57:40];
      deeper[write_address] <= s_axis_in_tdata[66:58];
      little[write_address[3:0]] <= s_axis_in_tdata[70:67];
      wide_out <= wide[read_address[8:0]];
      deep_out <= deep[read_address[9:0]];
      deeper_out <= deeper[read_address];
      little_out <= little[read_address[3:0]];
      square <= squares[s_axis_in_tdata[79:71]];
      product <= {18'd0, s_axis_in_tdata[17:0]} * {18'd0, s_axis_in_tdata[35:18]};
      write_address <= write_address + 11'd1;
      full <= write_address >= 11'd9 || loaded;
      if (write_address == 11'd9) loaded <= 1'b1;
    end
    if (rst) begin
      write_address <= 11'd0;
      full <= 1'b0;
      loaded <= 1'b0;
    end
  end
  assign m_axis_out_tdata = {square ^ product[35:20], 9'd0, little_out ^ product[3:0], deeper_out, deep_out[1:0] ^ product[5:4], wide_out}
                            ^ {44'd0, deep_out, 18'd0};
endmodule
