// Makes packets of content, the counterpart of packet_receiver. `last` marks a packet's last byte of content.
module packet_transmitter (
    input  wire       clk,
    input  wire       rst,
    input  wire [7:0] data,
    input  wire       valid,
    input  wire       last,
    output wire       ready,
    output reg  [7:0] byte_data,
    output wire       byte_valid,
    input  wire       byte_ready
);
    localparam [7:0] FLAG = 8'h7e, ESCAPE = 8'h7d;
    localparam [1:0] OPEN = 2'd0, CONTENT = 2'd1, CHECK = 2'd2, CLOSE = 2'd3;

    reg  [1:0]  state;
    reg  [1:0]  check_bytes;  // of the CRC, already sent
    reg         escaped;      // the escape that comes before the byte has been sent
    reg  [31:0] crc;
    wire [31:0] next_crc;

    wire [7:0] plain = state == CONTENT ? data : ~crc[7:0];
    wire       special = plain == FLAG || plain == ESCAPE;
    wire       sent = byte_valid && byte_ready;
    wire       byte_done = sent && (!special || escaped);

    crc32_byte step (.crc_in(crc), .data(data), .crc_out(next_crc));

    assign ready      = state == CONTENT && byte_done;
    assign byte_valid = state == OPEN || state == CONTENT ? valid : 1'b1;

    always @* begin
        if (state == OPEN || state == CLOSE) byte_data = FLAG;
        else if (!special) byte_data = plain;
        else if (!escaped) byte_data = ESCAPE;
        else byte_data = plain ^ 8'h20;
    end

    always @(posedge clk) begin
        if (rst) begin
            state   <= OPEN;
            escaped <= 1'b0;
        end else if (sent) begin
            escaped <= (state == CONTENT || state == CHECK) && special && !escaped;
            case (state)
                OPEN: begin
                    state       <= CONTENT;
                    check_bytes <= 2'd0;
                    crc         <= 32'hffffffff;
                end
                CONTENT:
                if (byte_done) begin
                    crc <= next_crc;
                    if (last) state <= CHECK;
                end
                CHECK:
                if (byte_done) begin
                    crc         <= {8'd0, crc[31:8]};
                    check_bytes <= check_bytes + 2'd1;
                    if (check_bytes == 2'd3) state <= CLOSE;
                end
                CLOSE: state <= OPEN;
            endcase
        end
    end
endmodule
