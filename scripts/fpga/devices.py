"""The devices the flow knows, and the boards."""

import dataclasses
import json
import pathlib
import re

from flow_error import flow_error

root = pathlib.Path(__file__).resolve().parents[2]


@dataclasses.dataclass(frozen=True)
class device:
    """One FPGA as nextpnr names it. `capacity` is what nextpnr reports as available (of pins: pads of the die)."""

    name: str
    family: str  # ecp5 or hx8k: the name that epiline-hls and scripts/synthesize.sh know
    options: tuple  # of nextpnr, without the speed grade
    speeds: tuple  # speed grades, the usual one first; none where the device has but one
    capacity: dict


def ecp5(name, luts, block_rams, multipliers, pins):
    return device(
        f"LFE5U-{name.upper()}F in CABGA381",
        "ecp5",
        (f"--{name}k", "--package", "CABGA381"),
        (8, 7, 6),
        {"lut4": luts, "flip_flops": luts, "block_rams": block_rams, "multipliers": multipliers, "pins": pins},
    )


targets = {
    "ecp5-85k": ecp5("85", 83640, 208, 156, 365),
    "ecp5-45k": ecp5("45", 43848, 108, 72, 245),
    "ecp5-25k": ecp5("25", 24288, 56, 28, 197),
    "ecp5-12k": ecp5("12", 24288, 56, 28, 197),
    "hx8k": device(
        "iCE40HX8K in CT256",
        "hx8k",
        ("--hx8k", "--package", "ct256"),
        (),
        {"lut4": 7680, "flip_flops": 7680, "block_rams": 32, "multipliers": 0, "pins": 256},
    ),
}

# What each thing that runs out is called, and what makes it less.
names = {
    "lut4": "LUT4",
    "flip_flops": "flip-flops",
    "block_rams": "block RAMs",
    "multipliers": "multipliers",
    "pins": "pins",
}
logic_advice = (
    "fewer `levels`, fewer `pixels_per_beat`, or `parallel_disparities` below `levels` (several clocks a pixel)"
)
advice = {
    "lut4": logic_advice,
    "flip_flops": logic_advice + "; a longer --clock also needs fewer pipeline registers",
    "block_rams": "a smaller `max_width` (the line and column memories), fewer `levels`, or `parallel_disparities` "
    "below `levels`",
    "multipliers": "constant factors, which need none",
    "pins": "fewer `pixels_per_beat`, or epiline-hls --axi-lite, which puts scalar arguments behind a bus; on a board "
    "the streams end inside the device",
}


def too_large(needed, capacity):
    """Sentences, one for each resource that `needed` takes more of than there is."""
    return [
        f"{needed[kind]} of {capacity[kind]} {names[kind]}, {needed[kind] - capacity[kind]} too many: "
        f"what helps is {advice[kind]}"
        for kind in capacity
        if needed.get(kind, 0) > capacity[kind]
    ]


@dataclasses.dataclass(frozen=True)
class board:
    """What boards/NAME/board.json says. Paths are absolute."""

    name: str
    file: pathlib.Path  # board.json itself
    top: str  # the Verilog module of the whole board
    sources: tuple
    constraints: pathlib.Path
    device_options: tuple  # of nextpnr, with the speed grade
    target: str  # of `targets`
    core_clock_mhz: float
    hls_clock: str  # what the top is scheduled for, or nothing: then it is the core clock
    hls_options: tuple  # others of epiline-hls
    loader_name: str  # what openFPGALoader calls the board


def boards():
    """{name as typed: folder}"""
    return {file.parent.name.replace("_", "-"): file.parent for file in sorted((root / "boards").glob("*/board.json"))}


def read_board(name):
    known = boards()
    folder = known.get(name.replace("_", "-"))
    if folder is None:
        raise flow_error(f"unknown board '{name}' (known: {', '.join(known) or 'none'})")
    file = folder / "board.json"
    try:
        text = json.loads(file.read_text(encoding="utf-8"))
        options = tuple(str(word) for word in text["device_options"])
        size = next((option[2:] for option in options if re.fullmatch(r"--\d+k", option)), None)
        target = f"ecp5-{size}" if size else "hx8k"
        if target not in targets:
            raise ValueError(f"device_options name no device that is known ({', '.join(targets)})")
        hls_options = [str(word) for word in text.get("hls_options", ())]
        single = {}
        for option in ("--clock", "--target"):
            if option in hls_options:
                at = hls_options.index(option)
                single[option] = hls_options[at + 1]
                del hls_options[at : at + 2]
        if single.get("--target", targets[target].family) != targets[target].family:
            raise ValueError("hls_options and device_options name different devices")
        found = board(
            text["name"],
            file,
            text["top"],
            tuple(folder / source for source in text["sources"]),
            folder / text["constraints"],
            options,
            target,
            float(text["core_clock_mhz"]),
            single.get("--clock", ""),
            tuple(hls_options),
            text.get("loader_name", text["name"].rpartition("_")[0] or text["name"]),
        )
    except (OSError, ValueError, KeyError, IndexError, TypeError) as error:
        raise flow_error(f"{file}: {type(error).__name__}: {error}") from error
    missing = [str(path) for path in (*found.sources, found.constraints) if not path.is_file()]
    if missing:
        raise flow_error(f"{file} names {', '.join(missing)}, which is not there")
    return found
