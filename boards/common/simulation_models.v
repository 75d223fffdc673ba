// What stands for the device's own blocks in simulation.

// The PLL: the simulation is run at the clock that it would make, so it lets its input through.
/* verilator lint_off UNUSED */
/* verilator lint_off DECLFILENAME */
module EHXPLLL #(
    parameter PLLRST_ENA = "DISABLED",
    parameter INTFB_WAKE = "DISABLED",
    parameter STDBY_ENABLE = "DISABLED",
    parameter DPHASE_SOURCE = "DISABLED",
    parameter OUTDIVIDER_MUXA = "DIVA",
    parameter OUTDIVIDER_MUXB = "DIVB",
    parameter OUTDIVIDER_MUXC = "DIVC",
    parameter OUTDIVIDER_MUXD = "DIVD",
    parameter CLKI_DIV = 1,
    parameter CLKOP_ENABLE = "ENABLED",
    parameter CLKOP_DIV = 8,
    parameter CLKOP_CPHASE = 0,
    parameter CLKOP_FPHASE = 0,
    parameter FEEDBK_PATH = "CLKOP",
    parameter CLKFB_DIV = 1
) (
    input  wire CLKI,
    input  wire CLKFB,
    input  wire RST,
    input  wire STDBY,
    input  wire PHASESEL0,
    input  wire PHASESEL1,
    input  wire PHASEDIR,
    input  wire PHASESTEP,
    input  wire PHASELOADREG,
    input  wire PLLWAKESYNC,
    input  wire ENCLKOP,
    input  wire ENCLKOS,
    input  wire ENCLKOS2,
    input  wire ENCLKOS3,
    output wire CLKOP,
    output wire CLKOS,
    output wire CLKOS2,
    output wire CLKOS3,
    output wire CLKINTFB,
    output wire REFCLK,
    output wire INTLOCK,
    output wire LOCK
);
    // It takes a while to lock.
    reg [4:0] clocks = 5'd0;
    always @(posedge CLKI) if (!clocks[4]) clocks <= clocks + 5'd1;
    assign CLKOP = CLKI;
    assign LOCK = clocks[4];
    assign {CLKOS, CLKOS2, CLKOS3, CLKINTFB, REFCLK, INTLOCK} = 6'd0;
endmodule
