"""From clocks a frame and a clock rate to frames a second, and to what the literature compares."""

import json
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import frame_rates  # noqa: E402  scripts/frame_rates.py


def cycles_of_a_frame(build, top, verilog, width, height, levels):
    """Clocks of one frame in Verilator: {"cycles", "cycles_source"} or {"cycles": None, "reason"}."""
    epiline = build / "bin" / "epiline"
    try:
        if not epiline.exists():
            raise frame_rates.measuring_error(f"{epiline} is not built")
        known = frame_rates.designs_of(epiline)
        if top not in known:
            raise frame_rates.measuring_error(f"epiline has no design of the name {top} to simulate")
        largest_width, pixels = known[top]
        if width > largest_width:
            raise frame_rates.measuring_error(f"the line memories hold {largest_width} columns, not {width}")
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            image = folder / "noise.pgm"
            frame_rates.write_noise(image, width, height)
            frame_rates.run(
                [
                    epiline,
                    "match",
                    "--design",
                    top,
                    "--engine",
                    "rtl",
                    image,
                    image,
                    "--levels",
                    levels,
                    "--json",
                    folder / "figures.json",
                ]
            )
            cycles = json.loads((folder / "figures.json").read_text(encoding="utf-8"))["cycles"]
    except (frame_rates.measuring_error, OSError, ValueError, KeyError, subprocess.SubprocessError) as error:
        return {"cycles": None, "reason": str(error)}
    simulated = build / "tb" / "cosim" / f"{top}_rtl.rtl" / f"{top}.v"
    same = simulated.exists() and simulated.read_bytes() == verilog.read_bytes()
    source = "counted in Verilator, first input beat to last output beat, no pauses"
    if not same:
        source += "; on the Verilog of another clock, whose pipeline is a few stages longer or shorter"
    return {"cycles": cycles, "cycles_source": source, "pixels_per_beat": pixels, "same_verilog": same}


def rates(frame, megahertz, lut4):
    """Frames/s, million disparity evaluations a second, and the same a LUT4."""
    if frame["cycles"] is None:
        return {"frames_per_second": None, "mde_per_second": None, "mde_per_second_per_lut4": None}
    frames = megahertz * 1e6 / frame["cycles"]
    evaluations = frame["width"] * frame["height"] * frame["levels"] * frames / 1e6
    return {
        "frames_per_second": round(frames, 2),
        "mde_per_second": round(evaluations, 1),
        "mde_per_second_per_lut4": round(evaluations / lut4, 4),
    }
