"""What a run of scripts/fpga.sh says about the device's delays: one JSON a design, small enough to be kept.

nextpnr's report has two things. Its critical paths name every cell and wire with its delay. Its detailed net timings
say when a signal arrives at each input of a flip-flop or RAM: where a flip-flop drives it, that is the flip-flop's
clock-to-out and one wire, so that thousands of wires are known by the number of their readers.
"""

import collections
import json
import pathlib
import statistics

import critical_path
import place_and_route
from flow_error import flow_error

schema = "epiline-timing/1"

# Cells that a delay of device_delays.json is the middle of.
in_slice = "slice"


def is_block_ram(port):
    """Data and addresses of DP16KD: ADA5, DIB7, DOB0, WEA, CEA, OCEB.."""
    return port[:3] in ("ADA", "ADB", "DIA", "DIB", "DOA", "DOB") or port in ("WEA", "WEB", "OCEA", "OCEB")


def kind_of_cell(part):
    """Which of the fitted delays a part of a critical path shows, or None."""
    before, after, cell = part["from"]["port"], part["to"]["port"], part["to"]["cell"]
    if part["type"] == "clk-to-q":
        return "block_clock_to_out" if is_block_ram(before) else "clock_to_out" if before == "Q" else None
    if part["type"] == "setup":
        if is_block_ram(after):
            return "block_setup"
        return "enable_setup" if after in ("CE", "LSR") else "setup" if after in ("DI", "M") else None
    if part["type"] == "routing":
        near = part["from"]["loc"] == part["to"]["loc"]
        return in_slice if near and after == "DI" else None
    if "MULT18X18D" in cell:
        return "multiplier"
    if "DPRAM_COMB" in cell:
        return "distributed_read"
    if before == "FCI":
        return "carry_bit" if after == "FCO" else "carry_exit"
    if after == "FCO":
        return "carry_entry"
    return "lut" if after in ("F", "OFX", "OFX0", "OFX1") else None


def cells_of(report):
    """{kind: {delay in ps: how often}} on the critical paths, those from and to pins as well."""
    found = collections.defaultdict(collections.Counter)
    for path in report["critical_paths"]:
        for part in path["path"]:
            kind = kind_of_cell(part)
            if kind:
                found[kind][round(1000 * part["delay"])] += 1
    return found


def readers_class(readers):
    """1, 2, 4, 8..: classes of readers that double."""
    return 1 << (readers.bit_length() - 1)


def wires_of(report, clock_to_out):
    """[(to a block RAM or not, readers, ns)]: wires from a flip-flop straight to flip-flops and RAMs; the readers that
    are counted are those."""
    samples = []
    for net in report["detailed_net_timings"]:
        if net["port"] != "Q" or not net["event"].startswith("posedge"):
            continue
        for end in net["endpoints"]:
            if end["event"].startswith("posedge"):
                wire = end["delay"][1] - clock_to_out
                samples.append((is_block_ram(end["port"]), len(net["endpoints"]), max(0.0, wire)))
    return samples


def summary_of_wires(samples):
    """A row for each class of readers, for fabric and block RAM apart."""
    classes = collections.defaultdict(list)
    for to_block_ram, readers, wire in samples:
        classes[(to_block_ram, readers_class(readers))].append(wire)
    return [
        {
            "to": "block RAM" if to_block_ram else "flip-flop",
            "readers": readers,
            "count": len(wires),
            "mean_ns": round(statistics.fmean(wires), 3),
            "median_ns": round(statistics.median(wires), 3),
            "longest_ns": round(max(wires), 3),
        }
        for (to_block_ram, readers), wires in sorted(classes.items())
    ]


def on_critical_paths(report):
    """Cells, wires and ns in both, of the longest path from clock to clock."""
    paths = critical_path.clock_to_clock_paths(report)
    if not paths:
        raise flow_error("no path leads from a register to a register: there is no clock to predict")
    parts = paths[0]["path"]
    wires = [part["delay"] for part in parts if part["type"] == "routing" and part["delay"] > 0.2]
    cells = sum(part["delay"] for part in parts if part["type"] != "routing")
    return {"cells_ns": round(cells, 3), "wires": len(wires), "longest_wire_ns": round(max(wires, default=0), 3)}


def figures_of(run):
    """What the table of improvements needs of a run's JSON."""
    return {
        "lut4": run["resources"]["lut4"],
        "flip_flops": run["resources"]["flip_flops"],
        "block_rams": run["resources"]["block_rams"],
        "mhz": {str(seed["seed"]): seed["fmax_mhz"] for seed in run["seeds"]},
    }


def read_json(file, what):
    try:
        return json.loads(file.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise flow_error(f"{file}: {what} cannot be read: {error}") from error


def read_run(folder):
    """The JSON that scripts/fpga.sh left in `folder`."""
    for file in sorted(pathlib.Path(folder).glob("*.json")):
        run = read_json(file, "the run's figures")
        if isinstance(run, dict) and str(run.get("schema", "")).startswith("epiline-fpga/"):
            return run
    raise flow_error(f"{folder} has no figures of a finished run of scripts/fpga.sh")


def sample_of(folder, report_file=None):
    """The JSON of a design, of a run's folder; `report_file` replaces its hls/report.json."""
    folder = pathlib.Path(folder)
    run = read_run(folder)
    report_file = report_file or folder / "hls" / "report.json"
    compiled = read_json(report_file, "the compiler's report")
    if not compiled.get("prediction"):
        raise flow_error(
            f"{report_file} has no prediction of the clock: it is of an older epiline-hls; run scripts/fpga.sh again "
            "(the placements are kept as long as the Verilog is the same)"
        )
    cells, wires, paths = collections.defaultdict(collections.Counter), [], {}
    for seed in run["seeds"]:
        name = f"seed_{seed['seed']}"
        report = place_and_route.read_report(folder / name)
        for kind, delays in cells_of(report).items():
            cells[kind].update(delays)
        paths[str(seed["seed"])] = on_critical_paths(report)
        found = cells["clock_to_out"]
        clock_to_out = min(found) / 1000 if found else 0
        if "detailed_net_timings" in report:
            wires += wires_of(report, clock_to_out)
    return {
        "schema": schema,
        "top": run["top"],
        "command": run["command"],
        "device": run["device"],
        "speed_grade": run["speed_grade"],
        "scheduled_ns": run["clock"]["scheduled_ns"],
        "estimated_ns": compiled["clock"]["estimated_period_ns"],
        "side": compiled["prediction"]["side"],
        "chains": compiled["prediction"]["chains"],
        **figures_of(run),
        "critical_paths": paths,
        "cells_ps": {kind: {str(ps): n for ps, n in sorted(delays.items())} for kind, delays in sorted(cells.items())},
        "wires": summary_of_wires(wires),
    }
