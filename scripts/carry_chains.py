#!/usr/bin/env python3
"""Makes ECP5 carry chains as short as they can be, which Yosys and nextpnr leave undone.

carry_chains.py NETLIST.json               lets chains begin and end in themselves
carry_chains.py --open-ends NETLIST.json   leaves the ends of chains open

A CCU2C cell has two bits of a chain. nextpnr puts a cell before every chain that begins with a carry, constant or not, and
another after every chain whose last carry is connected, whether or not anything reads it. So

- a carry that is read is the sum of one bit more, which adds it to nothing;
- the first bit of a sum with a constant carry makes its carry from its operands alone, and a LUT its sum, if anything reads it;
- where the last bit is unused, or the carry is none that is known, all bits move up by one and the first makes the carry.

Where a carry in between is read a chain stays as it is. An end that nothing reads is left open. That comes last, since the
Verilog of a netlist cannot say so. Changes the file in place and prints what it did.
"""

import sys

from netlist_file import change_netlist, find_readers, new_nets

OPEN = ["x"]
# A bit that hands its input A on as carry, whatever carry comes in: nothing propagates (C and D are set), A generates.
CARRY_OF_A = {"INIT": format(0x000A, "016b"), "INJECT": "NO", "B": ["0"], "C": ["1"], "D": ["1"]}
# A bit that adds the carry to nothing, and hands none on.
CARRY_AS_SUM = {"INIT": "0" * 16, "INJECT": "NO", "A": ["0"], "B": ["0"], "C": ["0"], "D": ["0"]}


def find_chains(module):
    """The chains of CCU2C cells, each as the names of its cells from the first to the last."""
    nets = {name: cell["connections"] for name, cell in module["cells"].items() if cell["type"] == "CCU2C"}
    after = {of["CIN"][0]: name for name, of in nets.items()}
    made = {of["COUT"][0] for of in nets.values()} - set(OPEN)
    chains = []
    for name, of in nets.items():
        if of["CIN"][0] in made:
            continue
        chain = [name]
        while (carry := nets[chain[-1]]["COUT"][0]) in after and carry in made:
            chain.append(after[carry])
        chains.append(chain)
    return chains


def bits_of(cells):
    """What each bit of a chain has: its function and its nets."""
    for cell in cells:
        for half in "01":
            bit = {port: cell["connections"][port + half] for port in "ABCDS"}
            yield {"INIT": cell["parameters"]["INIT" + half], "INJECT": cell["parameters"]["INJECT1_" + half], **bit}


def propagates(bit):
    """The table of when a bit hands its carry on, by its operands B and A; None if it hangs on more than these."""
    c, d = bit["C"][0], bit["D"][0]
    if c not in ("0", "1") or d not in ("0", "1"):
        return None
    return bit["INIT"][::-1][8 * int(d) + 4 * int(c):][:4]


def generates(bit):
    """The table of a bit's carry where it does not hand one on."""
    return bit["INIT"][::-1][:4]


def only_propagates(bit):
    """Whether a bit hands on whatever carry comes in."""
    table = propagates(bit) or "0000"
    possible = [2 * b + a for b in (0, 1) for a in (0, 1) if bit["A"][0] != str(1 - a) and bit["B"][0] != str(1 - b)]
    return all(table[place] == "1" for place in possible)


def end_in_a_sum(bits, carry_out, readers):
    """The bits of a chain without unused ones at its end, with one more that gives the carry `carry_out` if that is read."""
    carry_is_read = carry_out != OPEN and bool(readers[carry_out[0]])
    while len(bits) > 1 and not readers[bits[-1]["S"][0]] and (not carry_is_read or only_propagates(bits[-1])):
        bits.pop()
    if carry_is_read:
        bits.append({**CARRY_AS_SUM, "S": carry_out})
    return bits


def begin_in_a_bit(bits, carry, readers, nets):
    """The bits of a chain that begins with `carry`, so that nothing has to come in, and the LUT that makes the first sum, or
    None."""
    first, table = bits[0], propagates(bits[0])
    read = bool(readers[first["S"][0]])
    constant = carry[0] in ("0", "1") and table is not None and first["INJECT"] == "NO"
    if not constant or (read and len(bits) % 2 == 1):
        return [{**CARRY_OF_A, "A": carry, "S": [next(nets)]}, *bits], None
    made = "".join(carry[0] if p == "1" else g for p, g in zip(table, generates(first)))
    head = {**first, "INIT": "0" * 12 + made[::-1], "C": ["1"], "D": ["1"], "S": [next(nets)]}
    if not read:
        return [head, *bits[1:]], None
    total = "".join(str(int(p) ^ int(carry[0])) for p in table)
    pins = {"A": first["A"], "B": first["B"], "C": ["0"], "D": ["0"], "Z": first["S"]}
    lut = {
        "hide_name": 1,
        "type": "LUT4",
        "parameters": {"INIT": total[::-1] * 4},
        "attributes": {},
        "port_directions": {pin: "output" if pin == "Z" else "input" for pin in pins},
        "connections": pins,
    }
    return [head, *bits[1:]], lut


def write_bits(module, chain, bits, nets):
    """Makes `bits` the bits of the chain, with as many cells as they take; nothing comes into its first."""
    if len(bits) % 2 == 1:
        bits = [*bits, {**CARRY_AS_SUM, "S": [next(nets)]}]
    count, pattern, carry = len(bits) // 2, module["cells"][chain[0]], OPEN
    for name in chain[count:]:
        del module["cells"][name]
    more = [f"{chain[-1]}$more{index}" for index in range(len(chain), count)]
    for name, low, high in zip([*chain[:count], *more], bits[::2], bits[1::2]):
        pins = {"CIN": carry, "COUT": [next(nets)]}
        for half, bit in (("0", low), ("1", high)):
            pins.update({port + half: bit[port] for port in "ABCDS"})
        module["cells"].setdefault(name, dict(pattern)).update(
            parameters={"INIT0": low["INIT"], "INIT1": high["INIT"], "INJECT1_0": low["INJECT"], "INJECT1_1": high["INJECT"]},
            connections=pins,
        )
        carry = pins["COUT"]


def begin_and_end_in_themselves(module):
    """Returns how many chains were changed."""
    readers, nets = find_readers(module), new_nets(module)
    changed = 0
    for chain in find_chains(module):
        cells = [module["cells"][name] for name in chain]
        carry, carry_out = cells[0]["connections"]["CIN"], cells[-1]["connections"]["COUT"]
        if carry == OPEN or any(len(readers[cell["connections"]["COUT"][0]]) > 1 for cell in cells[:-1]):
            continue
        bits, lut = begin_in_a_bit(end_in_a_sum(list(bits_of(cells)), carry_out, readers), carry, readers, nets)
        write_bits(module, chain, bits, nets)
        if lut:
            module["cells"][chain[0] + "$first"] = lut
        changed += 1
    return changed


def open_ends(module):
    """Returns how many ends were left open."""
    readers = find_readers(module)
    opened = 0
    for chain in find_chains(module):
        end = module["cells"][chain[-1]]["connections"]
        if end["COUT"] != OPEN and not readers[end["COUT"][0]]:
            end["COUT"] = OPEN
            opened += 1
    return opened


def main():
    steps = {
        (): (begin_and_end_in_themselves, "carry chains begin and end in themselves"),
        ("--open-ends",): (open_ends, "ends left open"),
    }
    arguments = sys.argv[1:]
    step = steps.get(tuple(arguments[:-1]))
    if not arguments or step is None or arguments[-1].startswith("-"):
        sys.exit(__doc__.split("\n\n")[1])
    change, text = step
    print(f"{change_netlist(arguments[-1], change)} {text}")


if __name__ == "__main__":
    main()
