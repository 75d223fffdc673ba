// Drives one frame through a generated top of method 2 and checks the stream that comes out: as many pixels as went in, the
// first of the frame and the last of each row marked, and the disparity of a scene that is shifted by 3 pixels. The upper bit of a
// disparity says that it is defined.
//
// Bit-exact tests against the C++ and against the golden model are those of tests/cosim; this one shows that the files that
// FuseSoC collects are all there, in any Verilog simulator.
`timescale 1ns / 1ps
`ifndef TOP
`define TOP color_fuzzy_small
`endif

module color_fuzzy_testbench;
  localparam WIDTH = 60, HEIGHT = 40, SHIFT = 3, LEVELS = 8;

  reg clk = 0, rst = 1;
  always #3 clk = ~clk;

  reg call_valid = 0;
  wire call_ready, left_ready, right_ready;
  integer sent = 0, received = 0, right_disparities = 0, clocks = 0;

  // A texture without repetition, the same at (x, y) of the left picture and (x - SHIFT, y) of the right one.
  function [23:0] texture(input integer x, input integer y);
    reg [31:0] mixed;
    begin
      mixed = (x * 32'd2654435761) ^ (y * 32'd40503 + 32'd12345);
      mixed = (mixed ^ (mixed >> 13)) * 32'd1274126177;
      texture = mixed[30:7];
    end
  endfunction

  wire sending = sent < WIDTH * HEIGHT && !rst;
  wire [31:0] column = sent % WIDTH, row = sent / WIDTH;
  wire both_ready = left_ready & right_ready;
  wire first = sent == 0, last = column == WIDTH - 1;
  wire [23:0] left_pixel = texture(column, row), right_pixel = texture(column + SHIFT, row);

  wire [7:0] disparity;
  wire disparity_valid, disparity_first, disparity_last;

  `TOP stereo_core (
    .clk(clk), .rst(rst),
    .s_axis_left_tdata(left_pixel), .s_axis_left_tkeep(3'b111), .s_axis_left_tstrb(3'b111), .s_axis_left_tuser(first),
    .s_axis_left_tlast(last), .s_axis_left_tvalid(sending & both_ready), .s_axis_left_tready(left_ready),
    .s_axis_right_tdata(right_pixel), .s_axis_right_tkeep(3'b111), .s_axis_right_tstrb(3'b111), .s_axis_right_tuser(first),
    .s_axis_right_tlast(last), .s_axis_right_tvalid(sending & both_ready), .s_axis_right_tready(right_ready),
    .m_axis_disparity_tdata(disparity), .m_axis_disparity_tkeep(), .m_axis_disparity_tstrb(),
    .m_axis_disparity_tuser(disparity_first), .m_axis_disparity_tlast(disparity_last),
    .m_axis_disparity_tvalid(disparity_valid), .m_axis_disparity_tready(1'b1),
    .width(WIDTH), .height(HEIGHT), .levels(LEVELS), .left_right(1'b1), .uniqueness(5'd17), .fuzzy(2'd2), .careful_fill(1'b0),
    .call_tvalid(call_valid), .call_tready(call_ready));

  task fail(input [8 * 60 - 1:0] what);
    begin
      $display("FAILED after %0d pixels: %0s", received, what);
      $fatal;
    end
  endtask

  always @(posedge clk) begin
    clocks <= clocks + 1;
    rst <= clocks < 10;
    if (clocks == 12) call_valid <= 1;
    if (call_valid & call_ready) call_valid <= 0;
    if (sending & both_ready) sent <= sent + 1;
    if (disparity_valid) begin
      if (disparity_first !== (received == 0)) fail("the start of the frame is not marked right");
      if (disparity_last !== (received % WIDTH == WIDTH - 1)) fail("the end of a row is not marked right");
      if (disparity === {1'b1, 7'd0} + SHIFT) right_disparities <= right_disparities + 1;
      received <= received + 1;
    end
    if (clocks == 2 * WIDTH * HEIGHT + 2000) begin
      if (received != WIDTH * HEIGHT) fail("not as many pixels came out as went in");
      // The filter fills the border.
      if (10 * right_disparities < 9 * WIDTH * HEIGHT) fail("too few disparities are right");
      $display("PASSED: %0d pixels, %0d with the disparity of the scene", received, right_disparities);
      $finish;
    end
  end
endmodule
