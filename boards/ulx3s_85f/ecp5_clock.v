// The design's clock and its reset. boards/make_build.py computes the dividers from board.json.
module ecp5_clock #(
    parameter INPUT_DIVIDER = 1,
    parameter FEEDBACK_DIVIDER = 4,
    parameter OUTPUT_DIVIDER = 6  // of the oscillator, 400 to 800 MHz
) (
    input  wire clk_in,
    input  wire reset_button,
    output wire clk,
    output wire rst
);
    wire locked;

    // ICP_CURRENT and LPF_RESISTOR: the loop filter as ecppll sets it for all frequencies.
    (* ICP_CURRENT = "12" *) (* LPF_RESISTOR = "8" *) (* MFG_ENABLE_FILTEROPAMP = "1" *) (* MFG_GMCREF_SEL = "2" *)
    EHXPLLL #(
        .PLLRST_ENA("DISABLED"),
        .INTFB_WAKE("DISABLED"),
        .STDBY_ENABLE("DISABLED"),
        .DPHASE_SOURCE("DISABLED"),
        .OUTDIVIDER_MUXA("DIVA"),
        .OUTDIVIDER_MUXB("DIVB"),
        .OUTDIVIDER_MUXC("DIVC"),
        .OUTDIVIDER_MUXD("DIVD"),
        .CLKI_DIV(INPUT_DIVIDER),
        .CLKOP_ENABLE("ENABLED"),
        .CLKOP_DIV(OUTPUT_DIVIDER),
        .CLKOP_CPHASE(OUTPUT_DIVIDER / 2 - 1),
        .CLKOP_FPHASE(0),
        .FEEDBK_PATH("CLKOP"),
        .CLKFB_DIV(FEEDBACK_DIVIDER)
    ) pll (
        .RST(1'b0),
        .STDBY(1'b0),
        .CLKI(clk_in),
        .CLKOP(clk),
        .CLKFB(clk),
        .PHASESEL0(1'b0),
        .PHASESEL1(1'b0),
        .PHASEDIR(1'b1),
        .PHASESTEP(1'b1),
        .PHASELOADREG(1'b1),
        .PLLWAKESYNC(1'b0),
        .ENCLKOP(1'b0),
        .ENCLKOS(1'b0),
        .ENCLKOS2(1'b0),
        .ENCLKOS3(1'b0),
        /* verilator lint_off PINCONNECTEMPTY */
        .CLKOS(),
        .CLKOS2(),
        .CLKOS3(),
        .INTLOCK(),
        .REFCLK(),
        .CLKINTFB(),
        /* verilator lint_on PINCONNECTEMPTY */
        .LOCK(locked)
    );

    // Begins at once, without a clock; ends 4 clocks after the PLL has locked and the button is up.
    wire      wanted = !locked || reset_button;
    reg [3:0] reset_registers = 4'b1111;
    always @(posedge clk or posedge wanted) begin
        if (wanted) reset_registers <= 4'b1111;
        else reset_registers <= {reset_registers[2:0], 1'b0};
    end
    assign rst = reset_registers[3];
endmodule
