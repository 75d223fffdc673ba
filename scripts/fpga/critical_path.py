"""nextpnr's critical path in lines of the C++ source.

The generated Verilog has the C++ line behind each name, `wire less_7 = ..;  // uniqueness.hpp:72`. A cell on the path
leads to a line of the Verilog by the attribute `src` that Yosys left on it or on its net; where a cell was made of
nothing but logic, by the name of the register it belongs to, with which its own name begins.
"""

import json
import pathlib
import re

# Where a name that Yosys made of a name of the Verilog leaves it.
end_of_name = re.compile(
    r"_(?:TRELLIS_FF|LUT4|CCU2C|PFUMX|L6MUX21|DP16KD|TRELLIS_DPR16X4|MULT18X18D|TRELLIS_IO|"
    r"SB_DFF\w*?|SB_LUT4|SB_CARRY|SB_RAM40_4K\w*?)_|[$\[]"
)
carry_cell = re.compile(r"CCU2C|CCU2_COMB|SB_CARRY|\$nextpnr_ICESTORM_LC")


class source_lines:
    """C++ lines of Verilog lines and of Verilog names."""

    def __init__(self, verilog_files):
        self.of_line, self.of_name = {}, {}
        for file in verilog_files:
            for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), 1):
                comment = re.search(r"//\s*([\w.-]+\.\w+:\d+)\s*$", line)
                declared = re.match(
                    r"\s*(?:\(\*.*?\*\)\s*)?(?:input|output|wire|reg)\b\s*(?:wire|reg|signed)?\s*"
                    r"(?:\[[^\]]*\])?\s*(\w+)",
                    line,
                )
                where = comment.group(1) if comment else None
                name = declared.group(1) if declared else None
                if where or name:
                    self.of_line[(file.name, number)] = (name, where)
                if name and (where or name not in self.of_name):
                    self.of_name[name] = where

    def of_attribute(self, attribute):
        """(name, line) of an attribute src, or None: `file.v:12.3-12.9|other.v:..`."""
        for part in attribute.split("|"):
            match = re.match(r"(.*):(\d+)\.\d+(?:-\d+\.\d+)?$", part)
            found = self.of_line.get((pathlib.Path(match.group(1)).name, int(match.group(2)))) if match else None
            if found:
                name, where = found
                return name, where or self.where(name)
        return None

    def of_cell(self, cell):
        """(name, line) by the name that a cell's or net's name begins with."""
        stem = end_of_name.split(cell, maxsplit=1)[0]
        for part in stem.split("."):  # instances before it, an array's indices behind it
            part = re.sub(r"(_copy\d+)_register$", r"\1", part)  # the instance that makes a copy
            if part in self.of_name:
                return part, self.where(part)
        return (stem or cell), None

    def where(self, name):
        """The line of a name; what waits for a later stage, `name_s7`, is declared without, as are copies."""
        original = re.sub(r"_copy\d+$", "", name)
        return self.of_name.get(original) or self.of_name.get(re.sub(r"_s\d+$", "", original))


class cell_attributes:
    """Attributes src of the cells of Yosys's netlist."""

    def __init__(self, netlist):
        modules = json.loads(netlist.read_text(encoding="utf-8"))["modules"]
        self.of = {
            name: cell["attributes"]["src"]
            for module in modules.values()
            for name, cell in module["cells"].items()
            if "src" in cell.get("attributes", {})
        }

    def __getitem__(self, cell):
        return self.of.get(cell) or self.of.get(cell.split("$")[0], "")


def clock_to_clock_paths(report):
    """The paths between two edges of one clock, longest first."""
    inside = [path for path in report["critical_paths"] if path["from"] == path["to"] and "async" not in path["from"]]
    return sorted(inside, key=lambda path: -sum(part["delay"] for part in path["path"]))


def kind_of(part, cell):
    if part in ("clk-to-q", "setup"):
        return "register or RAM" if part == "clk-to-q" else "into register or RAM"
    return "carry chain" if carry_cell.search(cell) else "multiplier" if "MULT18X18D" in cell else "logic"


def in_source_lines(path, lines, attributes):
    """{"period_ns", "logic_ns", "routing_ns", "hops": [..]}; a hop is what the path goes through for one line of the
    source: the wire to it and the logic in it."""
    hops, wire = [], 0.0
    parts = path["path"]
    for index, part in enumerate(parts):
        if part["type"] == "routing":
            wire += part["delay"]
            continue
        cell = part["to"]["cell"]
        next_net = next((later for later in parts[index + 1 :] if later["type"] == "routing"), None)
        found = lines.of_attribute(attributes[cell])
        if found is None and next_net and next_net["from"]["cell"] == cell:
            found = next(filter(None, (lines.of_attribute(source) for source in next_net.get("sources", []))), None)
        last = hops[-1] if hops else None
        if found is None and cell.startswith("$nextpnr") and last:  # leads out of a carry chain
            found = last["name"], last["source"]
        name, where = found or lines.of_cell(cell)
        kind = kind_of(part["type"], cell)
        if last and last["name"] == name and last["kind"] == kind and last["source"] == where:
            last["routing_ns"] += wire
            last["logic_ns"] += part["delay"]
            last["cells"] += 1
        else:
            hops.append(
                {"source": where, "name": name, "kind": kind, "cells": 1, "routing_ns": wire, "logic_ns": part["delay"]}
            )
        wire = 0.0
    for hop in hops:
        hop["routing_ns"], hop["logic_ns"] = round(hop["routing_ns"], 3), round(hop["logic_ns"], 3)
    logic = sum(part["delay"] for part in parts if part["type"] != "routing")
    routing = sum(part["delay"] for part in parts if part["type"] == "routing")
    return {
        "period_ns": round(logic + routing, 3),
        "logic_ns": round(logic, 3),
        "routing_ns": round(routing, 3),
        "hops": hops,
    }


def as_text(path):
    """Lines for people."""
    text = ["     ns   wire  logic  cells  source line"]
    total = 0.0
    for hop in path["hops"]:
        total += hop["routing_ns"] + hop["logic_ns"]
        text.append(
            f"  {total:5.2f}  {hop['routing_ns']:5.2f}  {hop['logic_ns']:5.2f}  {hop['cells']:5}  "
            f"{hop['source'] or '(generated control)'}  {hop['name']} ({hop['kind']})"
        )
    period = path["period_ns"]
    text.append(
        f"  {path['logic_ns']:.2f} ns logic ({100 * path['logic_ns'] / period:.0f} %), "
        f"{path['routing_ns']:.2f} ns wires ({100 * path['routing_ns'] / period:.0f} %)"
    )
    return text
