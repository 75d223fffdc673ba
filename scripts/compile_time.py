#!/usr/bin/env python3
"""How the compiler's time and memory grow with the number of disparity levels.

    scripts/compile_time.py [LEVELS ...]        default: 16 32 64 80 128

Compiles the whole method 2 with each number of levels and prints seconds of processor time, the same per level, and the
peak of memory. Fails when the time per level at the largest number exceeds that at 64 levels by more than half: growth
that is worse than linear. (Below 64 levels reading the headers is most of the work.)
"""

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


def compile_top(levels, folder):
    """Seconds of processor time and peak memory (MB) of one compilation."""
    source = folder / f"color_fuzzy_{levels}.cpp"
    source.write_text(TOP.format(levels=levels))
    command = [str(COMPILER), str(source), "--top", f"color_fuzzy_{levels}", "-I", str(ROOT / "hls"),
               "--quiet", "-o", str(folder / f"out_{levels}")]
    process = subprocess.Popen(command)
    _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        sys.exit(f"epiline-hls failed at {levels} levels")
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def main():
    if not COMPILER.exists():
        sys.exit(f"{COMPILER} is missing: build first (cmake --preset release && cmake --build --preset release)")
    try:
        numbers = sorted({int(text) for text in sys.argv[1:]}) or [16, 32, 64, 80, 128]
    except ValueError:
        sys.exit("levels must be numbers from 1 to 128")
    if numbers[0] < 1 or numbers[-1] > 128:
        sys.exit("levels must be numbers from 1 to 128")
    per_level = {}
    print("levels  seconds  ms/level    MB")
    with tempfile.TemporaryDirectory() as name:
        for levels in numbers:
            seconds, memory = compile_top(levels, pathlib.Path(name))
            per_level[levels] = seconds / levels
            print(f"{levels:6}  {seconds:7.2f}  {1000 * per_level[levels]:8.1f}  {memory:4.0f}", flush=True)
    if 64 in per_level and per_level[numbers[-1]] > 1.5 * per_level[64]:
        sys.exit("the time grows worse than linearly")


if __name__ == "__main__":
    main()
