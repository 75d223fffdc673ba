// A queue of bytes whose newest packet can be forgotten: bytes are put in as they come from the line, and may be taken out
// only after the packet's CRC was found right and `commit` came. One block RAM per 2048 bytes of ECP5.
module packet_buffer #(
    parameter ADDRESS_BITS = 13
) (
    input  wire                  clk,
    input  wire                  rst,
    input  wire [7:0]            put_data,
    input  wire                  put,
    input  wire                  commit,    // keep what was put since the last commit
    input  wire                  forget,    // or do not
    output reg                   lost,      // a byte since then found no room: the packet cannot be committed
    output wire [ADDRESS_BITS:0] room,      // bytes, besides what is committed
    output reg  [7:0]            take_data,
    output reg                   take_valid,
    input  wire                  take_ready
);
    reg [7:0] memory[0:(1 << ADDRESS_BITS) - 1];
    // One bit more than an address: full and empty differ.
    reg [ADDRESS_BITS:0] write, committed, read;

    wire [ADDRESS_BITS:0] used = committed - read;
    wire [ADDRESS_BITS:0] used_with_packet = write - read;
    wire                  full = used_with_packet[ADDRESS_BITS];

    assign room = {1'b1, {ADDRESS_BITS{1'b0}}} - used;

    always @(posedge clk) begin
        if (put && !full) memory[write[ADDRESS_BITS-1:0]] <= put_data;
        if ((!take_valid || take_ready) && read != committed) take_data <= memory[read[ADDRESS_BITS-1:0]];
    end

    always @(posedge clk) begin
        if (rst) begin
            write      <= 0;
            committed  <= 0;
            read       <= 0;
            lost       <= 1'b0;
            take_valid <= 1'b0;
        end else begin
            if (commit) committed <= write;
            if (forget) write <= committed;
            else if (put && !full) write <= write + 1'b1;
            if (commit || forget) lost <= 1'b0;
            else if (put && full) lost <= 1'b1;

            if (!take_valid || take_ready) begin
                take_valid <= read != committed;
                if (read != committed) read <= read + 1'b1;
            end
        end
    end
endmodule
