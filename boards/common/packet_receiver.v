// Finds packets in the bytes from the line and checks them.
//
//   0x7e  content  CRC-32 of the content, low byte first  0x7e
//
// 0x7e stands nowhere else: content and CRC have 0x7d 0x5e for 0x7e and 0x7d 0x5d for 0x7d. So whatever was lost or
// changed, the next 0x7e is a fresh start.
module packet_receiver (
    input  wire       clk,
    input  wire       rst,
    input  wire [7:0] byte_data,
    input  wire       byte_valid,
    output wire [7:0] data,        // content as it comes: to be forgotten if the packet's end is not `good`
    output wire       valid,
    output wire       good,        // at the end of a packet: the CRC is right
    output wire       bad          // at the end of one whose CRC is wrong
);
    localparam [7:0] FLAG = 8'h7e, ESCAPE = 8'h7d;

    reg         escaped;
    reg  [2:0]  held;     // bytes in `last`, up to 4
    reg  [31:0] last;     // the last 4 bytes: they may be the CRC, so content leaves 4 bytes late
    reg  [31:0] crc;
    wire [31:0] next_crc;

    wire        is_flag = byte_data == FLAG;
    wire        is_escape = byte_data == ESCAPE;
    wire [7:0]  plain = escaped ? byte_data ^ 8'h20 : byte_data;
    wire        take = byte_valid && !is_flag && !is_escape;
    wire        at_end = byte_valid && is_flag && held != 3'd0;

    crc32_byte step (.crc_in(crc), .data(plain), .crc_out(next_crc));

    assign data  = last[7:0];
    assign valid = take && held == 3'd4;
    assign good  = at_end && held == 3'd4 && !escaped && crc == 32'hdebb20e3;
    assign bad   = at_end && !good;

    always @(posedge clk) begin
        if (rst || (byte_valid && is_flag)) begin
            escaped <= 1'b0;
            held    <= 3'd0;
            crc     <= 32'hffffffff;
        end else if (byte_valid && is_escape) begin
            escaped <= 1'b1;
        end else if (take) begin
            escaped <= 1'b0;
            last    <= {plain, last[31:8]};
            crc     <= next_crc;
            if (held != 3'd4) held <= held + 3'd1;
        end
    end
endmodule
