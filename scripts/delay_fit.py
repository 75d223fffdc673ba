#!/usr/bin/env python3
"""Fits the delays in which epiline-hls predicts the clock to routed designs, and makes docs/timing.md.

  scripts/delay_fit.py                 fits to docs/results/timing/*.json; writes rtl_gen/emit/device_delays.json and
                                       docs/timing.md
  scripts/delay_fit.py --check         writes nothing; ends with exit code 1 if these two files are not what it would write
  scripts/delay_fit.py --collect RUN [--report FILE] [--before RUN | --before-text TEXT]
                                       reads a folder of scripts/fpga.sh into docs/results/timing/TOP.json

--report FILE takes the compiler's report.json from elsewhere (of a newer compiler with the same Verilog). --before RUN
is the same source placed with an earlier compiler; --before-text says what became of that instead. --left-out TEXT
keeps a design out of the fit and of its table, with the reason.
"""

import argparse
import json
import math
import pathlib
import re
import statistics
import sys

root = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(root / "scripts" / "fpga"))

import delay_fitting  # noqa: E402  scripts/fpga
import timing_samples  # noqa: E402  scripts/fpga
from flow_error import flow_error  # noqa: E402  scripts/fpga
from results_table import table  # noqa: E402
from whole_file import holds, write_whole  # noqa: E402

head = """# The clock: predicted and reached

Made by `scripts/delay_fit.py` from [results/timing](results/timing/), a file a design. What the prediction is and how to repeat all this: [fpga.md](fpga.md#the-predicted-clock).

## Predicted periods

LFE5U-85F, speed grade 8, nextpnr 0.11.1 with the options of `scripts/fpga.sh`, the median of the seeds in brackets. *Scheduler*: the slowest chain in the delays that the scheduler decides by (`estimated_period_ns`). *Fitted*: the prediction in the delays that are built in, which were fitted to all these designs. *Held out*: the prediction in delays that were fitted to the other designs only, which is what a new design has to expect. All were placed with the scripts of commit 532f0b0, before `scripts/carry_chains.py`. Which terms the prediction has was chosen with these designs in view; only the numbers are held out.

"""

cells_head = """
## The delays

Cells as nextpnr's critical paths show them. `setup` has the wire from a LUT to its own flip-flop in it.

"""

wires_head = """
Wires. The side of a design is the square root of its LUT4 or flip-flops, whichever are more.

"""

readers_head = """
Wires from flip-flops straight to flip-flops and RAMs, by how many of these one flip-flop drives (all seeds; mean and longest, ns):

"""

constants_head = """
## Beside the scheduler's constants

What `rtl_gen/schedule/delay_model.cpp` decides by, wires included, and the same in fitted delays for a small design (side 25) and a large one (side 190). The scheduler adds what many readers cost and leaves 15 % of the period to the wires (`calm_share`); the fitted delays have `side_doubling` instead, once a chain.

"""

improvements_head = """
## Before and after

The compiler's work on place and route, measured: *before* is the compiler of commit 9fff40b, the last one before it; *after* that of commit 532f0b0. The same source, the same Yosys and nextpnr, the same options and seeds; MHz is the median. Where a text stands instead, what is known is older: sizes by Debian's Yosys 0.23, one placement.

"""


def off(predicted, routed):
    return f"{100 * (predicted / routed - 1):+.1f} %"


def median_mhz(figures):
    return statistics.median(figures["mhz"].values())


def read_samples(folder):
    samples = []
    for file in sorted(folder.glob("*.json")):
        sample = timing_samples.read_json(file, "the sample")
        if sample.get("schema") != timing_samples.schema:
            raise flow_error(f"{file}: not a sample ({timing_samples.schema}): scripts/delay_fit.py --collect makes one")
        samples.append({**sample, "name": file.stem})
    if not samples:
        raise flow_error(f"{folder} has no samples: scripts/delay_fit.py --collect RUN makes them")
    return samples


def prediction_table(samples, delays, held_out):
    rows, misses = [], {"scheduler": [], "fitted": [], "held out": []}
    for sample in sorted(samples, key=lambda one: one["side"]):
        routed = delay_fitting.routed_ns(sample)
        periods = {
            "scheduler": sample["estimated_ns"],
            "fitted": delay_fitting.predicted_ns(sample, delays["wires_ns"]),
            "held out": held_out[sample["name"]],
        }
        for kind, period in periods.items():
            misses[kind].append(abs(period / routed - 1))
        rows.append(
            [f"`{sample['name']}`", str(sample["lut4"]), str(sample["flip_flops"]), f"{sample['side']:.0f}"]
            + [f"{routed:.2f} ({', '.join(f'{1000 / mhz:.2f}' for mhz in sample['mhz'].values())})"]
            + [text for period in periods.values() for text in (f"{period:.2f}", off(period, routed))]
        )
    header = ["design", "LUT4>", "flip-flops>", "side>", "routed, ns>"]
    header += ["scheduler>", "off by>", "fitted>", "off by>", "held out>", "off by>"]
    text = table(header, rows) + "\nErrors without their signs:\n\n"
    rows = [
        [kind, f"{100 * statistics.median(of_kind):.1f} %", f"{100 * max(of_kind):.1f} %"]
        + [f"{sum(miss <= 0.15 for miss in of_kind)} of {len(of_kind)}"]
        for kind, of_kind in misses.items()
    ]
    return text + table(["prediction", "median>", "worst>", "within 15 %>"], rows)


def constants_of(source):
    """{name: ns} of the ECP5's constants in delay_model.cpp."""
    block = re.search(r"constexpr delay_parameters ecp5\{(.*?)\};", source.read_text(encoding="utf-8"), re.DOTALL)
    if not block:
        raise flow_error(f"{source}: its constants of the ECP5 are not where they were")
    return {name: float(value) for name, value in re.findall(r"\.(\w+) = ([\d.]+)", block.group(1))}


def constants_table(delays, constants):
    cells, wires = delays["cells_ns"], delays["wires_ns"]

    def fitted(side):
        wire = wires["wire"]
        return {
            "launch": cells["clock_to_out"] + wire,
            "capture": cells["setup"],
            "lut_level": cells["lut"] + wire,
            "carry_entry": cells["carry_entry"],
            "carry_bit": cells["carry_bit"],
            "carry_exit": cells["carry_exit"] + wire,
            "distributed_read": cells["distributed_read"] + wire,
            "memory_setup": cells["block_setup"],
            "block_wire": wires["block_wire"] * wire,
            "spread_doubling": wires["reader_doubling"],
            "longest wire, beyond the usual": wires["side_doubling"] * math.log2(side / delay_fitting.compact_side),
        }

    small, large = fitted(25), fitted(190)
    rows = [
        [f"`{name}`" if name in constants else name, f"{constants[name]:.3f}" if name in constants else "-"]
        + [f"{value:.3f}", f"{large[name]:.3f}"]
        for name, value in small.items()
    ]
    return table(["constant", "scheduler, ns>", "fitted, small>", "fitted, large>"], rows)


def delays_text(samples, delays):
    seen = delay_fitting.cells_of(samples)
    rows = []
    for kind in delay_fitting.cell_delays:
        low, high, count = seen[kind][1:] if kind in seen else (None, None, 0)
        spread = f"{low:.3f} to {high:.3f}" if count else "not seen: as it was"
        rows.append([f"`{kind}`", f"{delays['cells_ns'][kind]:.3f}", spread, str(count)])
    text = cells_head + table(["cell", "ns>", "between", "seen>"], rows) + wires_head
    meaning = {
        "wire": "ns, from a cell to the next",
        "reader_doubling": "ns for every doubling of the readers",
        "block_wire": "wires more than to a flip-flop, to or from a block RAM",
        "side_doubling": f"ns for every doubling of the side beyond {delay_fitting.compact_side}, once in a chain",
    }
    text += table(["wire", "value>", ""], [[f"`{n}`", f"{delays['wires_ns'][n]:g}", m] for n, m in meaning.items()])
    text += readers_head
    rows = []
    for sample in sorted(samples, key=lambda one: one["side"]):
        by_class = {(row["to"], row["readers"]): row for row in sample["wires"]}
        for end in ("flip-flop", "block RAM"):
            found = [by_class.get((end, readers)) for readers in (1, 2, 4, 8, 16, 32)]
            if any(found):
                cells = [f"{row['mean_ns']:.2f}, {row['longest_ns']:.2f}" if row else "" for row in found]
                rows.append([f"`{sample['name']}`", end, *cells])
    return text + table(["design", "to", "1>", "2, 3>", "4 to 7>", "8 to 15>", "16 to 31>", "32 to 63>"], rows)


def improvements_table(samples):
    rows = []
    for sample in sorted(samples, key=lambda one: one["side"]):
        before = sample.get("before")
        if before is None:
            continue
        then = median_mhz(before) if before.get("mhz") else None
        now = median_mhz(sample)
        figures = [(before.get(kind), sample[kind]) for kind in ("lut4", "flip_flops")]
        rows.append(
            [f"`{sample['name']}`"]
            + ["-" if one is None else str(one) for pair in figures for one in pair]
            + [f"{then:.1f}" if then else before["text"], f"{now:.1f}", f"{100 * (now / then - 1):+.0f} %" if then else ""]
        )
    header = ["design", "LUT4 before>", "after>", "flip-flops before>", "after>", "MHz before>", "after>", "clock>"]
    return table(header, rows)


def make(samples, before, constants):
    """(file of delays, docs/timing.md)"""
    used = [sample for sample in samples if not sample.get("left_out")]
    delays = delay_fitting.fit(used, before)
    text = head + prediction_table(used, delays, delay_fitting.held_out(used, before))
    left_out = [f"`{sample['name']}`: {sample['left_out']}" for sample in samples if sample.get("left_out")]
    if left_out:
        text += "\nLeft out of the fit: " + "; ".join(left_out) + ".\n"
    text += delays_text(used, delays) + constants_head + constants_table(delays, constants)
    text += improvements_head + improvements_table(samples)
    return json.dumps(delays, indent=1) + "\n", text


def collect(options):
    sample = timing_samples.sample_of(options.collect, options.report)
    if options.before:
        sample["before"] = timing_samples.figures_of(timing_samples.read_run(options.before))
    elif options.before_text:
        sample["before"] = {"text": options.before_text}
        for pair in options.before_size:
            name, _, value = pair.partition("=")
            if name not in ("lut4", "flip_flops") or not value.isdigit():
                raise flow_error(f"--before-size {pair}: give lut4=NUMBER or flip_flops=NUMBER")
            sample["before"][name] = int(value)
    if options.left_out:
        sample["left_out"] = options.left_out
    file = options.samples / f"{sample['top']}.json"
    write_whole(file, json.dumps(sample, indent=1) + "\n")
    print(f"wrote {file}")


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="compare only")
    parser.add_argument("--collect", type=pathlib.Path, metavar="RUN", help="folder of a finished scripts/fpga.sh")
    parser.add_argument("--report", type=pathlib.Path, metavar="FILE", help="with --collect: report.json from elsewhere")
    parser.add_argument("--before", type=pathlib.Path, metavar="RUN", help="with --collect: an earlier compiler's run")
    parser.add_argument("--before-text", metavar="TEXT", help="with --collect: in place of an earlier clock")
    parser.add_argument("--before-size", action="append", default=[], metavar="KIND=N", help="with --before-text")
    parser.add_argument("--left-out", metavar="TEXT", help="with --collect: why the fit is not to use it")
    parser.add_argument("--samples", type=pathlib.Path, default=root / "docs" / "results" / "timing", metavar="FOLDER")
    parser.add_argument("--delays", type=pathlib.Path, default=root / "rtl_gen" / "emit" / "device_delays.json")
    parser.add_argument("-o", "--output", type=pathlib.Path, default=root / "docs" / "timing.md")
    options = parser.parse_args(arguments)
    try:
        if options.collect:
            collect(options)
            return 0
        before = timing_samples.read_json(options.delays, "the file of delays")
        constants = constants_of(root / "rtl_gen" / "schedule" / "delay_model.cpp")
        texts = make(read_samples(options.samples), before, constants)
        for file, text in zip((options.delays, options.output), texts):
            if not options.check:
                write_whole(file, text)
                print(f"wrote {file}")
            elif not holds(file, text):
                raise flow_error(f"{file} is not what {options.samples} gives: run scripts/delay_fit.py")
    except KeyError as error:
        print(f"delay_fit.py: error: a sample has no key {error}", file=sys.stderr)
        return 1
    except (flow_error, OSError) as error:
        print(f"delay_fit.py: error: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
