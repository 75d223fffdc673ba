#!/usr/bin/env python3
"""Joins a board and a generated design: writes the Verilog module epiline_board_build.

make_build.py --board boards/NAME/board.json --report REPORT.json -o FILE.v

REPORT.json is epiline-hls's report of the design, whose streams must be `left`, `right` and `disparity` and whose
arguments are ports. The PLL's dividers and the text by which the board names itself follow from the two files and from
boards/cores.json, which says what the design's sizes are.
"""

import argparse
import json
import os
import pathlib
import sys

MODULE = """// Written by make_build.py for {board} and {core}.
module epiline_board_build #(
    parameter RATE_HOLD_BITS = 26
) (
    input  wire       clk_in,
    input  wire       reset_button,
    input  wire       line_in,
    output wire       line_out,
    output wire [7:0] lamps
);
    wire clk, rst, core_rst, call_tvalid, call_tready;
    wire left_tvalid, left_tready, right_tvalid, right_tready, disparity_tvalid, disparity_tready;
    wire [{video_high}:0] left_tdata, right_tdata;
    wire [{disparity_high}:0] disparity_tdata;
    /* verilator lint_off UNUSED */
    wire [255:0] call_arguments;  // the upper bits of each 16, and those of arguments that the design does not have
    /* verilator lint_on UNUSED */

    // {clock_in} MHz to {core_clock} MHz
    ecp5_clock #(
        .INPUT_DIVIDER({input_divider}),
        .FEEDBACK_DIVIDER({feedback_divider}),
        .OUTPUT_DIVIDER({output_divider})
    ) clock (
        .clk_in(clk_in), .reset_button(reset_button), .clk(clk), .rst(rst));

    board_logic #(
        .LANES({lanes}),
        .IDENTITY_BYTES({identity_bytes}),
        .IDENTITY("{identity}"),
        .RATE_HOLD_BITS(RATE_HOLD_BITS),
        .INITIAL_PERIOD({initial_period})  // {baud} baud
    ) logic_of_board (
        .clk(clk), .rst(rst), .line_in(line_in), .line_out(line_out), .lamps(lamps),
        .core_rst(core_rst), .call_tvalid(call_tvalid), .call_tready(call_tready), .call_arguments(call_arguments),
        .left_tdata(left_tdata), .left_tvalid(left_tvalid), .left_tready(left_tready),
        .right_tdata(right_tdata), .right_tvalid(right_tvalid), .right_tready(right_tready),
        .disparity_tdata(disparity_tdata), .disparity_tvalid(disparity_tvalid), .disparity_tready(disparity_tready));

    /* verilator lint_off PINCONNECTEMPTY */
    {core} core (
        .clk(clk),
        .rst(core_rst),
{connections});
    /* verilator lint_on PINCONNECTEMPTY */
endmodule
"""

SEED_LANES = 2  # pixel_generator's most
ARGUMENTS = 16  # of the call, as the board's orders have room for


class build_error(Exception):
    """What is wrong with the inputs, in one line."""


def read_json(path):
    try:
        with open(path, encoding="utf-8") as file:
            return json.load(file)
    except (OSError, ValueError) as error:
        raise build_error(f"cannot read '{path}': {error}") from error


def pll_dividers(clock_in_mhz, clock_mhz):
    """(input, feedback, output) dividers of ECP5's PLL: the fed-back output is clock_in / input * feedback, the oscillator
    is that times output. Limits as in Lattice's data sheet (FPGA-DS-02012)."""
    choices = []
    for input_divider in range(1, 129):
        if not 3.125 <= clock_in_mhz / input_divider <= 400:
            continue
        feedback_divider = round(clock_mhz * input_divider / clock_in_mhz)
        if not 1 <= feedback_divider <= 128:
            continue
        if abs(clock_in_mhz / input_divider * feedback_divider - clock_mhz) > 1e-6 * clock_mhz:
            continue
        # The middle of the oscillator's range is the safest.
        for output_divider in range(1, 129):
            if 400 <= clock_mhz * output_divider <= 800:
                choices.append((input_divider, abs(clock_mhz * output_divider - 600), feedback_divider, output_divider))
    if not choices:
        raise build_error(
            f"the PLL cannot make {clock_mhz} MHz of {clock_in_mhz} MHz: choose a core_clock_mhz that is "
            f"{clock_in_mhz} MHz times a fraction of small numbers, 10 to 400"
        )
    input_divider, _, feedback_divider, output_divider = min(choices)
    return input_divider, feedback_divider, output_divider


def connections_of(interface, core):
    """(instance lines, lanes, [(argument, bits)]) of the design's ports."""
    if "registers" in interface:
        raise build_error(f"'{core}' has its arguments in registers: compile it without --axi-lite")
    lines, arguments, widths = [], [], {}
    roles = {("stream", "left"): "input", ("stream", "right"): "input", ("stream", "disparity"): "output"}
    for port in interface["ports"]:
        name = port["name"]
        if port["kind"] == "call":
            lines += [f".{port['valid']}(call_tvalid)", f".{port['ready']}(call_tready)"]
            for field in port["fields"]:
                if field["width"] > 16:
                    raise build_error(f"argument '{field['name']}' of '{core}' has {field['width']} bits, the board 16")
                low = 16 * len(arguments)
                lines.append(f".{field['rtl']}(call_arguments[{low + field['width'] - 1}:{low}])")
                arguments.append((field["name"], field["width"]))
        elif roles.get((port["kind"], name)) == port["direction"]:
            lines += [f".{port['valid']}({name}_tvalid)", f".{port['ready']}({name}_tready)"]
            for field in port["fields"]:
                signal = field["signal"]
                if signal == "tdata":
                    widths[name] = field["width"]
                    lines.append(f".{field['rtl']}({name}_tdata)")
                elif port["direction"] == "input":
                    # Not looked at: width and height say where rows and frames end.
                    lines.append(f".{field['rtl']}({{{field['width']}{{1'b0}}}})")
                else:
                    lines.append(f".{field['rtl']}()")
        else:
            raise build_error(f"port '{name}' of '{core}' has no part in stereo matching")
    lanes = widths.get("left", 0) // 24
    if set(widths) != {"left", "right", "disparity"} or not arguments:
        raise build_error(f"'{core}' is no stereo design: it needs streams left, right and disparity, and arguments")
    if widths != {"left": 24 * lanes, "right": 24 * lanes, "disparity": 8 * lanes} or not 1 <= lanes <= SEED_LANES:
        raise build_error(f"'{core}' has streams of {widths} bits; the board takes 24 and 8 a pixel, 1 or 2 pixels a beat")
    if len(arguments) > ARGUMENTS:
        raise build_error(f"'{core}' has {len(arguments)} arguments, the board has room for {ARGUMENTS}")
    return lines, lanes, arguments


def make(board, report, cores):
    interface = report["interface"]
    core = interface["module"]
    if core not in cores:
        raise build_error(f"'{core}' is not in boards/cores.json, which says the largest sizes: add it ({', '.join(cores)})")
    lines, lanes, arguments = connections_of(interface, core)
    limits = cores[core]
    for name, limit in (("width", "max_width"), ("height", "max_height"), ("levels", "max_levels")):
        if limits[limit] >= 2 ** dict(arguments).get(name, 0):
            raise build_error(f"{limit} of '{core}' in boards/cores.json is {limits[limit]}, but its argument is smaller")
    clock_in, core_clock, baud = board["clock_in_mhz"], board["core_clock_mhz"], board["serial_baud"]
    dividers = pll_dividers(clock_in, core_clock)
    identity = ";".join(
        [
            "epiline 1",
            f"board={board['name']}",
            f"core={core}",
            f"design={limits['design']}",
            f"lanes={lanes}",
            f"size={limits['max_width']}x{limits['max_height']}x{limits['max_levels']}",
            f"clock={round(core_clock * 1e6)}",
            "call=" + ",".join(name for name, _ in arguments),
        ]
    )
    if len(identity) > 511 or not identity.isascii() or '"' in identity:
        raise build_error(f"the board cannot name itself '{identity}': at most 511 plain letters")
    return MODULE.format(
        board=board["name"],
        core=core,
        video_high=24 * lanes - 1,
        disparity_high=8 * lanes - 1,
        clock_in=clock_in,
        core_clock=core_clock,
        input_divider=dividers[0],
        feedback_divider=dividers[1],
        output_divider=dividers[2],
        lanes=lanes,
        identity_bytes=len(identity),
        identity=identity,
        initial_period=round(16 * core_clock * 1e6 / baud),
        baud=baud,
        connections=",\n".join("        " + line for line in lines),
    )


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--board", required=True)
    parser.add_argument("--report", required=True)
    parser.add_argument("-o", "--output", required=True)
    options = parser.parse_args()
    try:
        cores = read_json(pathlib.Path(__file__).parent / "cores.json")
        try:
            text = make(read_json(options.board), read_json(options.report), cores)
        except KeyError as error:
            raise build_error(f"{options.board} or {options.report} has no key {error}") from error
        output = pathlib.Path(options.output)
        fresh = output.with_name(output.name + ".fresh")
        try:
            fresh.write_text(text, encoding="ascii")
            os.replace(fresh, output)
        except OSError as error:
            raise build_error(f"cannot write '{output}': {error}") from error
    except build_error as error:
        sys.exit(f"make_build.py: error: {error}")


if __name__ == "__main__":
    main()
