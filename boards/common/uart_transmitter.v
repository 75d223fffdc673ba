// Bytes to a serial line, the counterpart of uart_receiver.
module uart_transmitter #(
    parameter PERIOD_BITS = 18
) (
    input  wire                   clk,
    input  wire                   rst,
    input  wire [PERIOD_BITS-1:0] period,  // of a bit, in sixteenths of a clock
    input  wire [7:0]             data,
    input  wire                   valid,
    output wire                   ready,
    output reg                    line
);
    localparam [PERIOD_BITS-1:0] ONE_CLOCK = 16;

    reg [PERIOD_BITS-1:0] time_left;  // of the bit on the line
    reg [8:0]             shift;      // what follows it
    reg [3:0]             bits_left;  // with the one on the line

    assign ready = bits_left == 4'd0;

    always @(posedge clk) begin
        if (rst) begin
            bits_left <= 4'd0;
            line      <= 1'b1;
        end else if (ready) begin
            line <= 1'b1;
            if (valid) begin
                line      <= 1'b0;
                shift     <= {1'b1, data};
                bits_left <= 4'd10;
                time_left <= period - ONE_CLOCK;
            end
        end else if (time_left >= ONE_CLOCK) begin
            time_left <= time_left - ONE_CLOCK;
        end else begin
            time_left <= time_left + period - ONE_CLOCK;
            line      <= shift[0];
            shift     <= {1'b1, shift[8:1]};
            bits_left <= bits_left - 4'd1;
        end
    end
endmodule
