#!/usr/bin/env python3
"""Counts what a netlist takes, from the files scripts/synthesize.sh had Yosys write.

netlist_resources.py FOLDER TOP VERILOG

Writes FOLDER/resources.json and prints it as one line. Ends with exit code 1 when an array did not become RAM.
"""

import json
import pathlib
import re
import sys

# LUT4 each cell occupies, as nextpnr counts them: a carry cell both LUTs of its slice; a 16x4 RAM four, and two more for
# its write port.
LUTS = {"LUT4": 1, "CCU2C": 2, "TRELLIS_DPR16X4": 6}
COUNTED = ("LUT4", "CCU2C", "TRELLIS_FF", "DP16KD", "TRELLIS_DPR16X4", "MULT18X18D", "PFUMX", "L6MUX21")


def memories_in(file):
    """Names of the arrays in Yosys's dump of memory cells, and of those of them that are written (the rest are ROMs)."""
    cells = file.read_text(encoding="utf-8").split("cell $mem_v2")[1:]
    names = [re.search(r'parameter \\MEMID "\\\\?([^"]+)"', cell).group(1) for cell in cells]
    written = {name for name, cell in zip(names, cells) if not re.search(r"parameter \\WR_PORTS 0\n", cell)}
    return set(names), written


def arrays_for_ram(verilog):
    """Names of the arrays whose ram_style asks for a RAM, and of those that are to be registers."""
    styles = re.findall(r'ram_style = "(\w+)"[^\n]*\*\)\s*reg[^;\n]*?(\w+) *\[0:', verilog.read_text(encoding="utf-8"))
    return ({name for style, name in styles if style in ("block", "distributed")},
            {name for style, name in styles if style == "registers"})


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__.split("\n\n")[1])
    folder, top = pathlib.Path(sys.argv[1]), sys.argv[2]
    statistics = json.loads((folder / "statistics.json").read_text(encoding="utf-8"))
    cells = statistics["modules"]["\\" + top]["num_cells_by_type"]
    found, _ = memories_in(folder / "memories.txt")
    left, left_written = memories_in(folder / "lost_memories.txt")
    for_ram, for_registers = arrays_for_ram(pathlib.Path(sys.argv[3]))
    # A small ROM may become logic, unless the Verilog asks for a RAM. An array Yosys never saw as a memory was taken apart
    # while it read the Verilog.
    lost = (left & for_ram) | (left_written - for_registers) | (for_ram - found)
    resources = {
        "top": top,
        "lut4": sum(count * cells.get(cell, 0) for cell, count in LUTS.items()),
        "flip_flops": cells.get("TRELLIS_FF", 0),
        "block_rams": cells.get("DP16KD", 0),
        "multipliers": cells.get("MULT18X18D", 0),
        "cells": {cell: cells.get(cell, 0) for cell in COUNTED},
        "memories": sorted(found - left),
        "lost_memories": sorted(lost),
    }
    (folder / "resources.json").write_text(json.dumps(resources, indent=2) + "\n", encoding="utf-8")
    print(
        f"{top}: {resources['lut4']} LUT4 (a carry cell counts 2, a 16x4 RAM 6), {resources['flip_flops']} flip-flops, "
        f"{resources['block_rams']} DP16KD, {resources['multipliers']} MULT18X18D"
    )
    if lost:
        sys.exit(f"netlist_resources.py: error: no RAM was found for the memories {', '.join(sorted(lost))}: "
                 "they became flip-flops")


if __name__ == "__main__":
    main()
