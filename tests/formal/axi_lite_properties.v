// AXI4-Lite's rules for the register slave of count_up, for any master: proved by temporal induction (Yosys' own solver),
// see prove_axi_lite_test.py. They speak of ports only; they hold from the first reset on.
module axi_lite_properties (
  input wire        clk,
  input wire        rst,
  input wire [11:0] awaddr,
  input wire        awvalid,
  input wire [31:0] wdata,
  input wire [3:0]  wstrb,
  input wire        wvalid,
  input wire        bready,
  input wire [11:0] araddr,
  input wire        arvalid,
  input wire        rready,
  input wire        started
);
  wire awready, wready, bvalid, arready, rvalid, start, hold, keep;
  wire [1:0] bresp, rresp;
  wire [31:0] rdata;
  wire [23:0] arguments;
  count_up_registers slave (
    .clk(clk), .rst(rst),
    .s_axi_awaddr(awaddr), .s_axi_awvalid(awvalid), .s_axi_awready(awready),
    .s_axi_wdata(wdata), .s_axi_wstrb(wstrb), .s_axi_wvalid(wvalid), .s_axi_wready(wready),
    .s_axi_bresp(bresp), .s_axi_bvalid(bvalid), .s_axi_bready(bready),
    .s_axi_araddr(araddr), .s_axi_arvalid(arvalid), .s_axi_arready(arready),
    .s_axi_rdata(rdata), .s_axi_rresp(rresp), .s_axi_rvalid(rvalid), .s_axi_rready(rready),
    .started(started), .start(start), .hold(hold), .keep(keep), .arguments(arguments)
  );

  reg after_reset = 0;  // there was a reset
  reg just_reset = 0;
  reg [1:0] addresses, data, reads;  // accepted, and not yet answered
  reg bvalid_before, bready_before, rvalid_before, rready_before, start_before, started_before;
  reg [1:0] bresp_before, rresp_before;
  reg [31:0] rdata_before;
  reg [23:0] arguments_before;
  always @(posedge clk) begin
    after_reset <= after_reset | rst;
    just_reset <= rst;
    addresses <= rst ? 2'd0 : addresses + {1'b0, awvalid & awready} - {1'b0, bvalid & bready};
    data <= rst ? 2'd0 : data + {1'b0, wvalid & wready} - {1'b0, bvalid & bready};
    reads <= rst ? 2'd0 : reads + {1'b0, arvalid & arready} - {1'b0, rvalid & rready};
    bvalid_before <= bvalid;
    bready_before <= bready;
    bresp_before <= bresp;
    rvalid_before <= rvalid;
    rready_before <= rready;
    rresp_before <= rresp;
    rdata_before <= rdata;
    arguments_before <= arguments;
    start_before <= start;
    started_before <= started;
  end

  always @* if (after_reset) begin
    // As many responses as requests: none without both parts of a write, none lost, none twice.
    assert (addresses == {1'b0, bvalid} + {1'b0, ~awready & ~just_reset});
    assert (data == {1'b0, bvalid} + {1'b0, ~wready & ~just_reset});
    assert (reads == {1'b0, rvalid} + {1'b0, ~arready & ~just_reset});
    if (just_reset) begin
      assert (!bvalid && !rvalid && !start && !hold && !keep && arguments == 24'd0);
    end else begin
      // A response waits, unchanged, until it is taken.
      if (bvalid_before && !bready_before) assert (bvalid && bresp == bresp_before);
      if (rvalid_before && !rready_before) assert (rvalid && rresp == rresp_before && rdata == rdata_before);
      // OKAY or SLVERR; an error has no data.
      if (bvalid) assert (bresp == 2'b00 || bresp == 2'b10);
      if (rvalid) assert (rresp == 2'b00 || (rresp == 2'b10 && rdata == 32'd0));
      // Arguments change only with a write that is answered from this clock on.
      if (arguments != arguments_before) assert (bvalid && (!bvalid_before || bready_before) && bresp == 2'b00);
      // `start` goes when a call starts, unless it is written in that very clock.
      if (start_before && start) assert (!started_before || (bvalid && bresp == 2'b00));
      if (start_before && !start) assert (started_before);
    end
  end
endmodule
