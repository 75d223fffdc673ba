#!/usr/bin/env python3
"""Makes ECP5 carry chains as short as they can be, which Yosys and nextpnr leave undone.

carry_chains.py NETLIST.json               lets chains begin in themselves
carry_chains.py --open-ends NETLIST.json   leaves the ends of chains open

A CCU2C cell has two bits of a chain. nextpnr puts a cell before every chain that begins with a carry, constant or not, and
another after every chain whose last carry is connected, whether or not anything reads it. Where the last bit of a chain is
unused and no carry in between is read, all bits move up by one and the first makes the carry: no cell stands before it. An end that nothing reads is
left open: no cell stands after it. That comes last, since the Verilog of a netlist cannot say so.
Changes the file in place and prints what it did.
"""

import sys

from netlist_file import change_netlist, find_readers

OPEN = ["x"]
# A bit that hands its input A on as carry, whatever carry comes in: nothing propagates (C and D are set), A generates.
CARRY_OF_A = {"INIT": format(0x000A, "016b"), "INJECT": "NO", "B": ["0"], "C": ["1"], "D": ["1"]}


def find_chains(module):
    """The chains of CCU2C cells, each from its first cell to its last."""
    cells = [cell for cell in module["cells"].values() if cell["type"] == "CCU2C"]
    after = {cell["connections"]["CIN"][0]: cell for cell in cells}
    made = {cell["connections"]["COUT"][0] for cell in cells} - set(OPEN)
    chains = []
    for cell in cells:
        if cell["connections"]["CIN"][0] in made:
            continue
        chain = [cell]
        while (carry := chain[-1]["connections"]["COUT"][0]) in after and carry in made:
            chain.append(after[carry])
        chains.append(chain)
    return chains


def bits_of(chain):
    """What each bit of a chain has: its function and its nets."""
    for cell in chain:
        for half in "01":
            bit = {port: cell["connections"][port + half] for port in "ABCDS"}
            yield {"INIT": cell["parameters"]["INIT" + half], "INJECT": cell["parameters"]["INJECT1_" + half], **bit}


def set_bits(chain, bits):
    for index, bit in enumerate(bits):
        cell, half = chain[index // 2], "01"[index % 2]
        cell["parameters"]["INIT" + half] = bit["INIT"]
        cell["parameters"]["INJECT1_" + half] = bit["INJECT"]
        for port in "ABCDS":
            cell["connections"][port + half] = bit[port]


def begin_in_themselves(module):
    """Returns how many chains now do."""
    readers = find_readers(module)
    changed = 0
    for chain in find_chains(module):
        carry, end = chain[0]["connections"]["CIN"], chain[-1]["connections"]
        between = [cell["connections"]["COUT"][0] for cell in chain[:-1]]
        if carry == OPEN or readers[end["COUT"][0]] or readers[end["S1"][0]] or any(len(readers[net]) > 1 for net in between):
            continue
        bits = list(bits_of(chain))
        unused = bits.pop()["S"]  # becomes the first bit's sum
        set_bits(chain, [{**CARRY_OF_A, "A": carry, "S": unused}, *bits])
        chain[0]["connections"]["CIN"] = OPEN
        changed += 1
    return changed


def open_ends(module):
    """Returns how many ends were left open."""
    readers = find_readers(module)
    opened = 0
    for chain in find_chains(module):
        end = chain[-1]["connections"]
        if end["COUT"] != OPEN and not readers[end["COUT"][0]]:
            end["COUT"] = OPEN
            opened += 1
    return opened


def main():
    steps = {(): (begin_in_themselves, "carry chains begin in themselves"), ("--open-ends",): (open_ends, "ends left open")}
    arguments = sys.argv[1:]
    step = steps.get(tuple(arguments[:-1]))
    if not arguments or step is None or arguments[-1].startswith("-"):
        sys.exit(__doc__.split("\n\n")[1])
    change, text = step
    print(f"{change_netlist(arguments[-1], change)} {text}")


if __name__ == "__main__":
    main()
