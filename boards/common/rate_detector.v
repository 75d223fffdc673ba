// Measures the length of a bit: the host picks the rate and sends bytes 0x55, whose start, data and stop bits alternate,
// so that the line is a square wave with one level a bit. Sixteen levels of about one length, counted in clocks, are the
// length of a bit in sixteenths of a clock.
//
// Of all bytes only 0xf0 looks alike (two levels of five bits), and it may stand in a picture: therefore measuring is
// enabled only while nothing sensible has been received for a while.
module rate_detector #(
    parameter PERIOD_BITS = 18,
    parameter [PERIOD_BITS-1:0] INITIAL_PERIOD = 16 * 33
) (
    input  wire                   clk,
    input  wire                   rst,
    input  wire                   enable,
    input  wire                   line,
    output reg  [PERIOD_BITS-1:0] period
);
    localparam LENGTH_BITS = PERIOD_BITS - 4;
    localparam [LENGTH_BITS-1:0] SHORTEST = 3, LONGEST = {LENGTH_BITS{1'b1}};

    reg                   last_line;
    reg [LENGTH_BITS-1:0] length;       // clocks since the last edge
    reg [LENGTH_BITS-1:0] last_length;  // of the level before
    reg [3:0]             alike;        // levels of one length before this one
    reg [PERIOD_BITS-1:0] total;        // and their clocks

    wire                   longer = length > last_length;
    wire [LENGTH_BITS-1:0] difference = longer ? length - last_length : last_length - length;
    wire                   fits = difference <= {2'b00, last_length[LENGTH_BITS-1:2]} + 1'b1 && length >= SHORTEST &&
                                     length != LONGEST;

    always @(posedge clk) begin
        last_line <= line;
        if (rst) begin
            period      <= INITIAL_PERIOD;
            last_line   <= 1'b1;
            length      <= LONGEST;
            last_length <= LONGEST;
            alike       <= 4'd0;
            total       <= {PERIOD_BITS{1'b0}};
        end else if (line == last_line) begin
            if (length != LONGEST) length <= length + 1'b1;
        end else begin
            length      <= {{LENGTH_BITS - 1{1'b0}}, 1'b1};
            last_length <= length;
            if (fits && enable) begin
                alike <= alike + 4'd1;
                total <= total + {4'd0, length};
                if (alike == 4'd15) begin
                    period <= total + {4'd0, length};
                    total  <= {PERIOD_BITS{1'b0}};
                end
            end else begin
                alike <= 4'd0;
                total <= {PERIOD_BITS{1'b0}};
            end
        end
    end
endmodule
