#!/usr/bin/env python3
"""Moves the registers after ECP5 block RAMs into the RAMs, which Yosys does not do.

ram_output_registers.py NETLIST.json

A DP16KD without its output register takes 4 ns from the clock to its output, most of a clock of 150 MHz; with it, a
flip-flop's time. A register is moved when every used output bit of a port leads to one flip-flop and nowhere else, and
that flip-flop has the RAM's clock and neither enable nor reset. Changes the file in place and prints what it did.
"""

import sys

from netlist_file import change_netlist, find_readers


def is_plain_flip_flop(cell, clock):
    """A flip-flop that takes its input at every edge of `clock` and starts with 0, as a RAM's output register does."""
    parameters, connections = cell["parameters"], cell["connections"]
    enable = parameters.get("CEMUX", "1").strip()
    return (cell["type"] == "TRELLIS_FF"
            and (enable == "1" or (enable == "CE" and connections.get("CE") == ["1"]))
            and connections.get("LSR", ["0"]) in ([], ["0"], ["x"])
            and parameters.get("LSRMUX", "LSR") == "LSR"
            and parameters.get("REGSET", "RESET") == "RESET"
            and parameters.get("CLKMUX", "CLK") == "CLK"
            and connections["CLK"] == clock)


def move_registers(module):
    """Returns how many flip-flops went into RAMs."""
    cells = module["cells"]
    readers = find_readers(module)
    moved = 0
    for ram in [cell for cell in cells.values() if cell["type"] == "DP16KD"]:
        pins = ram["connections"]
        for side in "AB":
            outputs = [pin for pin in pins if pin.startswith("DO" + side) and pins[pin] and readers[pins[pin][0]]]
            # A 36-bit word leaves by both sides, clocked by side B.
            wide = int(ram["parameters"].get("DATA_WIDTH_B", "0"), 2) == 36
            clock = pins["CLKB" if wide else "CLK" + side]
            if not outputs or ram["parameters"].get("REGMODE_" + side, "NOREG") != "NOREG":
                continue
            found = [readers[pins[pin][0]] for pin in outputs]
            if not all(len(one) == 1 and one[0][1] == "DI" and is_plain_flip_flop(cells[one[0][0]], clock)
                       for one in found):
                continue
            for pin, one in zip(outputs, found):
                flip_flop = cells.pop(one[0][0])
                pins[pin] = flip_flop["connections"]["Q"]
            ram["parameters"]["REGMODE_" + side] = "OUTREG"
            for enable in ("OCE" + side, "OCEB"):
                pins[enable] = ["1"]
                ram["port_directions"][enable] = "input"
            moved += len(outputs)
    return moved


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__.split("\n\n")[1])
    print(f"{change_netlist(sys.argv[1], move_registers)} flip-flops moved into block RAMs")


if __name__ == "__main__":
    main()
