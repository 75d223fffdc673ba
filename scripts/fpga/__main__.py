"""From a C++ top to an FPGA's bitstream and its figures: what scripts/fpga.sh runs."""

import argparse
import hashlib
import json
import os
import pathlib
import re
import shlex
import shutil
import signal
import statistics
import sys

import critical_path
import devices
import figures
import place_and_route
import tools
from flow_error import flow_error
from steps import check_space, digest, explain_failure, program, progress, run_programs, step_store
from whole_file import write_whole  # in scripts/, which figures.py makes known

root = pathlib.Path(__file__).resolve().parents[2]
schema = "epiline-fpga/1"
lut4_rule = {
    "ecp5": "cells after synthesis: a LUT4 counts 1, a carry cell CCU2C 2, a 16x4 RAM 6; nextpnr prints the same sum",
    "hx8k": "SB_LUT4 after synthesis; a carry sits beside the LUT of its logic cell",
}


def parse(arguments):
    parser = argparse.ArgumentParser(prog="fpga.sh", description=__doc__, allow_abbrev=False)
    parser.add_argument("top", metavar="TOP", help="a name of hls/tops, or SOURCE.cpp:TOP")
    parser.add_argument("--target", metavar="NAME", help=f"device: {', '.join(devices.targets)} (default ecp5-85k)")
    parser.add_argument("--speed", type=int, help="speed grade of an ECP5: 6, 7 or 8 (default 8, the fastest)")
    parser.add_argument("--seeds", type=int, metavar="N", help="placements to try, seeds 1 to N (default 3)")
    parser.add_argument("--seed-list", metavar="A,B,..", help="these seeds instead")
    parser.add_argument(
        "--clock", metavar="NS", help="period to reach after routing (default 6ns; a board has its own)"
    )
    parser.add_argument(
        "--hls-clock", metavar="NS", help="period that epiline-hls schedules for (default: that of --clock)"
    )
    parser.add_argument("--board", metavar="NAME", help=f"board: {', '.join(devices.boards()) or 'none'}")
    parser.add_argument("-o", "--output", metavar="FOLDER", help="default build/fpga/TOP-TARGET")
    parser.add_argument("-I", dest="include", action="append", default=[], metavar="FOLDER", help="of epiline-hls")
    parser.add_argument("-D", dest="define", action="append", default=[], metavar="NAME=VALUE", help="of epiline-hls")
    parser.add_argument("--at-once", type=int, default=2, metavar="N", help="placements at a time, 1 or 2 (default 2)")
    parser.add_argument("--width", type=int, default=640, help="of the frame that frames/s is for (default 640)")
    parser.add_argument("--height", type=int, default=480, help="likewise (default 480)")
    parser.add_argument("--levels", type=int, default=80, help="likewise (default 80)")
    parser.add_argument("--check-arguments", action="store_true", help=argparse.SUPPRESS)
    return parser.parse_args(arguments)


def nanoseconds(text, option):
    match = re.fullmatch(r"(\d+(?:\.\d+)?)(?:ns)?", text)
    if not match or not 1 <= float(match.group(1)) <= 1000:
        raise flow_error(f"{option} wants a period in nanoseconds, 1 to 1000, not '{text}'")
    return float(match.group(1))


class plan:
    """What the command line asks for, checked."""

    def __init__(self, options, caller):
        self.find_source(options.top, caller)
        self.board = devices.read_board(options.board) if options.board else None
        self.choose_device(options)
        self.seeds = self.choose_seeds(options)
        if options.at_once not in (1, 2):
            raise flow_error("--at-once must be 1 or 2")
        self.at_once = options.at_once
        for name in ("width", "height", "levels"):
            if not 1 <= getattr(options, name) <= 65535:
                raise flow_error(f"--{name} must be a number from 1 to 65535")
        self.frame = {name: getattr(options, name) for name in ("width", "height", "levels")}
        default = f"{1000 / self.board.core_clock_mhz}" if self.board else "6"
        if options.clock and self.board:
            raise flow_error(
                f"the clock of {self.board.name} is {self.board.core_clock_mhz:g} MHz, set by core_clock_mhz in "
                "its board.json; --clock is for runs without a board"
            )
        self.clock_ns = nanoseconds(options.clock or default, "--clock")
        scheduled = options.hls_clock or (self.board and self.board.hls_clock)
        self.hls_clock_ns = nanoseconds(scheduled, "--hls-clock") if scheduled else self.clock_ns
        self.hls_options = [
            word
            for flag, values in (("-I", options.include), ("-D", options.define))
            for value in values
            for word in (flag, str(caller / value) if flag == "-I" else value)
        ]
        name = f"{self.top}-{options.board or self.target}"
        self.folder = caller / options.output if options.output else root / "build" / "fpga" / name
        self.folder = pathlib.Path(os.path.abspath(self.folder))

    def find_source(self, text, caller):
        source, colon, top = text.rpartition(":")
        if colon:
            self.source, self.top = caller / source, top
            if not self.source.is_file():
                raise flow_error(f"'{self.source}' is not a file (TOP is a name of hls/tops, or SOURCE.cpp:TOP)")
        else:
            self.source, self.top = root / "hls" / "tops" / f"{text}.cpp", text
            if not re.fullmatch(r"\w+", text) or not self.source.is_file():
                known = ", ".join(sorted(file.stem for file in (root / "hls" / "tops").glob("*.cpp")))
                raise flow_error(f"unknown top '{text}' (known: {known}; or SOURCE.cpp:TOP)")
        if not re.fullmatch(r"[A-Za-z_]\w*", self.top):
            raise flow_error(f"'{self.top}' is not the name of a function")

    def choose_device(self, options):
        if self.board and (options.target or options.speed):
            raise flow_error(f"--board {options.board} names its device; leave --target and --speed out")
        self.target = self.board.target if self.board else options.target or "ecp5-85k"
        if self.target not in devices.targets:
            raise flow_error(f"unknown target '{self.target}' (known: {', '.join(devices.targets)})")
        self.device = devices.targets[self.target]
        if options.speed and options.speed not in self.device.speeds:
            speeds = ", ".join(str(speed) for speed in sorted(self.device.speeds)) or "none: it has but one"
            raise flow_error(f"unknown speed grade {options.speed} of {self.target} (known: {speeds})")
        speed = options.speed or next(iter(self.device.speeds), None)
        self.device_options = list(self.board.device_options if self.board else self.device.options)
        if speed and "--speed" not in self.device_options:
            self.device_options += ["--speed", str(speed)]
        at = self.device_options.index("--speed") if "--speed" in self.device_options else None
        self.speed = int(self.device_options[at + 1]) if at is not None else None

    @staticmethod
    def choose_seeds(options):
        if options.seeds is not None and options.seed_list is not None:
            raise flow_error("--seeds and --seed-list cannot both be there")
        if options.seed_list is not None:
            words = options.seed_list.split(",")
            if not all(re.fullmatch(r"\d{1,9}", word) for word in words) or len(set(map(int, words))) != len(words):
                raise flow_error(f"--seed-list wants different numbers, like 1,2,5, not '{options.seed_list}'")
            return [int(word) for word in words]
        number = 3 if options.seeds is None else options.seeds
        if not 1 <= number <= 100:
            raise flow_error("--seeds must be a number from 1 to 100")
        return list(range(1, number + 1))


class flow:
    """One run: every method is a step, in this order."""

    def __init__(self, wanted, build, command, report):
        self.wanted, self.build, self.command, self.report = wanted, build, command, report
        self.store = step_store(wanted.folder, report)
        self.environment = {}
        self.versions = {}

    def one_program(self, name, partial, what):
        """Runs one program of the step `name`; its failure is the end."""
        statuses = []
        run_programs([what], 1, self.report, lambda _, status, seconds: statuses.append((status, seconds)))
        if statuses[0][0] != 0:
            if name == "hls":  # a compiler's message is read whole
                print(what.log.read_text(encoding="utf-8", errors="replace").rstrip(), file=sys.stderr)
            self.store.fail(name, partial, f"{what.title} failed: {explain_failure(what.log)}")
        return statuses[0][1]

    def find_tools(self):
        family = self.wanted.device.family
        self.tools, self.versions = tools.prepare(self.report.say)
        if family == "hx8k":
            self.nextpnr, self.packer = "nextpnr-ice40", "icepack"
            self.versions = {
                "pyosys": self.versions["pyosys"],
                "nextpnr-ice40": tools.debian_version("nextpnr-ice40", "nextpnr-ice40"),
                "icepack": tools.debian_package_version("icepack", "fpga-icestorm"),
            }
        else:
            self.nextpnr, self.packer = self.tools / "bin" / "nextpnr-ecp5", self.tools / "bin" / "ecppack"
        self.compiler = self.build / "bin" / "epiline-hls"
        if not self.compiler.exists():
            raise flow_error(f"{self.compiler} is not built (EPILINE_BUILD names the build folder)")
        self.versions["epiline-hls"] = tools.run_or_fail(
            [self.compiler, "--version"], "epiline-hls does not run"
        ).strip()
        self.report.say("tools: " + ", ".join(f"{name} {version}" for name, version in self.versions.items()))

    def compile(self):
        """C++ to Verilog. It takes seconds and hangs on every header, so it is always done."""
        partial = self.store.begin("hls")
        family = self.wanted.device.family
        options = list(self.wanted.board.hls_options if self.wanted.board else ())
        command = [
            self.compiler,
            self.wanted.source,
            "--top",
            self.wanted.top,
            "--target",
            family,
            "--clock",
            f"{self.wanted.hls_clock_ns:g}ns",
            "-I",
            root / "hls",
            *self.wanted.hls_options,
            *options,
            "-o",
            partial,
        ]
        seconds = self.one_program("hls", partial, program("epiline-hls", command, partial, partial / "hls.log"))
        self.hls = self.store.finish("hls", digest(partial / f"{self.wanted.top}.v"), partial, seconds)
        self.verilog = [self.hls / f"{self.wanted.top}.v"]
        self.hls_report = json.loads((self.hls / "report.json").read_text(encoding="utf-8"))
        clock = self.hls_report["clock"]
        self.report.say(
            f"epiline-hls: {self.hls_report['depth']} stages at {clock['period_ns']:.2f} ns, "
            f"estimated {clock['estimated_period_ns']:.2f} ns"
        )
        self.module = self.wanted.top
        if self.wanted.board:
            self.wire_the_board()
        check_space(self.wanted.folder, 200 * 2**20 + 600 * self.verilog[0].stat().st_size)

    def wire_the_board(self):
        """The board's own Verilog, and the file that puts the generated top into it."""
        board = self.wanted.board
        partial = self.store.begin("board")
        built = partial / "epiline_board_build.v"
        self.one_program(
            "board",
            partial,
            program(
                "boards/make_build.py",
                [
                    sys.executable,
                    "-B",
                    root / "boards" / "make_build.py",
                    "--board",
                    board.file,
                    "--report",
                    self.hls / "report.json",
                    "-o",
                    built,
                ],
                partial,
                partial / "board.log",
            ),
        )
        folder = self.store.finish("board", digest(built), partial, 0)
        self.verilog = [*board.sources, *self.verilog, folder / built.name]
        self.module = board.top

    def synthesize(self):
        """Yosys, by the one script that does it."""
        # The script, what it runs, and how it maps cells.
        scripts = root / "scripts"
        named = re.findall(r"\bscripts/(\w+\.py)", (scripts / "synthesize.sh").read_text(encoding="utf-8"))
        flow_files = [
            scripts / "synthesize.sh",
            *(scripts / name for name in sorted(set(named))),
            *sorted(scripts.glob("*.v")),
        ]
        key = digest(
            self.module,
            self.wanted.device.family,
            self.versions["pyosys"],
            os.environ.get("YOSYS_OPTIONS", ""),
            *flow_files,
            *self.verilog,
        )
        place = self.store.kept("synthesis", key)
        if place:
            self.report.say("synthesis: kept from an earlier run")
        else:
            self.report.say("synthesis: started")
            partial = self.store.begin("synthesis")
            seconds = self.one_program(
                "synthesis",
                partial,
                program(
                    "synthesis",
                    [
                        root / "scripts" / "synthesize.sh",
                        *self.verilog,
                        self.module,
                        "-o",
                        partial,
                        "--target",
                        self.wanted.device.family,
                    ],
                    partial,
                    partial / "synthesis.log",
                    {"YOSYS": str(self.tools / "bin" / "yosys")},
                    (
                        (r"Executing (?:MEMORY_LIBMAP) pass", "mapping memories"),
                        (r"Executing ABC9? pass", "mapping logic"),
                        (r"Executing OPT_LUT_INS pass", "checking"),
                    ),
                    partial / "yosys.log",
                ),
            )
            place = self.store.finish("synthesis", key, partial, seconds)
        self.synthesis, self.synthesis_key = place, key
        self.resources = json.loads((place / "resources.json").read_text(encoding="utf-8"))
        taken = ", ".join(
            f"{self.resources[kind]} of {self.wanted.device.capacity[kind]} {devices.names[kind]}"
            for kind in ("lut4", "flip_flops", "block_rams", "multipliers")
        )
        self.report.say(f"synthesis: {taken}")

    def check_size(self):
        needed = {kind: self.resources[kind] for kind in ("lut4", "flip_flops", "block_rams", "multipliers")}
        if not self.wanted.board:
            ports = json.loads((self.synthesis / f"{self.module}.json").read_text(encoding="utf-8"))["modules"][
                self.module
            ]
            needed["pins"] = sum(len(port["bits"]) for port in ports["ports"].values())
        excess = devices.too_large(needed, self.wanted.device.capacity)
        if excess:
            raise flow_error(
                f"{self.wanted.top} is too large for {self.wanted.device.name}: it takes " + "; ".join(excess)
            )

    def count_cycles(self):
        self.frame = dict(self.wanted.frame)
        self.frame.update(
            figures.cycles_of_a_frame(
                self.build, self.wanted.top, self.hls / f"{self.wanted.top}.v", **self.wanted.frame
            )
        )
        size = "{width}x{height}, {levels} levels".format_map(self.frame)
        self.report.say(
            f"frame of {size}: {self.frame['cycles']} clocks"
            if self.frame["cycles"]
            else f"frame of {size}: clocks not measured ({self.frame['reason']})"
        )

    def place_and_route(self):
        wanted = self.wanted
        constraints = wanted.board.constraints if wanted.board else None
        netlist = self.synthesis / f"{self.module}.json"
        base = [
            self.synthesis_key,
            wanted.device_options,
            f"{1000 / wanted.clock_ns:.3f}",
            self.versions,
            *([constraints] if constraints else []),
        ]
        partials, jobs = {}, []
        for seed in wanted.seeds:
            key = digest(seed, *base)
            if self.store.kept(f"seed_{seed}", key):
                self.report.say(f"place and route, seed {seed}: kept from an earlier run")
                continue
            partial = self.store.begin(f"seed_{seed}")
            command = place_and_route.command_for(
                wanted.device.family,
                self.nextpnr,
                wanted.device_options,
                netlist,
                self.module,
                seed,
                1000 / wanted.clock_ns,
                constraints,
            )
            job = place_and_route.seed_program(command, seed, partial, {})
            partials[job.title] = (seed, key, partial)
            jobs.append(job)

        def ended(job, status, seconds):
            seed, key, partial = partials[job.title]
            if status != 0:
                text = job.log.read_text(encoding="utf-8", errors="replace")
                sentence = f"{job.title} failed: {explain_failure(job.log)}"
                if place_and_route.does_not_fit(text):
                    used = self.resources["lut4"] / wanted.device.capacity["lut4"]
                    sentence += (
                        f". The device is too full to place the design ({100 * used:.0f} % of its LUT4): "
                        f"{devices.advice['lut4']}"
                    )
                self.store.fail(f"seed_{seed}", partial, sentence)
            place = self.store.finish(f"seed_{seed}", key, partial, seconds)
            clocks = place_and_route.clocks_of(place_and_route.read_report(place))
            reached = clocks[place_and_route.core_clock(clocks)][0]
            self.report.say(f"{job.title}: {reached:.1f} MHz after {seconds:.0f} s")

        run_programs(jobs, wanted.at_once, self.report, ended)

    def read_seeds(self):
        """Figures and critical path of every seed, and which is best."""
        lines = critical_path.source_lines(self.verilog)
        attributes = critical_path.cell_attributes(self.synthesis / f"{self.module}.json")
        self.seeds = []
        for seed in self.wanted.seeds:
            name = f"seed_{seed}"
            report = place_and_route.read_report(self.wanted.folder / name)
            clocks = place_and_route.clocks_of(report)
            if not clocks:
                raise flow_error(f"nextpnr found no clock in {self.module}: there is nothing to time")
            paths = critical_path.clock_to_clock_paths(report)
            self.seeds.append(
                {
                    "seed": seed,
                    "fmax_mhz": round(clocks[place_and_route.core_clock(clocks)][0], 2),
                    "timing_reached": all(reached >= asked for reached, asked in clocks.values()),
                    "clocks": {
                        clock: {"reached_mhz": round(reached, 2), "wanted_mhz": round(asked, 2)}
                        for clock, (reached, asked) in clocks.items()
                    },
                    "seconds": self.store.seconds(name),
                    "utilisation": place_and_route.utilisation(report, self.wanted.device.family),
                    "critical_path": critical_path.in_source_lines(paths[0], lines, attributes) if paths else None,
                }
            )
        self.best = max(self.seeds, key=lambda seed: (seed["timing_reached"], seed["fmax_mhz"]))

    def pack(self):
        name = f"seed_{self.best['seed']}"
        hx8k = self.wanted.device.family == "hx8k"
        routed = self.wanted.folder / name / f"{self.module}.{'asc' if hx8k else 'config'}"
        partial = self.store.begin("bitstream")
        file = self.bitstream.name
        # Relative names: they are shown to the program wherever the folder is.
        command = [self.packer, *([] if hx8k else ["--compress"]), f"../{name}/{routed.name}", file]
        seconds = self.one_program("bitstream", partial, program("bitstream", command, partial, partial / "pack.log"))
        place = self.store.finish("bitstream", digest(routed, self.versions), partial, seconds)
        shutil.copyfile(place / file, self.bitstream.with_suffix(".partial"))
        self.bitstream.with_suffix(".partial").replace(self.bitstream)
        self.report.say(
            f"bitstream: {self.bitstream} ({self.bitstream.stat().st_size} bytes, seed {self.best['seed']})"
        )

    def result(self):
        """The run's JSON, and whether the clock was reached."""
        wanted = self.wanted
        median = round(statistics.median(seed["fmax_mhz"] for seed in self.seeds), 2)
        reached = self.best["timing_reached"]
        lut4 = self.resources["lut4"]
        text = {
            "schema": schema,
            "top": wanted.top,
            "source": str(wanted.source.relative_to(root) if wanted.source.is_relative_to(root) else wanted.source),
            "status": "ok" if reached else "failed",
            "failure": None if reached else f"no seed reached {1000 / wanted.clock_ns:.1f} MHz",
            "command": self.command,
            "tools": self.versions,
            "target": wanted.target,
            "device": wanted.device.name,
            "speed_grade": wanted.speed,
            "board": wanted.board.name if wanted.board else None,
            "verilog_sha256": hashlib.sha256((self.hls / f"{wanted.top}.v").read_bytes()).hexdigest(),
            "clock": {
                "wanted_ns": round(wanted.clock_ns, 4),
                "wanted_mhz": round(1000 / wanted.clock_ns, 2),
                "scheduled_ns": round(wanted.hls_clock_ns, 4),
                "estimated_ns": round(self.hls_report["clock"]["estimated_period_ns"], 3),
                "stages": self.hls_report["depth"],
            },
            "resources": {
                "lut4": lut4,
                "lut4_rule": lut4_rule[wanted.device.family],
                **{kind: self.resources[kind] for kind in ("flip_flops", "block_rams", "multipliers")},
                "cells": self.resources["cells"],
                "after_packing": self.best["utilisation"],
                "available": {kind: count for kind, count in wanted.device.capacity.items() if kind != "pins"},
            },
            "fmax_mhz": {
                "median": median,
                "best": max(seed["fmax_mhz"] for seed in self.seeds),
                "worst": min(seed["fmax_mhz"] for seed in self.seeds),
                "best_seed": self.best["seed"],
            },
            "timing_reached": {"best_seed": reached, "median": median >= round(1000 / wanted.clock_ns, 2)},
            "seeds": self.seeds,
            "frame": self.frame,
            **figures.rates(self.frame, median, lut4),
            "board_frames_per_second": (
                figures.rates(self.frame, wanted.board.core_clock_mhz, lut4)["frames_per_second"]
                if wanted.board
                else None
            ),
            "bitstream": {
                "file": self.bitstream.name,
                "bytes": self.bitstream.stat().st_size,
                "sha256": hashlib.sha256(self.bitstream.read_bytes()).hexdigest(),
            },
        }
        write_whole(self.result_file, json.dumps(text, indent=1) + "\n")
        return text

    def print_result(self, text):
        path = self.best["critical_path"]
        if path:
            print(
                f"\ncritical path of seed {self.best['seed']} after routing: {path['period_ns']:.2f} ns, "
                f"wanted {self.wanted.clock_ns:.2f} ns"
            )
            print("\n".join(critical_path.as_text(path)))
        by_seed = ", ".join(f"{seed['fmax_mhz']:.1f} (seed {seed['seed']})" for seed in self.seeds)
        print(
            f"\n{text['top']} on {text['device']}"
            + (f", speed grade {text['speed_grade']}" if text["speed_grade"] else "")
        )
        print(
            f"  LUT4        {text['resources']['lut4']}\n  flip-flops  {text['resources']['flip_flops']}\n"
            f"  block RAMs  {text['resources']['block_rams']}\n  multipliers {text['resources']['multipliers']}\n"
            f"  fmax        {text['fmax_mhz']['median']:.1f} MHz median; {by_seed}"
        )
        if text["frames_per_second"]:
            print(
                f"  frames/s    {text['frames_per_second']:.1f} at {self.frame['width']}x{self.frame['height']}, "
                f"{self.frame['levels']} levels ({self.frame['cycles']} clocks a frame)\n"
                f"  MDE/s       {text['mde_per_second']:.0f}, {text['mde_per_second_per_lut4']:.3f} per LUT4"
            )
        else:
            print(f"  frames/s    not known: {self.frame['reason']}")
        print(f"  figures     {self.result_file}\n  bitstream   {self.bitstream}")
        if self.wanted.board:
            if text["board_frames_per_second"]:
                print(
                    f"  on the board at {self.wanted.board.core_clock_mhz:g} MHz: "
                    f"{text['board_frames_per_second']:.1f} frames/s"
                )
            print(f"\nload it:  openFPGALoader --board={self.wanted.board.loader_name} {self.bitstream}")

    def remove_results(self):
        """Of an earlier run: if this one fails, they must not pass for its own."""
        suffix = f"_{self.wanted.board.name}" if self.wanted.board else ""
        kind = "bin" if self.wanted.device.family == "hx8k" else "bit"
        self.bitstream = self.wanted.folder / f"{self.wanted.top}{suffix}.{kind}"
        self.result_file = self.wanted.folder / f"{self.wanted.top}.json"
        for file in (self.bitstream, self.result_file):
            file.unlink(missing_ok=True)

    def run(self):
        try:
            self.remove_results()
            check_space(self.wanted.folder, 200 * 2**20)
            for step in (
                self.find_tools,
                self.compile,
                self.synthesize,
                self.check_size,
                self.count_cycles,
                self.place_and_route,
                self.read_seeds,
                self.pack,
            ):
                step()
            text = self.result()
            self.print_result(text)
        finally:
            self.store.close()
        if text["status"] != "ok":
            raise flow_error(
                f"timing: {text['failure']}; the best, seed {self.best['seed']}, has "
                f"{self.best['fmax_mhz']:.1f} MHz. The path above limits it: shorten it in the source, or ask "
                f"for a longer --clock ({1000 / text['fmax_mhz']['median']:.2f} ns is what the median seed has)"
            )


def without_output(arguments):
    """The command line that repeats the figures, wherever they are to go."""
    kept, words = [], iter(arguments)
    for word in words:
        if word in ("-o", "--output"):
            next(words, None)
        else:
            kept.append(word)
    return shlex.join(["scripts/fpga.sh", *kept])


def interrupted(_signal, _frame):
    raise KeyboardInterrupt


def main(arguments):
    options = parse(arguments)
    signal.signal(signal.SIGTERM, interrupted)
    caller = pathlib.Path(os.environ.get("EPILINE_CALLER") or os.getcwd())
    build = pathlib.Path(os.environ.get("EPILINE_BUILD") or root / "build")
    try:
        wanted = plan(options, caller)
        if options.check_arguments:
            return 0
        flow(wanted, build if build.is_absolute() else caller / build, without_output(arguments), progress()).run()
    except flow_error as error:
        print(f"fpga.sh: error: {error}", file=sys.stderr)
        return 1
    except OSError as error:
        full = "the disk is full: " if error.errno == 28 else ""
        print(f"fpga.sh: error: {full}{error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("fpga.sh: interrupted; finished steps are kept, the same command goes on from there", file=sys.stderr)
        return 130
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
