"""Netlists that Yosys wrote as JSON, changed in place; shared by the scripts that do so after synthesis."""

import collections
import itertools
import json
import pathlib
import sys

from whole_file import write_whole


def find_readers(module):
    """Per net: the cells' inputs that it drives, as (cell, port), and (None, None) for a port of the module."""
    readers = collections.defaultdict(list)
    for name, cell in module["cells"].items():
        for port, bits in cell["connections"].items():
            if cell["port_directions"][port] == "output":
                continue
            for bit in bits:
                readers[bit].append((name, port))
    for port in module["ports"].values():
        if port["direction"] != "input":
            for bit in port["bits"]:
                readers[bit].append((None, None))
    return readers


def new_nets(module):
    """Numbers of nets that a module does not have yet, one after another."""
    used = [bit for cell in module["cells"].values() for bits in cell["connections"].values() for bit in bits]
    used += [bit for port in module["ports"].values() for bit in port["bits"]]
    return itertools.count(1 + max((bit for bit in used if isinstance(bit, int)), default=1))


def change_netlist(name, change):
    """Calls `change` with every module of the file `name` and returns the sum of what it returns. What is no netlist ends
    the program with one line, and the file stays as it is."""
    file = pathlib.Path(name)
    try:
        netlist = json.loads(file.read_text(encoding="utf-8"))
        changed = sum(change(module) for module in netlist["modules"].values())
    except (OSError, ValueError, KeyError, AttributeError, IndexError, TypeError) as error:
        program = pathlib.Path(sys.argv[0]).name
        sys.exit(f"{program}: error: {file} is not a netlist that Yosys wrote ({error!r})")
    write_whole(file, json.dumps(netlist, indent=1))
    return changed
