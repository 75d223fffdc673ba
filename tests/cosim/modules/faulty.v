// A correct two-input adder behind the RTL interface, and the same adder with one fault, chosen by the call's scalar
// `fault`: what the stream driver must catch. A call reads `count` tokens of `left` and `right` and writes their sums.
//
//   0 none                                  5 stops for ever after five tokens
//   1 withdraws tvalid while it waits       6 raises tvalid only when tready is there
//   2 changes its payload while it waits    7 payload depends on tready
//   3 loses the fifth token                 8 writes its last token twice and leaves one token of each input unread
//   4 sends the fifth token twice           9 uses left's payload of the clock before it is valid
module faulty (
    input  wire         clk,
    input  wire         rst,
    input  wire         call_tvalid,
    output wire         call_tready,
    input  wire [15:0]  count,
    input  wire [3:0]   fault,
    input  wire         s_axis_left_tvalid,
    output wire         s_axis_left_tready,
    input  wire [7:0]   s_axis_left_tdata,
    input  wire         s_axis_left_tlast,
    input  wire         s_axis_right_tvalid,
    output wire         s_axis_right_tready,
    input  wire [99:0]  s_axis_right_tdata,
    output wire         m_axis_out_tvalid,
    input  wire         m_axis_out_tready,
    output wire [99:0]  m_axis_out_tdata,
    output wire         m_axis_out_tlast
);
  reg [15:0] remaining;
  reg [15:0] taken;
  reg [3:0]  active_fault;
  reg        full;
  reg        again;
  reg        waited;
  reg [99:0] data;
  reg        last;
  reg [7:0]  earlier;

  wire stuck = active_fault == 4'd5 && taken == 16'd5;
  wire sent = m_axis_out_tvalid && m_axis_out_tready;
  wire space = !full || (sent && !again);
  wire take = remaining != 0 && s_axis_left_tvalid && s_axis_right_tvalid && space && !stuck;
  wire fifth = taken == 16'd4;

  assign call_tready = remaining == 0;
  assign s_axis_left_tready = take;
  assign s_axis_right_tready = take;
  assign m_axis_out_tvalid = full && !(active_fault == 4'd1 && waited) && !(active_fault == 4'd6 && !m_axis_out_tready);
  assign m_axis_out_tdata = data ^ {99'd0, active_fault == 4'd2 && waited} ^ {m_axis_out_tready && active_fault == 4'd7, 99'd0};
  assign m_axis_out_tlast = last;

  always @(posedge clk) begin
    earlier <= s_axis_left_tdata;
    if (sent) begin
      full <= again;
      again <= 1'b0;
    end
    waited <= m_axis_out_tvalid && !m_axis_out_tready;
    if (take) begin
      full <= !(active_fault == 4'd3 && fifth);
      again <= (active_fault == 4'd4 && fifth) || (active_fault == 4'd8 && remaining == 16'd2);
      data <= s_axis_right_tdata + {92'd0, active_fault == 4'd9 ? earlier : s_axis_left_tdata};
      last <= s_axis_left_tlast;
      taken <= taken + 16'd1;
      remaining <= active_fault == 4'd8 && remaining == 16'd2 ? 16'd0 : remaining - 16'd1;
    end
    if (call_tvalid && call_tready) begin
      remaining <= count;
      active_fault <= fault;
      taken <= 16'd0;
    end
    if (rst) begin
      remaining <= 16'd0;
      active_fault <= 4'd0;
      full <= 1'b0;
      again <= 1'b0;
      waited <= 1'b0;
    end
  end
endmodule
