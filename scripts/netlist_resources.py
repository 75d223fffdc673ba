#!/usr/bin/env python3
"""Counts what a netlist takes, from the files scripts/synthesize.sh had Yosys write.

netlist_resources.py FOLDER TOP TARGET VERILOG...

Writes FOLDER/resources.json and prints it as one line. Ends with exit code 1 when an array did not become RAM.
"""

import json
import pathlib
import re
import sys

# What is counted on each target. "lut4": LUT4 that each cell occupies, as nextpnr counts them before packing: an ECP5 carry
# cell takes both LUTs of its slice; a 16x4 RAM four, and two more for its write port. On iCE40 a carry sits beside the LUT
# of its logic cell.
TARGETS = {
    "ecp5": {
        "lut4": {"LUT4": 1, "CCU2C": 2, "TRELLIS_DPR16X4": 6},
        "flip_flops": ("TRELLIS_FF",),
        "block_rams": ("DP16KD",),
        "multipliers": ("MULT18X18D",),
        "others": ("PFUMX", "L6MUX21"),
        "sentence": "{top}: {lut4} LUT4 (a carry cell counts 2, a 16x4 RAM 6), {flip_flops} flip-flops, "
                    "{block_rams} DP16KD, {multipliers} MULT18X18D",
    },
    "hx8k": {
        "lut4": {"SB_LUT4": 1},
        "flip_flops": tuple("SB_DFF" + kind for kind in (
            "", "E", "SR", "R", "SS", "S", "ESR", "ER", "ESS", "ES", "N", "NE", "NSR", "NR", "NSS", "NS", "NESR", "NER", "NESS",
            "NES")),
        "block_rams": ("SB_RAM40_4K", "SB_RAM40_4KNR", "SB_RAM40_4KNW", "SB_RAM40_4KNRNW"),
        "multipliers": (),
        "others": ("SB_CARRY",),
        "sentence": "{top}: {lut4} LUT4, {flip_flops} flip-flops, {block_rams} SB_RAM40_4K",
    },
}


def memories_in(file):
    """Names of the arrays in Yosys's dump of memory cells, and of those of them that are written (the rest are ROMs)."""
    cells = file.read_text(encoding="utf-8").split("cell $mem_v2")[1:]
    # A memory of an instance has the instance's name before its own.
    names = [re.search(r'parameter \\MEMID "\\\\?([^"]+)"', cell).group(1).split(".")[-1] for cell in cells]
    written = {name for name, cell in zip(names, cells) if not re.search(r"parameter \\WR_PORTS 0\n", cell)}
    return set(names), written


def arrays_for_ram(text):
    """Names of the arrays whose ram_style asks for a RAM, and of those that are to be registers."""
    styles = re.findall(r'ram_style = "(\w+)"[^\n]*\*\)\s*reg[^;\n]*?(\w+) *\[0:', text)
    return ({name for style, name in styles if style in ("block", "distributed")},
            {name for style, name in styles if style == "registers"})


def main():
    if len(sys.argv) < 5 or sys.argv[3] not in TARGETS:
        sys.exit(__doc__.split("\n\n")[1])
    folder, top, target = pathlib.Path(sys.argv[1]), sys.argv[2], TARGETS[sys.argv[3]]
    statistics = json.loads((folder / "statistics.json").read_text(encoding="utf-8"))
    cells = statistics["modules"]["\\" + top]["num_cells_by_type"]
    found, _ = memories_in(folder / "memories.txt")
    left, left_written = memories_in(folder / "lost_memories.txt")
    for_ram, for_registers = arrays_for_ram(
        "\n".join(pathlib.Path(name).read_text(encoding="utf-8") for name in sys.argv[4:]))
    # A small ROM may become logic, unless the Verilog asks for a RAM. An array Yosys never saw as a memory was taken apart
    # while it read the Verilog.
    lost = (left & for_ram) | (left_written - for_registers) | (for_ram - found)
    kinds = [*target["lut4"], *(kind for group in ("flip_flops", "block_rams", "multipliers", "others")
                                for kind in target[group])]
    resources = {
        "top": top,
        "lut4": sum(count * cells.get(cell, 0) for cell, count in target["lut4"].items()),
        **{group: sum(cells.get(cell, 0) for cell in target[group])
           for group in ("flip_flops", "block_rams", "multipliers")},
        "cells": {cell: cells.get(cell, 0) for cell in kinds},
        "memories": sorted(found - left),
        "lost_memories": sorted(lost),
    }
    (folder / "resources.json").write_text(json.dumps(resources, indent=2) + "\n", encoding="utf-8")
    print(target["sentence"].format_map(resources))
    if lost:
        sys.exit(f"netlist_resources.py: error: no RAM was found for the memories {', '.join(sorted(lost))}: "
                 "they became flip-flops")


if __name__ == "__main__":
    main()
