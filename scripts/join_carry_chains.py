#!/usr/bin/env python3
"""Puts ECP5 carry chains end to end, so that they fill the tiles that they are placed in.

join_carry_chains.py NETLIST.json

A tile of the device has four CCU2C cells, and nextpnr begins every chain in the first of them: a chain of five takes two
tiles, of which nothing but single LUTs can use what is left. A chain that begins in itself (scripts/carry_chains.py) takes no
notice of the carry that comes in, so it can as well follow another one: three chains of five cells take four tiles and not
six. Only the placer sees a difference.

Chains are joined where that saves a tile, if they belong together: if their sums meet in the same chain, RAM or flip-flop.
Chains that meet further on stay apart: joining those as well saves more tiles and makes the wires longer (docs/fpga.md). All
that are joined have as many chains on the longest way to them without a flip-flop, so what looks like a way from one to the
next closes no loop; timing analysis counts it, but it is hardly longer than the ways there are. Changes the file in place
and prints what it did.
"""

import collections
import graphlib
import sys

from carry_chains import OPEN, find_chains, propagates
from netlist_file import change_netlist, find_readers, new_nets

CELLS_IN_A_TILE = 4
# The longest chain to make: longer ones have fewer places where they fit. Of color_fuzzy_p2's tiles three save 797, four 804,
# six and more 966.
LARGEST = 4 * CELLS_IN_A_TILE
# Inputs of cells from which a value goes on in the same clock; all inputs of cells that are not named.
SAME_CLOCK = {"TRELLIS_FF": (), "DP16KD": (), "TRELLIS_DPR16X4": ("RAD",)}
GATES = ("LUT4", "PFUMX", "L6MUX21")
# A net with more readers says nothing of where its driver belongs, nor does a place where more chains meet.
MANY_READERS, MANY_CHAINS = 8, 12


def tiles(cells):
    return -(-cells // CELLS_IN_A_TILE)


def depths(module, chain_of):
    """Per chain, by its index: how many chains there are on the longest way to it without a flip-flop. `chain_of` gives the
    index for each of its cells."""
    drivers, inputs = {}, collections.defaultdict(set)
    for name, cell in module["cells"].items():
        node = chain_of.get(name, name)
        through = SAME_CLOCK.get(cell["type"])
        for port, bits in cell["connections"].items():
            if cell["port_directions"][port] == "output":
                if through != ():
                    drivers.update((bit, node) for bit in bits if isinstance(bit, int))
            elif through is None or port in through:
                inputs[node].update(bits)
    before = {node: {drivers[bit] for bit in bits if bit in drivers} - {node} for node, bits in inputs.items()}
    found = {}
    for node in graphlib.TopologicalSorter(before).static_order():
        found[node] = max((found[other] + isinstance(other, int) for other in before.get(node, ())), default=0)
    return found


def meeting_places(module, chains, chain_of, readers):
    """Per chain: how many bits of its sums go to each chain (by its index) and each RAM or flip-flop (by its name), through
    gates and not more than one flip-flop."""

    def follow(bit, registered, places, seen):
        if len(readers[bit]) > MANY_READERS:
            return
        for name, port in readers[bit]:
            if name is None or (name, registered) in seen:
                continue
            cell = module["cells"][name]
            if name in chain_of:
                places[chain_of[name]] += 1
            elif cell["type"] in GATES or (cell["type"] == "TRELLIS_FF" and port in ("DI", "M") and not registered):
                seen.add((name, registered))
                for after in cell["connections"]["Q" if cell["type"] == "TRELLIS_FF" else "Z"]:
                    follow(after, registered or cell["type"] == "TRELLIS_FF", places, seen)
            else:
                places[name] += 1

    found = []
    for chain in chains:
        places = collections.Counter()
        for name in chain:
            for port in ("S0", "S1"):
                follow(module["cells"][name]["connections"][port][0], False, places, set())
        found.append(places)
    return found


def nearness(places):
    """Per pair of chains: how many of their bits meet."""
    meeting = collections.defaultdict(list)
    for chain, of_chain in enumerate(places):
        for place in of_chain:
            meeting[place].append(chain)
    near = collections.Counter()
    for place, there in meeting.items():
        if len(there) > MANY_CHAINS:
            continue
        for index, one in enumerate(there):
            if isinstance(place, int) and one != place:
                near[min(one, place), max(one, place)] += places[one][place]
            for other in there[:index]:
                near[other, one] += min(places[one][place], places[other][place])
    return near


def group(sizes, near):
    """Groups of chains to join, as lists of their indices: from the nearest on, while a tile is saved and none gets too
    large. `sizes` is how many cells a chain has, `near` is of pairs that may be joined."""
    groups, group_of = {index: [index] for index in range(len(sizes))}, list(range(len(sizes)))
    cells = dict(enumerate(sizes))
    while True:
        between = collections.Counter()
        for (one, other), bits in near.items():
            one, other = sorted((group_of[one], group_of[other]))
            both = cells[one] + cells[other]
            if one != other and both <= LARGEST and tiles(both) < tiles(cells[one]) + tiles(cells[other]):
                between[one, other] += bits
        if not between:
            return list(groups.values())
        taken = set()
        for one, other in sorted(between, key=lambda pair: (-between[pair], pair)):
            if one in taken or other in taken:
                continue
            taken |= {one, other}
            for index in groups[other]:
                group_of[index] = one
            groups[one] += groups.pop(other)
            cells[one] += cells.pop(other)


def join(module):
    """Returns how many tiles are saved."""
    readers = find_readers(module)

    def stands_alone(chain):
        first, last = module["cells"][chain[0]], module["cells"][chain[-1]]
        bit = {"INIT": first["parameters"]["INIT0"], **{p: first["connections"][p + "0"] for p in "CD"}}
        carry = last["connections"]["COUT"]
        return first["connections"]["CIN"] == OPEN and propagates(bit) == "0000" and (carry == OPEN or not readers[carry[0]])

    chains = find_chains(module)
    alone = [stands_alone(chain) for chain in chains]
    chain_of = {name: index for index, chain in enumerate(chains) for name in chain}
    depth = depths(module, chain_of)
    near = nearness(meeting_places(module, chains, chain_of, readers))
    near = {(one, other): bits for (one, other), bits in near.items()
            if alone[one] and alone[other] and depth[one] == depth[other]}
    sizes, nets = [len(chain) for chain in chains], new_nets(module)
    saved = 0
    for together in group(sizes, near):
        for one, other in zip(together, together[1:]):
            carry = [next(nets)]
            module["cells"][chains[one][-1]]["connections"]["COUT"] = carry
            module["cells"][chains[other][0]]["connections"]["CIN"] = carry
        saved += sum(tiles(sizes[index]) for index in together) - tiles(sum(sizes[index] for index in together))
    return saved


def main():
    if len(sys.argv) != 2 or sys.argv[1].startswith("-"):
        sys.exit(__doc__.split("\n\n")[1])
    print(f"{change_netlist(sys.argv[1], join)} tiles saved by carry chains that follow each other")


if __name__ == "__main__":
    main()
