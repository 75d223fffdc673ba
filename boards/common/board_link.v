// Makes two reliable streams of bytes, host to design and design to host, of packets that may get lost. The board keeps no
// clock and sends nothing by itself: it answers, and every request may be sent again without harm. docs/board.md has the
// tables of the packets.
//
// Bytes are counted from the start of the session, either way. Host to design: the packet that begins at the byte which is
// expected is kept, any other only answered with the byte that is. Design to host: bytes are kept until the host says that
// it has them, and sent as often as it asks for them.
module board_link #(
    parameter DATA_ADDRESS_BITS = 13,    // bytes of pixels that wait for the design: the host's window
    parameter RESULT_ADDRESS_BITS = 12,  // bytes of results that wait for the host
    parameter IDENTITY_BYTES = 1
) (
    input  wire        clk,
    input  wire        rst,
    // from packet_receiver
    input  wire [7:0]  receive_data,
    input  wire        receive_valid,
    input  wire        receive_good,
    input  wire        receive_bad,
    // to packet_transmitter
    output wire [7:0]  send_data,
    output wire        send_valid,
    output wire        send_last,
    input  wire        send_ready,
    // the text by which the board names itself: `identity_data` is the byte at `identity_address`
    output wire [8:0]  identity_address,
    input  wire [7:0]  identity_data,
    // the streams
    output wire        restart,           // for one clock: a session begins, whatever was under way is forgotten
    output wire [7:0]  data,
    output wire        data_valid,
    input  wire        data_ready,
    input  wire [7:0]  result,
    input  wire        result_valid,
    output wire        result_ready,
    input  wire        design_busy,
    // for the lamps
    output wire        in_session,
    output wire        results_wait,
    output wire        any_bad
);
    localparam [7:0] IDENTIFY = 8'h01, START = 8'h02, DATA = 8'h03, READ = 8'h04, STATUS = 8'h05;
    localparam [7:0] IDENTITY = 8'h81, RESULT = 8'h84, STATE = 8'h85;
    localparam [10:0] MOST_RESULTS = 11'd1024;  // bytes in one answer

    // ---- requests ----
    reg  [55:0] header;         // kind, session (2 bytes), place (4)
    reg  [47:0] asked;          // of a READ: how many bytes from `place` on (2), bytes the host has (4)
    reg  [3:0]  request_bytes;  // seen so far, up to 7 + 6 and one more
    wire        in_payload = request_bytes >= 4'd7;
    wire [7:0]  kind = header[7:0];
    wire [31:0] place = header[55:24];

    reg  [15:0] session;
    reg  [31:0] expected;   // the next byte for the design
    reg  [31:0] seen;       // with those of the packet that is coming in
    reg  [7:0]  questions;  // place of the last STATUS: its answer tells that all before it has been seen
    reg  [15:0] bad_packets;

    wire understood = receive_good && in_payload && kind >= IDENTIFY && kind <= STATUS;
    wire this_session = header[23:8] == session && session != 16'd0;
    wire data_lost;
    wire put_data = receive_valid && in_payload && kind == DATA;
    wire data_kept = understood && kind == DATA && this_session && place == expected && !data_lost;
    wire read_asked = understood && kind == READ && this_session && request_bytes == 4'd13;

    assign restart    = understood && kind == START && header[23:8] != session && header[23:8] != 16'd0;
    assign in_session = session != 16'd0;
    assign any_bad    = bad_packets != 16'd0;

    always @(posedge clk) begin
        if (rst) begin
            request_bytes <= 4'd0;
            session       <= 16'd0;
            expected      <= 32'd0;
            seen          <= 32'd0;
            questions     <= 8'd0;
            bad_packets   <= 16'd0;
        end else begin
            if (receive_good || receive_bad) request_bytes <= 4'd0;
            else if (receive_valid) begin
                if (!in_payload) header <= {receive_data, header[55:8]};
                else asked <= {receive_data, asked[47:8]};
                if (request_bytes != 4'd14) request_bytes <= request_bytes + 4'd1;
            end
            if (receive_bad && bad_packets != 16'hffff) bad_packets <= bad_packets + 16'd1;
            if (restart) begin
                session   <= header[23:8];
                expected  <= 32'd0;
                seen      <= 32'd0;
                questions <= 8'd0;
            end else if (data_kept) expected <= seen;
            else if (receive_good || receive_bad) seen <= expected;
            else if (put_data) seen <= seen + 32'd1;
            if (understood && kind == STATUS) questions <= place[7:0];
        end
    end

    // ---- host to design ----
    wire [DATA_ADDRESS_BITS:0] room;

    packet_buffer #(
        .ADDRESS_BITS(DATA_ADDRESS_BITS)
    ) waiting_data (
        .clk(clk),
        .rst(rst || restart),
        .put_data(receive_data),
        .put(put_data),
        .commit(data_kept),
        .forget((receive_good || receive_bad) && !data_kept),
        .lost(data_lost),
        .room(room),
        .take_data(data),
        .take_valid(data_valid),
        .take_ready(data_ready)
    );

    // ---- design to host ----
    reg [7:0] results[0:(1 << RESULT_ADDRESS_BITS) - 1];
    reg [31:0] produced, released;  // bytes since the session began
    wire [31:0] kept = produced - released;
    wire [31:0] has_bytes = asked[47:16];
    wire [31:0] newly_released = has_bytes - released;

    assign result_ready = !kept[RESULT_ADDRESS_BITS];
    assign results_wait = kept != 32'd0;

    always @(posedge clk) begin
        if (rst || restart) begin
            produced <= 32'd0;
            released <= 32'd0;
        end else begin
            if (result_valid && result_ready) produced <= produced + 32'd1;
            if (read_asked && newly_released <= kept) released <= has_bytes;
        end
    end

    // ---- answers ----
    // A state answers any number of requests, so one mark suffices; reads are queued, and answered first, so that a state
    // comes behind the results that were asked for before it.
    reg identity_wanted, state_wanted;
    reg [47:0] reads[0:15];  // bytes (2), first byte (4)
    reg [3:0] read_in, read_out;
    wire [47:0] read = reads[read_out];
    wire [31:0] read_first = read[31:0];
    wire [31:0] read_behind = read_first - released;
    wire [31:0] read_ahead = produced - read_first;
    wire        read_possible = read_behind <= kept && read_ahead != 32'd0;

    reg [135:0] head;       // what is to be sent first, the next byte lowest
    reg [4:0]   head_left;
    reg [10:0]  body_left;  // bytes of the identity or of results that follow
    reg [31:0]  body_address;
    reg         body_is_identity;
    reg         body_fetched;
    reg [7:0]   result_byte, identity_byte;

    wire        idle = head_left == 5'd0 && body_left == 11'd0;
    wire [15:0] wide_room = {{15 - DATA_ADDRESS_BITS{1'b0}}, room};
    wire [10:0] read_bytes_wanted = read[47:32] > {5'd0, MOST_RESULTS} ? MOST_RESULTS : read[42:32];
    wire [10:0] read_bytes = read_ahead < {21'd0, read_bytes_wanted} ? read_ahead[10:0] : read_bytes_wanted;

    assign send_data        = head_left != 5'd0 ? head[7:0] : body_is_identity ? identity_byte : result_byte;
    assign send_valid       = head_left != 5'd0 || (body_left != 11'd0 && body_fetched);
    assign send_last        = head_left == 5'd1 ? body_left == 11'd0 : head_left == 5'd0 && body_left == 11'd1;
    assign identity_address = body_address[8:0];

    always @(posedge clk) begin
        if (result_valid && result_ready) results[produced[RESULT_ADDRESS_BITS-1:0]] <= result;
        result_byte   <= results[body_address[RESULT_ADDRESS_BITS-1:0]];
        identity_byte <= identity_data;
    end

    always @(posedge clk) begin
        if (read_asked) reads[read_in] <= {asked[15:0], place};
    end

    always @(posedge clk) begin
        if (rst) begin
            identity_wanted <= 1'b0;
            state_wanted    <= 1'b0;
            read_in         <= 4'd0;
            read_out        <= 4'd0;
            head_left       <= 5'd0;
            body_left       <= 11'd0;
            body_fetched    <= 1'b0;
        end else begin
            body_fetched <= 1'b1;
            if (idle) begin
                if (identity_wanted) begin
                    identity_wanted  <= 1'b0;
                    head             <= {112'd0, session, IDENTITY};
                    head_left        <= 5'd7;
                    body_left        <= IDENTITY_BYTES;
                    body_is_identity <= 1'b1;
                    body_address     <= 32'd0;
                    body_fetched     <= 1'b0;
                end else if (read_in != read_out) begin
                    read_out <= read_out + 4'd1;
                    if (read_possible && read_bytes != 11'd0) begin
                        head             <= {80'd0, read_first, session, RESULT};
                        head_left        <= 5'd7;
                        body_left        <= read_bytes;
                        body_is_identity <= 1'b0;
                        body_address     <= read_first;
                        body_fetched     <= 1'b0;
                    end else state_wanted <= 1'b1;
                end else if (state_wanted) begin
                    state_wanted <= 1'b0;
                    head         <= {questions, 7'd0, design_busy, bad_packets, produced, wide_room, expected, session, STATE};
                    head_left    <= 5'd17;
                end
            end else if (send_valid && send_ready) begin
                if (head_left != 5'd0) begin
                    head      <= {8'd0, head[135:8]};
                    head_left <= head_left - 5'd1;
                end else begin
                    body_left    <= body_left - 11'd1;
                    body_address <= body_address + 32'd1;
                    body_fetched <= 1'b0;
                end
            end

            // Last, so that a request which comes while another is answered is not lost.
            if (understood && kind == IDENTIFY) identity_wanted <= 1'b1;
            else if (understood && !read_asked) state_wanted <= 1'b1;
            if (read_asked) read_in <= read_in + 4'd1;
            if (restart) begin
                // What was asked of the session before has no answer any more.
                read_in  <= 4'd0;
                read_out <= 4'd0;
            end
        end
    end
endmodule
