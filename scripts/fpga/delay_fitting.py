"""Fits the delays of rtl_gen/emit/device_delays.json to samples (timing_samples.py) of routed designs.

Cells: the mean of what nextpnr's critical paths show. How much longer the wires to block RAMs are: from wires that
flip-flops drive. How long the wires of critical chains are, and how they grow with their readers and with the design:
by least squares of the relative errors of the predicted periods, since the wires of critical chains are no typical ones. A period is predicted exactly as the compiler does it: the longest of the chains that its report lists.
"""

import collections
import math
import statistics

from flow_error import flow_error

cell_delays = (
    "clock_to_out",
    "lut",
    "carry_entry",
    "carry_bit",
    "carry_exit",
    "multiplier",
    "distributed_read",
    "block_clock_to_out",
    "block_setup",
    "setup",
    "enable_setup",
)
fitted_to_periods = {"wire": 0.1, "reader_doubling": 0.02, "side_doubling": 0.1}  # and the steps of the search
compact_side = 8  # as in rtl_gen/emit/clock_prediction.hpp
fewest_designs = 3


def routed_ns(sample):
    """The period of the median seed."""
    return 1000 / statistics.median(sample["mhz"].values())


def predicted_ns(sample, wires):
    longest = max(
        chain["cells_ns"] + chain["wires"] * wires["wire"] + chain["reader_doublings"] * wires["reader_doubling"]
        for chain in sample["chains"]
    )
    return longest + wires["side_doubling"] * math.log2(max(1.0, sample["side"] / compact_side))


def cells_of(samples):
    """{kind: (mean, fewest, most, count)} in ns; kinds that no path goes through are left out."""
    all_ps = collections.defaultdict(collections.Counter)
    for sample in samples:
        for kind, delays in sample["cells_ps"].items():
            all_ps[kind].update({int(ps): count for ps, count in delays.items()})
    found = {}
    for kind, delays in all_ps.items():
        count = sum(delays.values())
        mean = sum(ps * times for ps, times in delays.items()) / count
        found[kind] = (mean / 1000, min(delays) / 1000, max(delays) / 1000, count)
    return found


def block_wire(samples, before):
    """How many wires more a wire to a block RAM is, by the same design's wires to flip-flops."""
    ratios = []
    for sample in samples:
        means = {}
        for end in ("flip-flop", "block RAM"):
            rows = [row for row in sample["wires"] if row["to"] == end]
            count = sum(row["count"] for row in rows)
            if count:
                means[end] = sum(row["count"] * row["mean_ns"] for row in rows) / count
        if len(means) == 2:
            ratios.append(means["block RAM"] / means["flip-flop"] - 1)
    return max(0.0, statistics.median(ratios)) if ratios else before


def misfit(samples, wires):
    return sum((predicted_ns(sample, wires) / routed_ns(sample) - 1) ** 2 for sample in samples)


def search(samples, wires):
    """The best values of what is fitted to the periods, by a pattern search from two starts."""
    best = None
    for start in ((0.5, 0.05, 0.5), (0.2, 0.1, 0.8)):
        now = dict(wires, **dict(zip(fitted_to_periods, start)))
        cost = misfit(samples, now)
        step = dict(fitted_to_periods)
        while max(step.values()) > 1e-5:
            moved = False
            for name in fitted_to_periods:
                for sign in (1, -1):
                    other = dict(now, **{name: max(0.0, now[name] + sign * step[name])})
                    if misfit(samples, other) < cost - 1e-12:
                        now, cost, moved = other, misfit(samples, other), True
            if not moved:
                step = {name: size / 2 for name, size in step.items()}
        if best is None or cost < best[0]:
            best = (cost, now)
    return best[1]


def fit(samples, before):
    """The file of delays that `samples` give; `before` (such a file) has what they do not show."""
    if len(samples) < fewest_designs:
        raise flow_error(f"{len(samples)} designs are too few to fit delays to: at least {fewest_designs}")
    seen = cells_of(samples)
    cells = dict(before["cells_ns"])
    for kind in cell_delays:
        if kind in seen:
            cells[kind] = round(seen[kind][0], 4)
    if "slice" in seen and "setup" in seen:  # the wire from a LUT to its own flip-flop belongs to the flip-flop
        cells["setup"] = round(seen["setup"][0] + seen["slice"][0], 4)
    wires = dict(
        before["wires_ns"],
        block_wire=round(block_wire(samples, before["wires_ns"]["block_wire"]), 3),
    )
    wires = {name: round(value, 5) for name, value in search(samples, wires).items()}
    return {
        "schema": before["schema"],
        "target": before["target"],
        "cells_ns": {kind: cells[kind] for kind in cell_delays},
        "wires_ns": wires,
        "fitted_to": sorted(sample["name"] for sample in samples),
    }


def held_out(samples, before):
    """{name: ns} predicted for each design by delays that were fitted to the others only."""
    predicted = {}
    for sample in samples:
        others = [other for other in samples if other is not sample]
        predicted[sample["name"]] = predicted_ns(sample, fit(others, before)["wires_ns"])
    return predicted
