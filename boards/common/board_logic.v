// Everything between two pins of a serial line and the design: independent of the device.
module board_logic #(
    parameter LANES = 1,                          // pixels a beat of the design
    parameter IDENTITY_BYTES = 1,
    parameter [8*IDENTITY_BYTES-1:0] IDENTITY = 0,  // the text by which the board names itself, its first letter highest
    parameter RATE_HOLD_BITS = 26,                // 2^this clocks after the last good packet the rate may change
    parameter INITIAL_PERIOD = 16 * 33            // of a bit, in sixteenths of a clock
) (
    input  wire                clk,
    input  wire                rst,
    input  wire                line_in,   // from the pin
    output wire                line_out,
    output wire [7:0]          lamps,
    // the design
    output wire                core_rst,
    output wire                call_tvalid,
    input  wire                call_tready,
    output wire [255:0]        call_arguments,
    output wire [24*LANES-1:0] left_tdata,
    output wire                left_tvalid,
    input  wire                left_tready,
    output wire [24*LANES-1:0] right_tdata,
    output wire                right_tvalid,
    input  wire                right_tready,
    input  wire [8*LANES-1:0]  disparity_tdata,
    input  wire                disparity_tvalid,
    output wire                disparity_tready
);
    localparam PERIOD_BITS = 18;  // slowest rate: 6.1 kbit/s at 100 MHz

    // The line has no relation to the clock.
    reg [2:0] line_registers;
    wire      line = line_registers[2];
    always @(posedge clk) line_registers <= rst ? 3'b111 : {line_registers[1:0], line_in};

    wire [PERIOD_BITS-1:0] period;
    reg  [RATE_HOLD_BITS:0] hold;
    wire                    holding = !hold[RATE_HOLD_BITS];
    rate_detector #(.PERIOD_BITS(PERIOD_BITS), .INITIAL_PERIOD(INITIAL_PERIOD)) rate (
        .clk(clk), .rst(rst), .enable(!holding), .line(line), .period(period));

    wire [7:0] received;
    wire       received_valid;
    uart_receiver #(.PERIOD_BITS(PERIOD_BITS)) receiver (
        .clk(clk), .rst(rst), .period(period), .line(line), .data(received), .valid(received_valid));

    wire [7:0] content;
    wire       content_valid, good, bad;
    packet_receiver packets_in (
        .clk(clk), .rst(rst), .byte_data(received), .byte_valid(received_valid),
        .data(content), .valid(content_valid), .good(good), .bad(bad));

    always @(posedge clk) begin
        if (rst) hold <= {1'b1, {RATE_HOLD_BITS{1'b0}}};
        else if (good) hold <= 0;
        else if (holding) hold <= hold + 1'b1;
    end

    wire [7:0] sent;
    wire       sent_valid, sent_ready;
    uart_transmitter #(.PERIOD_BITS(PERIOD_BITS)) transmitter (
        .clk(clk), .rst(rst), .period(period), .data(sent), .valid(sent_valid), .ready(sent_ready), .line(line_out));

    wire [7:0] answer;
    wire       answer_valid, answer_last, answer_ready;
    packet_transmitter packets_out (
        .clk(clk), .rst(rst), .data(answer), .valid(answer_valid), .last(answer_last), .ready(answer_ready),
        .byte_data(sent), .byte_valid(sent_valid), .byte_ready(sent_ready));

    wire [8:0] identity_address;
    reg  [7:0] identity_data;
    integer    i;
    always @* begin
        identity_data = 8'd0;
        for (i = 0; i < IDENTITY_BYTES; i = i + 1)
            if (identity_address == i[8:0]) identity_data = IDENTITY[8*(IDENTITY_BYTES-1-i)+:8];
    end

    wire       restart, in_session, results_wait, any_bad, busy, testing;
    wire [7:0] data, result;
    wire       data_valid, data_ready, result_valid, result_ready;
    board_link #(.IDENTITY_BYTES(IDENTITY_BYTES)) link (
        .clk(clk), .rst(rst),
        .receive_data(content), .receive_valid(content_valid), .receive_good(good), .receive_bad(bad),
        .send_data(answer), .send_valid(answer_valid), .send_last(answer_last), .send_ready(answer_ready),
        .identity_address(identity_address), .identity_data(identity_data),
        .restart(restart), .data(data), .data_valid(data_valid), .data_ready(data_ready),
        .result(result), .result_valid(result_valid && !core_rst), .result_ready(result_ready), .design_busy(busy),
        .in_session(in_session), .results_wait(results_wait), .any_bad(any_bad));

    // A session begins with a design that was reset: what a broken frame left in it is gone. From a register, since it goes
    // everywhere.
    reg [3:0] reset_clocks;
    reg       reset_register;
    always @(posedge clk) begin
        if (rst || restart) reset_clocks <= 4'd15;
        else if (reset_clocks != 4'd0) reset_clocks <= reset_clocks - 4'd1;
        reset_register <= rst || restart || reset_clocks != 4'd0;
    end
    assign core_rst = reset_register;

    board_job #(.LANES(LANES)) job (
        .clk(clk), .rst(core_rst),
        .in_data(data), .in_valid(data_valid), .in_ready(data_ready),
        .out_data(result), .out_valid(result_valid), .out_ready(result_ready),
        .busy(busy), .testing(testing),
        .call_tvalid(call_tvalid), .call_tready(call_tready), .call_arguments(call_arguments),
        .left_tdata(left_tdata), .left_tvalid(left_tvalid), .left_tready(left_tready),
        .right_tdata(right_tdata), .right_tvalid(right_tvalid), .right_tready(right_tready),
        .disparity_tdata(disparity_tdata), .disparity_tvalid(disparity_tvalid), .disparity_tready(disparity_tready));

    assign lamps = {1'b1, holding, in_session, busy, testing, results_wait, any_bad, !line};
endmodule
