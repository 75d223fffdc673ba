// Bytes from a serial line: one start bit (0), eight data bits from the lowest, one stop bit (1).
//
// The length of a bit is a number of sixteenths of a clock, so that any rate is met from any clock: the error of a byte's
// last sample stays below half a clock. At least 4 clocks a bit.
module uart_receiver #(
    parameter PERIOD_BITS = 18
) (
    input  wire                   clk,
    input  wire                   rst,
    input  wire [PERIOD_BITS-1:0] period,  // of a bit, in sixteenths of a clock
    input  wire                   line,    // already synchronised to clk; 1 = idle
    output reg  [7:0]             data,
    output reg                    valid    // for one clock; a byte without a stop bit is left out
);
    localparam [PERIOD_BITS-1:0] ONE_CLOCK = 16;

    reg [PERIOD_BITS-1:0] time_left;  // until the next sample, the middle of a bit
    reg [3:0]             bits_left;  // start, data and stop bits still to be sampled; 0: waiting for a start bit
    reg                   was_high;

    always @(posedge clk) begin
        valid    <= 1'b0;
        was_high <= line;
        if (rst) begin
            bits_left <= 4'd0;
            was_high  <= 1'b0;
        end else if (bits_left == 4'd0) begin
            time_left <= {1'b0, period[PERIOD_BITS-1:1]} - ONE_CLOCK;
            if (was_high && !line) bits_left <= 4'd10;
        end else if (time_left >= ONE_CLOCK) begin
            time_left <= time_left - ONE_CLOCK;
        end else begin
            // The rest that is less than a clock is carried over to the next bit.
            time_left <= time_left + period - ONE_CLOCK;
            bits_left <= bits_left - 4'd1;
            if (bits_left == 4'd10) begin
                if (line) bits_left <= 4'd0;  // a spike, not a start bit
            end else if (bits_left == 4'd1) begin
                valid <= line;
            end else begin
                data <= {line, data[7:1]};
            end
        end
    end
endmodule
