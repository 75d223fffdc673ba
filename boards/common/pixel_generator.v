// Pseudo-random pixels for the self-test: a linear feedback shift register of x^64 + x^63 + x^61 + x^60 + 1, moved on by
// as many bits a beat as the beat has. The host does the same in software.
module pixel_generator #(
    parameter BITS = 24  // of a beat, at most 60: then every new bit depends on bits of the old state only
) (
    input  wire            clk,
    input  wire            load,
    input  wire [63:0]     seed,
    input  wire            step,
    output wire [BITS-1:0] beat   // the BITS newest bits
);
    reg [63:0] state;
    reg [63:0] next;
    integer i;

    assign beat = state[BITS-1:0];

    always @* begin
        next = state;
        for (i = 0; i < BITS; i = i + 1) next = {next[62:0], next[63] ^ next[62] ^ next[60] ^ next[59]};
    end
    always @(posedge clk) begin
        if (load) state <= seed;
        else if (step) state <= next;
    end
endmodule
