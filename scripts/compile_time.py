#!/usr/bin/env python3
"""How long the compiler takes, and how its time and memory grow with the number of disparity levels.

    scripts/compile_time.py [LEVELS ...]        default: 16 32 64 80 128
    scripts/compile_time.py --tops

Compiles the whole method 2 with each number of levels and prints seconds of processor time, the same per level, and the
peak of memory. Fails when the time per level at the largest number exceeds that at 64 levels by more than half: growth
that is worse than linear. (Below 64 levels reading the headers is most of the work.)

With --tops the same for the tops of 80 levels as they are in hls/tops; fails when one of them takes more than 10 s. Run
it on an idle machine: beside other programs the same work takes up to twice the processor time.
"""

import argparse
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
COMPILER = ROOT / "build" / "bin" / "epiline-hls"

TOP = """#include "tops/color_fuzzy.hpp"
struct config : epiline::tops::color_fuzzy_config {{
  static constexpr int levels = {levels};
}};
using types = epiline::tops::color_fuzzy_interface<config>;
void color_fuzzy_{levels}(hls::stream<types::video_beat>& left, hls::stream<types::video_beat>& right,
                          hls::stream<types::disparity_beat>& disparity, types::width_t width, types::height_t height,
                          types::levels_t levels, ap_uint<1> left_right, ap_uint<5> uniqueness, ap_uint<2> fuzzy,
                          ap_uint<1> careful_fill) {{
  epiline::tops::color_fuzzy_frame<config>(left, right, disparity, width, height, levels, left_right, uniqueness, fuzzy,
                                           careful_fill);
}}
"""


# The clock that each of them is made for.
TOPS = {"color_fuzzy": "6ns", "adaptive_ca": "6ns", "color_fuzzy_p2": "6ns", "adaptive_ca_p2": "6.6ns"}
MOST_SECONDS = 10


def compile_top(source, top, folder, *options):
    """Seconds of processor time and peak memory (MB) of one compilation."""
    command = [str(COMPILER), str(source), "--top", top, "-I", str(ROOT / "hls"), "--quiet", "-o", str(folder / top),
               *options]
    process = subprocess.Popen(command)
    _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        sys.exit(f"epiline-hls failed at {top}")
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def compile_levels(levels, folder):
    top = f"color_fuzzy_{levels}"
    source = folder / f"{top}.cpp"
    source.write_text(TOP.format(levels=levels))
    return compile_top(source, top, folder)


def check_growth(numbers):
    per_level = {}
    print("levels  seconds  ms/level    MB")
    with tempfile.TemporaryDirectory() as name:
        for levels in numbers:
            seconds, memory = compile_levels(levels, pathlib.Path(name))
            per_level[levels] = seconds / levels
            print(f"{levels:6}  {seconds:7.2f}  {1000 * per_level[levels]:8.1f}  {memory:4.0f}", flush=True)
    if 64 in per_level and per_level[numbers[-1]] > 1.5 * per_level[64]:
        sys.exit("the time grows worse than linearly")


def check_tops():
    slow = []
    print("top              seconds    MB")
    with tempfile.TemporaryDirectory() as name:
        for top, clock in TOPS.items():
            source = ROOT / "hls" / "tops" / f"{top}.cpp"
            seconds, memory = compile_top(source, top, pathlib.Path(name), "--target", "ecp5", "--clock", clock)
            print(f"{top:15}  {seconds:7.2f}  {memory:4.0f}", flush=True)
            if seconds > MOST_SECONDS:
                slow.append(top)
    if slow:
        sys.exit(f"more than {MOST_SECONDS} s: {', '.join(slow)}")


def main():
    parser = argparse.ArgumentParser(description="How long the compiler takes.")
    parser.add_argument("levels", nargs="*", type=int, help="numbers from 1 to 128")
    parser.add_argument("--tops", action="store_true", help="the tops of 80 levels instead")
    given = parser.parse_args()
    if not COMPILER.exists():
        sys.exit(f"{COMPILER} is missing: build first (cmake --preset release && cmake --build --preset release)")
    if given.tops:
        check_tops()
        return
    numbers = sorted(set(given.levels)) or [16, 32, 64, 80, 128]
    if numbers[0] < 1 or numbers[-1] > 128:
        sys.exit("levels must be numbers from 1 to 128")
    check_growth(numbers)


if __name__ == "__main__":
    main()
