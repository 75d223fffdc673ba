// Runs the design on what the host sends. Frame by frame, the stream of bytes is
//
//   64 bytes that say what to do (docs/board.md), then, unless it is a self-test, the beats of the two pictures
//
// and what goes back is the disparities' bytes, or the self-test's 16 bytes of results. A self-test generates its pictures
// here, so that the design gets a beat in every clock in which it takes one; a CRC-32 of its output, and clocks, are counted.
module board_job #(
    parameter LANES = 1  // pixels a beat: 1 or 2
) (
    input  wire                clk,
    input  wire                rst,            // of the session, too
    input  wire [7:0]          in_data,
    input  wire                in_valid,
    output wire                in_ready,
    output wire [7:0]          out_data,
    output wire                out_valid,
    input  wire                out_ready,
    output wire                busy,
    output wire                testing,
    // the design
    output wire                call_tvalid,
    input  wire                call_tready,
    output wire [255:0]        call_arguments,  // 16 bits each, in the order of the top's parameters
    output reg  [24*LANES-1:0] left_tdata,
    output wire                left_tvalid,
    input  wire                left_tready,
    output reg  [24*LANES-1:0] right_tdata,
    output wire                right_tvalid,
    input  wire                right_tready,
    input  wire [8*LANES-1:0]  disparity_tdata,
    input  wire                disparity_tvalid,
    output wire                disparity_tready
);
    localparam [2:0] ORDER = 3'd0, PREPARE = 3'd1, CALL = 3'd2, FRAME = 3'd3, TEST = 3'd4, REPORT = 3'd5;
    localparam BEAT_BYTES = 6 * LANES;
    localparam [3:0] LAST_OF_BEAT = BEAT_BYTES - 1;

    reg  [2:0]   state;
    reg  [511:0] order;
    reg  [5:0]   order_bytes;
    wire         order_tests = order[7:0] == 8'd1;
    wire [23:0]  order_beats = order[31:8];
    wire [31:0]  order_frames = order[63:32];

    assign call_arguments = order[511:256];
    assign busy           = state != ORDER;
    assign testing        = state == TEST;

    // ---- beats into the design ----
    // Both streams take one beat each before the next is offered: one may be ready before the other.
    reg                    left_waits, right_waits;
    wire                   beat_free = (!left_waits || left_tready) && (!right_waits || right_tready);
    reg  [23:0]            beats_left;   // of the frame that is going in
    reg  [31:0]            frames_left;  // of the self-test
    reg  [48*LANES-1:0]    gathered;     // bytes of a beat from the host: left lanes, then right lanes
    reg  [3:0]             gathered_bytes;
    reg                    gathered_all;
    wire                   generating = testing && frames_left != 32'd0;
    wire                   load_beat = beat_free && (generating || (state == FRAME && gathered_all));

    assign left_tvalid  = left_waits;
    assign right_tvalid = right_waits;
    assign in_ready     = state == ORDER || (state == FRAME && !gathered_all);

    // Left pixels come from two sequences in turns of 32 beats. With seeds that are stages of the right one's sequence the
    // pictures have two disparities, with edges between them.
    wire [24*LANES-1:0] left_near, left_far, right_pixels;
    wire                seed_now = state == PREPARE;
    reg                 far;
    reg  [4:0]          turn;

    pixel_generator #(.BITS(24 * LANES)) near_generator (
        .clk(clk), .load(seed_now), .seed(order[127:64]), .step(load_beat), .beat(left_near));
    pixel_generator #(.BITS(24 * LANES)) far_generator (
        .clk(clk), .load(seed_now), .seed(order[191:128]), .step(load_beat), .beat(left_far));
    pixel_generator #(.BITS(24 * LANES)) right_generator (
        .clk(clk), .load(seed_now), .seed(order[255:192]), .step(load_beat), .beat(right_pixels));

    always @(posedge clk) begin
        if (load_beat) begin
            left_tdata  <= !testing ? gathered[24*LANES-1:0] : far ? left_far : left_near;
            right_tdata <= testing ? right_pixels : gathered[48*LANES-1:24*LANES];
        end
        if (state == FRAME && in_valid && in_ready) gathered <= {in_data, gathered[48*LANES-1:8]};
    end

    // ---- the design's output ----
    reg  [8*LANES-1:0] result;        // to the host, byte by byte
    reg  [1:0]         result_bytes;
    reg                tested;        // a beat of the self-test for the CRC
    reg  [8*LANES-1:0] tested_beat;
    reg  [31:0]        crc;
    wire [31:0]        crcs[0:LANES];
    reg  [31:0]        clocks;
    reg                clocks_run;
    reg  [31:0]        first_frame_clocks, all_clocks;
    reg  [23:0]        out_beats_left;
    reg  [31:0]        out_frames_left;
    reg                first_frame;
    wire               out_beat = testing && disparity_tvalid;
    reg  [127:0]       report;
    reg  [4:0]         report_bytes;

    assign out_data         = state == REPORT ? report[7:0] : result[7:0];
    assign out_valid        = state == REPORT ? report_bytes != 5'd0 : result_bytes != 2'd0;
    assign disparity_tready = testing || (result_bytes == 2'd0 && state != REPORT);

    assign crcs[0] = crc;
    genvar lane;
    generate
        for (lane = 0; lane < LANES; lane = lane + 1) begin : lanes
            crc32_byte step (.crc_in(crcs[lane]), .data(tested_beat[8*lane+:8]), .crc_out(crcs[lane+1]));
        end
    endgenerate

    // ---- calls ----
    reg [31:0] calls_left;
    assign call_tvalid = calls_left != 32'd0 && (state == CALL || state == TEST);

    always @(posedge clk) begin
        if (rst) begin
            state          <= ORDER;
            order_bytes    <= 6'd0;
            left_waits     <= 1'b0;
            right_waits    <= 1'b0;
            gathered_bytes <= 4'd0;
            gathered_all   <= 1'b0;
            result_bytes   <= 2'd0;
            tested         <= 1'b0;
        end else begin
            if (left_tready) left_waits <= 1'b0;
            if (right_tready) right_waits <= 1'b0;
            if (load_beat) begin
                left_waits   <= 1'b1;
                right_waits  <= 1'b1;
                gathered_all <= 1'b0;
                turn         <= turn + 5'd1;
                if (turn == 5'd31) far <= !far;
                beats_left <= beats_left - 24'd1;
                if (beats_left == 24'd1) begin
                    beats_left  <= order_beats;
                    frames_left <= frames_left - 32'd1;
                    if (state == FRAME) state <= ORDER;
                end
            end
            if (call_tvalid && call_tready) calls_left <= calls_left - 32'd1;

            // Disparities to the host.
            if (!testing && disparity_tvalid && disparity_tready) begin
                result       <= disparity_tdata;
                result_bytes <= LANES;
            end else if (state != REPORT && out_valid && out_ready) begin
                result       <= result >> 8;
                result_bytes <= result_bytes - 2'd1;
            end

            // The self-test's output.
            tested      <= out_beat;
            tested_beat <= disparity_tdata;
            if (tested) crc <= crcs[LANES];
            if (testing && (clocks_run || (left_tvalid && left_tready) || (right_tvalid && right_tready))) begin
                clocks_run <= 1'b1;
                clocks     <= clocks + 32'd1;
            end
            if (out_beat) begin
                out_beats_left <= out_beats_left - 24'd1;
                if (out_beats_left == 24'd1) begin
                    out_beats_left  <= order_beats;
                    out_frames_left <= out_frames_left - 32'd1;
                    first_frame     <= 1'b0;
                    // The clock of the last beat counts, too.
                    if (first_frame) first_frame_clocks <= clocks + 32'd1;
                    all_clocks <= clocks + 32'd1;
                end
            end

            case (state)
                ORDER:
                if (in_valid) begin
                    order       <= {in_data, order[511:8]};
                    order_bytes <= order_bytes + 6'd1;
                    if (order_bytes == 6'd63) state <= PREPARE;
                end
                PREPARE: begin
                    state           <= order_tests ? TEST : CALL;
                    calls_left      <= order_tests ? order_frames : 32'd1;
                    beats_left      <= order_beats;
                    frames_left     <= order_frames;
                    out_beats_left  <= order_beats;
                    out_frames_left <= order_frames;
                    first_frame     <= 1'b1;
                    far             <= 1'b0;
                    turn            <= 5'd0;
                    crc             <= 32'hffffffff;
                    clocks          <= 32'd0;
                    clocks_run      <= 1'b0;
                end
                CALL: if (call_tvalid && call_tready) state <= FRAME;
                FRAME:
                if (in_valid && in_ready) begin
                    gathered_bytes <= gathered_bytes + 4'd1;
                    if (gathered_bytes == LAST_OF_BEAT) begin
                        gathered_bytes <= 4'd0;
                        gathered_all   <= 1'b1;
                    end
                end
                TEST:
                if (out_frames_left == 32'd0 && !tested) begin
                    state        <= REPORT;
                    report       <= {32'd0, all_clocks, first_frame_clocks, ~crc};
                    report_bytes <= 5'd16;
                end
                default:  // REPORT
                if (report_bytes == 5'd0) state <= ORDER;
                else if (out_ready) begin
                    report       <= {8'd0, report[127:8]};
                    report_bytes <= report_bytes - 5'd1;
                end
            endcase
        end
    end
endmodule
