#!/usr/bin/env python3
"""Makes docs/results.md from the figures of published runs and of others.

  scripts/results_table.py            writes docs/results.md
  scripts/results_table.py --check    writes nothing; ends with exit code 1 if docs/results.md is another text
  scripts/results_table.py --results FOLDER -o FILE

FOLDER (default docs/results) holds the JSON files that scripts/fpga.sh wrote for the published runs, and
published.json: rows of the literature with their sources.
"""

import argparse
import json
import pathlib
import sys

from whole_file import holds, write_whole

root = pathlib.Path(__file__).resolve().parent.parent
run_schema = "epiline-fpga/1"

head = """# Results

Made by `scripts/results_table.py` from the files in [docs/results](results/): one a run of `scripts/fpga.sh`, and `published.json` with the figures of others. What each figure means and how it is measured: [fpga.md](fpga.md).

## Beside others

MDE/s are million disparity evaluations a second, width * height * levels * frames/s / 10^6. Logic is in each device's own unit: LUT4 (ECP5, iCE40; a carry cell counts 2, a 16x4 RAM 6), LUT6 (Xilinx), ALUT (Altera) are not the same, and methods of different windows, colours and checks are not the same work. Epiline's rows are after place and route, the median of their seeds; a dash is a figure that the source does not give.

"""

runs_head = """
## Epiline's runs

"""

prediction_head = """
## The compiler's estimate and the device

What epiline-hls predicted for the Verilog of each run, and the period of the median seed after routing.

"""

path_head = """
## What limits the clock

The longest path of each run's best seed, by what the C++ lines cost.

"""


class table_error(Exception):
    """One sentence for the person at the terminal."""


def read_json(file):
    try:
        return json.loads(file.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise table_error(f"{file}: {error}") from error


def read_runs(folder):
    """The runs of a folder, most evaluations a second first."""
    runs = []
    for file in sorted(folder.glob("*.json")):
        if file.name == "published.json":
            continue
        run = read_json(file)
        if run.get("schema") != run_schema:
            raise table_error(f"{file} is not a result of scripts/fpga.sh (schema {run_schema})")
        run["file"] = file.name
        runs.append(run)
    return sorted(runs, key=lambda run: (-(run["mde_per_second"] or 0), run["file"]))


def number(value, digits=0):
    return "-" if value is None else f"{value:,.{digits}f}" if isinstance(value, (int, float)) else str(value)


def table(columns, rows):
    """A Markdown table; columns whose name ends with > are aligned to the right."""
    names = [column.rstrip(">") for column in columns]
    lines = [
        "| " + " | ".join(names) + " |",
        "|" + "|".join("---:" if column.endswith(">") else "---" for column in columns) + "|",
    ]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows]) + "\n"


def published_entry(row, sources):
    if row["source"] not in sources:
        raise table_error(f"published.json: the source '{row['source']}' of {row['core']} is not listed")
    frames, logic = row["frames_per_second"], row.get("logic")
    evaluations = row["width"] * row["height"] * row["levels"] * frames / 1e6
    each = f"{evaluations / logic:.3f} per {row['logic_unit']}" if logic else "-"
    return evaluations, [
        row["core"],
        row["method"],
        row["device"],
        f"{number(logic)} {row.get('logic_unit', '')}".strip(),
        number(row.get("flip_flops")),
        number(row.get("block_rams")),
        number(row.get("multipliers")),
        number(row.get("megahertz")),
        f"{row['width']}x{row['height']}, {row['levels']}",
        number(frames, 0 if frames == int(frames) else 1),
        number(evaluations),
        each,
        row["source"],
    ]


def device_of(run):
    return run["device"] + (f", speed {run['speed_grade']}" if run["speed_grade"] else "")


def run_entry(run):
    frame, taken = run["frame"], run["resources"]
    each = run["mde_per_second_per_lut4"]
    return run["mde_per_second"], [
        f"**Epiline `{run['top']}`**",
        "see [README](../README.md#designs)",
        device_of(run),
        f"{taken['lut4']:,} LUT4",
        number(taken["flip_flops"]),
        number(taken["block_rams"]),
        number(taken["multipliers"]),
        number(run["fmax_mhz"]["median"], 1),
        f"{frame['width']}x{frame['height']}, {frame['levels']}",
        number(run["frames_per_second"]),
        number(run["mde_per_second"]),
        "-" if each is None else f"**{each:.3f} per LUT4**",
        f"[{run['file']}](results/{run['file']})",
    ]


def make_text(folder):
    published = read_json(folder / "published.json")
    runs = read_runs(folder)
    compared = [published_entry(row, published["sources"]) for row in published["rows"]]
    compared += [run_entry(run) for run in runs if run["mde_per_second"] is not None]
    compared.sort(key=lambda entry: -entry[0])
    text = head + table(
        [
            "core",
            "method",
            "device",
            "logic>",
            "flip-flops>",
            "block RAMs>",
            "multipliers>",
            "MHz>",
            "frame, levels",
            "frames/s>",
            "MDE/s>",
            "MDE/s per logic>",
            "source",
        ],
        [row for _, row in compared],
    )
    text += (
        "\nSources: " + "; ".join(f"*{name}*: {title}" for name, title in sorted(published["sources"].items())) + ".\n"
    )
    text += runs_head
    if not runs:
        return text + "No run is published yet.\n"
    text += table(
        [
            "top",
            "device",
            "LUT4>",
            "flip-flops>",
            "block RAMs>",
            "multipliers>",
            "fmax by seed, MHz",
            "median>",
            "clocks a frame>",
            "frames/s>",
            "status",
            "command",
        ],
        [
            [
                f"`{run['top']}`",
                device_of(run),
                number(run["resources"]["lut4"]),
                number(run["resources"]["flip_flops"]),
                number(run["resources"]["block_rams"]),
                number(run["resources"]["multipliers"]),
                ", ".join(f"{seed['fmax_mhz']:.1f} ({seed['seed']})" for seed in run["seeds"]),
                number(run["fmax_mhz"]["median"], 1),
                number(run["frame"]["cycles"]),
                number(run["frames_per_second"]),
                f"{run['clock']['wanted_mhz']:.1f} MHz " + ("reached" if run["status"] == "ok" else "not reached"),
                f"`{run['command']}`",
            ]
            for run in runs
        ],
    )
    versions = sorted({f"{name} {version}" for run in runs for name, version in run["tools"].items()})
    text += "\nTools: " + ", ".join(versions) + ".\n"
    text += prediction_head
    rows = []
    for run in runs:
        routed = 1000 / run["fmax_mhz"]["median"]
        estimated = run["clock"]["estimated_ns"]
        rows.append(
            [
                f"`{run['top']}`",
                device_of(run),
                number(estimated, 2),
                number(routed, 2),
                f"{100 * (estimated - routed) / routed:+.1f} %",
            ]
        )
    text += table(["top", "device", "estimated, ns>", "routed, ns>", "estimate off by>"], rows)
    text += path_head
    rows = []
    for run in runs:
        best = next(seed for seed in run["seeds"] if seed["seed"] == run["fmax_mhz"]["best_seed"])
        path = best["critical_path"]
        if path is None:  # no register drives another
            continue
        hops = sorted(path["hops"], key=lambda hop: -(hop["logic_ns"] + hop["routing_ns"]))[:4]
        rows.append(
            [
                f"`{run['top']}`",
                number(path["period_ns"], 2),
                number(path["logic_ns"], 2),
                number(path["routing_ns"], 2),
                "; ".join(
                    f"{hop['source'] or 'control'} `{hop['name'].replace('|', '')}` "
                    f"{hop['logic_ns'] + hop['routing_ns']:.2f} ns"
                    for hop in hops
                ),
            ]
        )
    text += table(["top", "ns>", "logic>", "wires>", "most of it"], rows)
    return text


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="compare only")
    parser.add_argument(
        "--results", type=pathlib.Path, default=root / "docs" / "results", help="folder of the JSON files"
    )
    parser.add_argument(
        "-o", "--output", type=pathlib.Path, default=root / "docs" / "results.md", help="the file to write"
    )
    options = parser.parse_args(arguments)
    try:
        text = make_text(options.results)
        if options.check:
            if not holds(options.output, text):
                raise table_error(f"{options.output} is not what {options.results} gives: run scripts/results_table.py")
            return 0
        write_whole(options.output, text)
    except KeyError as error:
        print(f"results_table.py: error: a result has no key {error}", file=sys.stderr)
        return 1
    except (table_error, OSError) as error:
        print(f"results_table.py: error: {error}", file=sys.stderr)
        return 1
    print(f"wrote {options.output}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
