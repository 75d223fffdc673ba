#!/usr/bin/env python3
"""Measures how many clocks the generated hardware needs a frame, and writes them with its clock for `epiline evaluate`.

  scripts/frame_rates.py -o timing.json                            every design
  scripts/frame_rates.py --design color_fuzzy -o timing.json       one design
  build/bin/epiline evaluate --timing timing.json -o report

Clocks are counted in Verilator, from the first input beat to the last output beat, on frames of noise in the sizes of
the paper's tables; a size that the design's line memories do not hold is left out. The clock is the compiler's own
estimate for the target (epiline-hls, its report.json), before place and route, and the file says so.
"""

import argparse
import json
import pathlib
import random
import re
import subprocess
import sys
import tempfile

from whole_file import write_whole

root = pathlib.Path(__file__).resolve().parent.parent
# The sizes of the paper's table of frame rates, and of Tsukuba and Venus, whose milliseconds it prints.
sizes = [(320, 240), (384, 288), (434, 383), (640, 480), (800, 600), (1024, 768), (1280, 1024)]
levels = 80


class measuring_error(Exception):
    """One sentence for the person at the terminal."""


def run(command):
    ended = subprocess.run([str(word) for word in command], capture_output=True, text=True)
    if ended.returncode != 0:
        raise measuring_error(f"{' '.join(str(word) for word in command)}: {(ended.stderr or ended.stdout).strip()}")
    return ended.stdout


def designs_of(epiline):
    """{design: (largest width, pixels a beat)} as `epiline match --list` prints them."""
    pattern = r"^(\w+): .*\n  images up to (\d+)x.* (\d+) pixel\(s\) a beat$"
    listed = re.findall(pattern, run([epiline, "match", "--list"]), re.MULTILINE)
    return {name: (int(width), int(pixels)) for name, width, pixels in listed}


def write_noise(path, width, height):
    generator = random.Random(1)
    path.write_bytes(b"P5\n%d %d\n255\n" % (width, height) + generator.randbytes(width * height))


def clock_of(compiler, design, target, period, folder):
    run([compiler, root / "hls" / "tops" / f"{design}.cpp", "--top", design, "--target", target, "--clock", period,
         "-o", folder / design])
    report = json.loads((folder / design / "report.json").read_text(encoding="utf-8"))
    estimate = report["clock"]["estimated_period_ns"]
    return {
        "megahertz": 1000 / estimate,
        "source": f"epiline-hls's own estimate for {target}, before place and route ({estimate:.2f} ns)",
    }


def frames_of(epiline, design, largest_width, folder):
    for width, height in sizes:
        if width > largest_width:
            print(f"{design} {width}x{height}: left out, the line memories hold {largest_width} columns")
            continue
        image = folder / f"{width}x{height}.pgm"
        write_noise(image, width, height)
        figures = folder / "figures.json"
        run([epiline, "match", "--design", design, "--engine", "rtl", image, image, "--levels", levels,
             "--json", figures])
        cycles = json.loads(figures.read_text(encoding="utf-8"))["cycles"]
        print(f"{design} {width}x{height}: {cycles} clocks, {cycles / width / height:.4f} a pixel", flush=True)
        yield {"width": width, "height": height, "levels": levels, "cycles": cycles}


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", required=True, type=pathlib.Path, help="the file to write")
    parser.add_argument("--design", action="append", help="a design; may be repeated (default: every one)")
    parser.add_argument("--programs", type=pathlib.Path, default=root / "build" / "bin", help="folder of the programs")
    parser.add_argument("--target", default="ecp5", help="target of the clock's estimate (default ecp5)")
    parser.add_argument("--clock", default="6ns", help="clock asked for (default 6ns)")
    options = parser.parse_args(arguments)
    try:
        epiline = options.programs / "epiline"
        if not epiline.exists():
            raise measuring_error(f"{epiline} is not there: build it first (scripts/test.sh), or name --programs")
        if not options.output.resolve().parent.is_dir():
            raise measuring_error(f"{options.output.resolve().parent} is not a folder")
        known = designs_of(epiline)
        for name in options.design or []:
            if name not in known:
                raise measuring_error(f"unknown design '{name}'; designs: {', '.join(known)}")
        found = {}
        with tempfile.TemporaryDirectory() as folder:
            place = pathlib.Path(folder)
            for name in options.design or known:
                largest_width, pixels = known[name]
                clock = clock_of(options.programs / "epiline-hls", name, options.target, options.clock, place)
                print(f"{name}: {clock['megahertz']:.1f} MHz, {clock['source']}", flush=True)
                found[name] = {
                    "clock": clock,
                    "cycles_source": f"counted in Verilator (engine rtl) without pauses, pixels a beat: {pixels}",
                    "frames": list(frames_of(epiline, name, largest_width, place)),
                }
        write_whole(options.output, json.dumps({"schema": "epiline-timing/1", "designs": found}, indent=1) + "\n")
    except (measuring_error, OSError, KeyError, ValueError) as error:
        print(f"frame_rates.py: error: {error}", file=sys.stderr)
        return 1
    print(f"wrote {options.output}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
