"""nextpnr for one seed, and what its report says."""

import json
import re

from steps import program

# Lines of nextpnr's log, and what they mean to someone who waits.
phases = (
    (r"^Info: Packing (\w+)", r"packing \1"),
    (r"^Info: Creating initial analytic placement for (\d+) cells", r"placing \1 cells"),
    (r"^Info:     at iteration #(\d*)[05], .*legal = (\d+)", r"placing, wires \2"),
    (r"^Info: Running simulated annealing placer", "refining the placement"),
    (r"^Info: Routing globals", "routing clocks"),
    (r"^Info: Routing (\d+) arcs", r"routing \1 wires"),
    (r"^Info: Routing complete", "timing"),
)

# How much more the analytic placer minds the wires of slow paths: 10 is nextpnr's default. With 100 a method of 16 levels
# came out 23 % faster on one seed, and 51 % on another.
timing_weight = 100

# What nextpnr's report calls the cells of each family.
utilisation_names = {
    "ecp5": {
        "logic_cells": "TRELLIS_COMB",
        "flip_flops": "TRELLIS_FF",
        "block_rams": "DP16KD",
        "multipliers": "MULT18X18D",
    },
    "hx8k": {"logic_cells": "ICESTORM_LC", "block_rams": "ICESTORM_RAM"},
}


def command_for(family, executable, options, netlist, top, seed, megahertz, constraints):
    """nextpnr's command line; it writes its files into the current folder."""
    command = [
        executable,
        *options,
        "--json",
        netlist,
        "--top",
        top,
        "--seed",
        str(seed),
        "--report",
        "report.json",
        "--placer-heap-timingweight",
        str(timing_weight),
        "--timing-allow-fail",
    ]  # whether the clock is reached is judged from the report
    if family == "ecp5":
        command += ["--textcfg", f"{top}.config", "--detailed-timing-report"]
        command += ["--lpf", constraints] if constraints else ["--lpf-allow-unconstrained"]
    else:
        command += ["--asc", f"{top}.asc"]
        command += ["--pcf", constraints] if constraints else []
    if constraints is None:
        command += ["--freq", f"{megahertz:.3f}"]
    return command


def seed_program(command, seed, folder, environment):
    return program(f"place and route, seed {seed}", command, folder, folder / "nextpnr.log", environment, phases)


def read_report(folder):
    return json.loads((folder / "report.json").read_text(encoding="utf-8"))


def clocks_of(report):
    """{clock: (reached MHz, wanted MHz)} after routing."""
    return {name: (clock["achieved"], clock["constraint"]) for name, clock in report["fmax"].items()}


def core_clock(clocks):
    """The clock that the design runs at: on a board with several the one that wants the most."""
    return max(clocks, key=lambda name: clocks[name][1])


def utilisation(report, family):
    return {
        ours: report["utilization"][theirs]["used"]
        for ours, theirs in utilisation_names[family].items()
        if theirs in report["utilization"]
    }


def does_not_fit(log_text):
    """Whether nextpnr gave up since the device is (nearly) full."""
    return (
        re.search(
            r"ERROR: .*(unable to (?:find|place)|failed to (?:find|place)|no (?:more )?bels|no BELs remaining|"
            r"utilisation limit|expand the region)",
            log_text,
            re.IGNORECASE,
        )
        is not None
    )
