#!/usr/bin/env python3
"""Compiles many programs with epiline-hls and compares native = dataflow graph = RTL, with few Verilator builds.

  run_batch.py [options] kernels NAME...         tests/compiler/kernels/NAME.cpp with their drivers
  run_batch.py [options] regressions NAME...     tests/compiler/regressions/NAME.cpp with their drivers
  run_batch.py [options] random FIRST COUNT      programs of random_program.py, seeds FIRST to FIRST + COUNT - 1
  run_batch.py [options] files FOLDER NAME...    FOLDER/NAME.cpp with FOLDER/NAME.drive.cpp, as random_program.py writes them

Prints one line a failure, which names the program's file, the level (compiler, native, graph, RTL) and the first differing
token, and a summary. Exit code 1 if anything failed.
"""

import argparse
import concurrent.futures
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import time

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
sys.path.insert(0, str(HERE))

import random_program  # noqa: E402
import verilator_group  # noqa: E402
from kernel_options import options_of  # noqa: E402

COMPILER_SECONDS = 60
NATIVE_SECONDS = 120
# Random programs in one translation unit, of a native compiler or of epiline-hls: what costs is compiling ap_int's operators
# for each pair of widths, and two hundred programs have far less than twice as many as a hundred.
UNIT = 200
# Every so manieth random program is made with a schedule drawn at random from the legal ones.
RANDOM_SCHEDULE_EVERY = 4
# Every so manieth random program also goes through Icarus Verilog and the interpreter after each pass (--check), which is a
# compilation of its own.
CHECK_EVERY, CHECK_LEVELS = 25, "passes,rtl-icarus"


def seed_of(name):
    """The seed of a random program; None for others."""
    return int(name.split("_")[1]) if re.fullmatch(r"random_[0-9]+", name) else None


def units(names):
    return [names[i:i + UNIT] for i in range(0, len(names), UNIT)]


def without_blamed(names, messages):
    """Several programs of which one does not compile, in pieces to try again: each that an error names by itself, and the
    rest; or, when that leads nowhere, halves."""
    errors = "\n".join(line for line in messages.splitlines() if "error" in line)
    blamed = [n for n in names if re.search(rf"\b{n}(\.drive)?\.cpp:", errors)]
    rest = [n for n in names if n not in blamed]
    if blamed and rest:
        return [[n] for n in blamed] + [rest]
    return [names[:len(names) // 2], names[len(names) // 2:]]


class Batch:
    def __init__(self, options):
        self.options = options
        self.work = pathlib.Path(options.work).resolve()
        self.failures = []
        self.notes = []
        self.sources = {}  # name -> source file
        self.features = {}  # name -> what is in a random program
        self.compiled_with = {}  # name -> options of epiline-hls
        self.refusals = {}  # name -> what epiline-hls said of a program among others
        self.started = time.monotonic()
        self.folder_of_headers = pathlib.Path(options.precompiled or self.work / "precompiled").resolve()
        if not options.graph_only:
            self.builder = verilator_group.Builder(options.cxx, options.model_flags, options.verilated,
                                                   self.folder_of_headers)

    def fail(self, name, level, text):
        self.failures.append((name, level, text))
        source = self.sources.get(name)
        print(f"FAILED {name}: {level}: {text}" + (f"\n    program: {source}" if source else ""), flush=True)

    def stage(self, text):
        processor = sum(os.times()[:4])
        print(f"[{time.monotonic() - self.started:6.1f} s, {processor:.1f} s of processor] {text}", flush=True)

    def parallel(self, function, items):
        with concurrent.futures.ThreadPoolExecutor(self.options.jobs) as pool:
            return list(pool.map(function, items))

    def write_json(self, file, names):
        """What happened to each program: {"programs": {NAME: {"features": {...}, "level", "text"}}, "notes", ...}."""
        used = os.times()
        programs = {}
        for name in names:
            programs[name] = {"features": sorted(" ".join(f).strip() for f in self.features.get(name, {}))}
        for name, level, text in self.failures:
            programs.setdefault(name, {}).update({"level": level, "text": text})
        pathlib.Path(file).write_text(json.dumps({"programs": programs, "notes": self.notes,
                                                  "seconds": time.monotonic() - self.started,
                                                  "processor_seconds": sum(used[:4])}), encoding="utf-8")

    # ---- native -------------------------------------------------------------------------------------------------
    def native_flags(self):
        return ["-std=c++20", "-w", "-O0", f"-I{ROOT / 'hls' / 'types'}", f"-I{HERE}"]

    def precompiled(self, compiler, extra):
        """The options that make `compiler` take what every driver includes from a precompiled header."""
        is_clang = "clang" in pathlib.Path(compiler).name
        header = self.folder_of_headers / re.sub(r"\W", "_", " ".join([compiler, *extra])) / "drive.hpp"
        made = header.with_name("drive.hpp.pch" if is_clang else "drive.hpp.gch")
        if not made.exists():
            header.parent.mkdir(parents=True, exist_ok=True)
            header.write_text(f'#include "{HERE / "drive.hpp"}"\n', encoding="utf-8")
            part = made.with_suffix(f".{os.getpid()}")
            subprocess.run([compiler, *self.native_flags(), *extra, *verilator_group.as_header(compiler), str(header), "-o",
                            str(part)],
                           check=True)
            part.rename(made)
        return ["-include-pch", str(made)] if is_clang else ["-include", str(header)]

    def run_native(self, names):
        """Token files of kernels and regressions, by the driver program CMake built."""
        tokens = self.work / "tokens"
        tokens.mkdir(parents=True, exist_ok=True)
        run = subprocess.run([self.options.drivers, str(tokens)] + names, capture_output=True, text=True, check=False)
        if run.returncode != 0:
            self.fail("drivers", "native", run.stderr.strip() or f"exit code {run.returncode}")
        return [n for n in names if (tokens / f"{n}.tokens").exists()]

    def build_random(self, names, compiler, tokens, extra=()):
        """Compiles the drivers of random programs in few translation units and writes their token files."""
        folder = self.work / "programs"
        tokens.mkdir(parents=True, exist_ok=True)
        build = self.work / ("native_" + re.sub(r"\W", "_", pathlib.Path(compiler).name))
        build.mkdir(exist_ok=True)
        header = self.precompiled(compiler, extra)

        def compile_source(stem, text):
            source = build / f"{stem}.cpp"
            source.write_text(text, encoding="utf-8")
            run = subprocess.run([compiler, *header, *self.native_flags(), *extra, f"-I{folder}", "-c", str(source), "-o",
                                  str(source.with_suffix(".o"))], capture_output=True, text=True, check=False)
            return run, str(source.with_suffix(".o"))

        def compile_part(part):
            """The objects of a part and the programs in them."""
            run, made = compile_source(f"part_{part[0]}", "".join(f'#include "{n}.drive.cpp"\n' for n in part))
            if run.returncode == 0:
                return [made], part
            if len(part) == 1:
                lines = [l for l in run.stderr.splitlines() if "error" in l][:3]
                self.fail(part[0], "native", f"{compiler}: does not compile: " + "; ".join(lines))
                return [], []
            pieces = [compile_part(piece) for piece in without_blamed(part, run.stderr)]
            return sum((p[0] for p in pieces), []), sum((p[1] for p in pieces), [])

        parts = self.parallel(compile_part, units(names))
        main = pathlib.Path(header[1]).with_name("main.o")  # the same for every batch
        if not main.exists():
            run, made = compile_source("main", f'#include "{HERE / "drive_main.cpp"}"\n')
            if run.returncode != 0:
                self.fail("drive_main", "native", run.stderr.strip()[-400:])
                return []
            pathlib.Path(made).rename(main)
        names = sum((p[1] for p in parts), [])
        program = build / "drivers"
        subprocess.run([compiler, *extra, *sum((p[0] for p in parts), []), str(main), "-o", str(program)], check=True)

        def drive(*only):
            """What went wrong, or nothing."""
            try:
                run = subprocess.run(["prlimit", f"--cpu={NATIVE_SECONDS}:{NATIVE_SECONDS + 5}", str(program), str(tokens), *only],
                                     capture_output=True, text=True, timeout=30 * NATIVE_SECONDS, check=False)
            except subprocess.TimeoutExpired:
                run = None
            if run is None or run.returncode == -signal.SIGXCPU:
                return f"runs for more than {NATIVE_SECONDS} s"
            return "" if run.returncode == 0 else run.stderr.strip()[-400:] or f"exit code {run.returncode}"

        if not drive():
            return list(names)
        good = []  # One of them stopped the program: find out which.
        for name in names:
            problem = drive(name)
            if problem:
                self.fail(name, "native", f"{compiler}: {problem}")
            else:
                good.append(name)
        return good

    # ---- the compiler -------------------------------------------------------------------------------------------
    def options_of(self, name):
        """The options that a program is to be compiled with."""
        seed = seed_of(name)
        is_random = seed is not None and seed % RANDOM_SCHEDULE_EVERY == 0
        return options_of(self.sources[name]), ["--schedule", "random"] if is_random else []

    def limited(self, *arguments):
        """A run of epiline-hls; None if it took too long. Processor time counts: the machine may be busy otherwise."""
        command = ["prlimit", f"--cpu={COMPILER_SECONDS}:{COMPILER_SECONDS + 5}", self.options.compiler, *arguments]
        try:
            run = subprocess.run(command, capture_output=True, text=True, timeout=30 * COMPILER_SECONDS, check=False)
        except subprocess.TimeoutExpired:
            return None
        return None if run.returncode == -signal.SIGXCPU else run

    def compile_together(self, names):
        """Compiles random programs of one kind as the tops of one source, for which clang runs once. Leaves the folders of
        those that went well; the others have to be compiled alone."""
        if len(names) == 1:
            return
        texts = {n: self.sources[n].read_text(encoding="utf-8") for n in names}
        includes = sorted({line for text in texts.values() for line in text.splitlines() if line.startswith("#include")})
        source = self.work / "together" / f"{names[0]}.cpp"
        source.parent.mkdir(exist_ok=True)
        source.write_text("\n".join(includes + [f'namespace program_{n} {{\n#include "{self.sources[n]}"\n}}' for n in names])
                          + "\n", encoding="utf-8")
        tops = sum((["--top", f"program_{n}::{n}"] for n in names), [])
        run = self.limited(str(source), *tops, "-o", str(self.work / "rtl"), "-q", *sum(self.options_of(names[0]), []))
        if run is None:
            return
        if any(self.is_compiled(n) for n in names):
            messages = re.split(r"(?m)^(?=note: |\S+: error: )", run.stderr)
            for name in names:
                said = [m for m in messages if re.match(rf"\S*\b{name}\.cpp:\d+: error: ", m)]
                if len(said) == 1 and not self.is_compiled(name):
                    self.refusals[name] = said[0].strip()
        else:  # it did not come to the first top
            for piece in without_blamed(names, run.stderr):
                self.compile_together(piece)

    def is_compiled(self, name):
        return (self.work / "rtl" / name / "report.json").exists()

    def compile_programs(self, names):
        """Compiles all programs and returns those that went well."""
        for name in names:
            shutil.rmtree(self.work / "rtl" / name, ignore_errors=True)
        if self.options.what in ("random", "files"):
            kinds = {}
            for name in names:
                kinds.setdefault(str(self.options_of(name)), []).append(name)
            self.parallel(self.compile_together, sum((units(kind) for kind in kinds.values()), []))
        return [n for n in self.parallel(self.compile_program, names) if n]

    def compile_program(self, name):
        """Compiles a program alone, if that is to be done, and returns its name if that went well."""
        source = self.sources[name]
        options, schedule = self.options_of(name)
        folder = self.work / "rtl" / name
        if self.is_compiled(name):
            self.compiled_with[name] = [*options, *schedule]
            return name
        text = ""
        for attempt in range(3):
            arguments = [str(source), "--top", name, "-o", str(folder), *options, *schedule]
            code, text = 1, self.refusals.pop(name, "")  # what was said when it was compiled with others
            if not text:
                run = self.limited(*arguments)
                if run is None:
                    self.fail(name, "compiler", f"takes more than {COMPILER_SECONDS} s: {' '.join(arguments)}")
                    return None
                code, text = run.returncode, (run.stderr + run.stdout).strip()
            if code == 0:
                self.compiled_with[name] = [*options, *schedule]
                return name
            # A period that is too short: the compiler says which one would do, or how many clocks an iteration needs, and
            # that has to do.
            smallest = re.search(r"smallest period possible[^:]*: ([0-9.]+) ns", text)
            interval = re.search(r"smallest initiation interval possible[^:]*: ([0-9]+)", text)
            if not self.options.retry or (not smallest and not interval):
                break
            if smallest and attempt == 0:
                options = ["--clock", f"{smallest.group(1)}ns"]
            elif interval and "--ii" not in options:  # a state that goes through a RAM's address and back
                options += ["--ii", interval.group(1)]
            else:
                break
            self.notes.append(f"{name}: {' '.join(options)}")
        outcome = f"exit code {code}" if 0 <= code < 128 else f"crashed ({code})"
        self.fail(name, "compiler", f"{outcome}: {text[:700]}\n    command: epiline-hls {' '.join(arguments)}")
        return None

    # ---- RTL ----------------------------------------------------------------------------------------------------
    def check_group(self, item):
        index, names = item
        tokens, rtl = self.work / "tokens", self.work / "rtl"
        models = []
        if not self.options.graph_only:
            try:
                folder = self.work / "groups" / f"group_{index}"
                shutil.rmtree(folder, ignore_errors=True)
                verilator_group.write(folder, rtl, names)
                problem = self.builder.build(folder, [str(rtl / name / f"{name}.v") for name in names])
            except (subprocess.CalledProcessError, OSError, KeyError, ValueError) as error:
                problem = f"{type(error).__name__}: {error}"
            if problem:
                if len(names) > 1:  # find the module that is to blame, test the others
                    half = len(names) // 2
                    return self.check_group((f"{index}a", names[:half])) + self.check_group((f"{index}b", names[half:]))
                self.fail(names[0], "RTL", problem)
            else:
                models = [str(folder / "models.so")]
        run = subprocess.run([self.options.checker, str(tokens), str(rtl), *models,
                              *(f"{n}@{self.interval(n)}" for n in names)], capture_output=True, text=True, check=False)
        bad = set()
        for line in run.stdout.splitlines():
            name, _, rest = line.partition(": ")
            level, _, text = rest.partition(": ")
            if level == "iterations":
                text = self.too_many_iterations(name, int(text))
                if not text:
                    continue
            bad.add(name)
            self.fail(name, level, text)
        if run.returncode not in (0, 1):
            self.fail(" ".join(names), "check", f"exit code {run.returncode}: {run.stderr.strip()}")
            return []
        return [n for n in names if n not in bad]

    def interval(self, name):
        """Clocks from one iteration to the next."""
        report = json.loads((self.work / "rtl" / name / "report.json").read_text(encoding="utf-8"))
        return report["initiation_interval"]

    def too_many_iterations(self, name, iterations):
        """A source may promise `// one iteration a token of PORT`; a few more may begin and end a call."""
        match = re.search(r"// one iteration a token of (\w+)", self.sources[name].read_text(encoding="utf-8"))
        if not match:
            return ""
        tokens, counting, calls = 0, False, 1
        for line in (self.work / "tokens" / f"{name}.tokens").read_text(encoding="utf-8").splitlines():
            words = line.split()
            if words[0] == "port":
                counting = words[1] == match.group(1)
                in_calls = words[3] == "call"
            else:
                tokens += counting
                calls += in_calls
        if iterations <= tokens * 1.03 + 2 * calls:
            return ""
        return f"{iterations} iterations for {tokens} tokens of {match.group(1)}"

    def check(self, names):
        names = self.compile_programs(names)
        self.stage(f"{len(names)} compiled to Verilog")
        size = self.options.group
        groups = [(i // size, names[i:i + size]) for i in range(0, len(names), size)]
        good = sum(self.parallel(self.check_group, groups), [])
        self.stage("simulated")
        every = [n for n in good if seed_of(n) is not None and seed_of(n) % CHECK_EVERY == 0]
        bad = set() if self.options.graph_only else {n for n, is_good in zip(every, self.parallel(self.check_more, every))
                                                     if not is_good}
        if every:
            self.stage(f"{len(every)} checked by {CHECK_LEVELS}")
        return [n for n in good if n not in bad]

    def check_more(self, name):
        """Whether the program is equal at the levels that are too slow for each; with the tokens of its native run."""
        folder = self.work / "check" / name
        shutil.rmtree(folder, ignore_errors=True)
        command = [self.options.compiler, str(self.sources[name]), "--top", name, "-o", str(folder),
                   *self.compiled_with[name], "--check", "--levels", CHECK_LEVELS, "--recorded", "--stimulus",
                   str(self.work / "tokens" / f"{name}.tokens")]
        run = subprocess.run(command, capture_output=True, text=True, check=False)
        if run.returncode == 0:
            return True
        text = (run.stderr + run.stdout).strip()
        self.fail(name, "check", f"{text[:700]}\n    command: {' '.join(command)}")
        return False


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--compiler", required=True, help="epiline-hls")
    parser.add_argument("--checker", required=True, help="compiler_check_levels")
    parser.add_argument("--verilated", default="", help="archive of Verilator's run-time library")
    parser.add_argument("--drivers", default="", help="program of the kernels' drivers")
    parser.add_argument("--work", required=True, help="folder for everything that is made")
    parser.add_argument("--cxx", default="clang++-19")
    parser.add_argument("--also-native", default="", help="a second C++ compiler: its native run must write the same tokens")
    parser.add_argument("--model-flags", default="-O1")
    parser.add_argument("--precompiled", default="", help="folder of precompiled headers, made where missing")
    parser.add_argument("--json", default="", help="file for what happened to each program")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--group", type=int, default=25, help="modules in one Verilator build")
    parser.add_argument("--graph-only", action="store_true", help="without RTL")
    parser.add_argument("--no-retry", dest="retry", action="store_false",
                        help="a period that is too short is a failure, even if the compiler names one that would do")
    parser.add_argument("--sanitize", action="store_true", help="native runs with the undefined behaviour sanitizer")
    parser.add_argument("what", choices=["kernels", "regressions", "random", "files"])
    parser.add_argument("names", nargs="+")
    options = parser.parse_args()
    batch = Batch(options)
    batch.work.mkdir(parents=True, exist_ok=True)
    if not options.precompiled:  # made of headers that may have changed since
        shutil.rmtree(batch.work / "precompiled", ignore_errors=True)

    if options.what in ("random", "files"):
        folder = batch.work / "programs"
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
        if options.what == "random":
            first, count = (int(n) for n in options.names)
            names = [f"random_{seed}" for seed in range(first, first + count)]
            for seed in range(first, first + count):
                batch.features[f"random_{seed}"] = random_program.write(seed, folder)
        else:
            names = options.names[1:]
            for name in names:
                for file in (f"{name}.cpp", f"{name}.drive.cpp"):
                    shutil.copy(pathlib.Path(options.names[0]) / file, folder)
        batch.sources = {n: folder / f"{n}.cpp" for n in names}
        extra = []
        if options.sanitize:
            extra = ["-fsanitize=undefined", "-fno-sanitize-recover=all"]
            if "clang" in options.cxx:  # what is read before it is written differs from the other compiler's
                extra.append("-ftrivial-auto-var-init=pattern")
        shutil.rmtree(batch.work / "tokens", ignore_errors=True)
        ready = batch.build_random(names, options.cxx, batch.work / "tokens", extra)
        if options.also_native:
            other = batch.work / "tokens_other"
            shutil.rmtree(other, ignore_errors=True)
            agreeing = set(batch.build_random(ready, options.also_native, other))
            for name in sorted(agreeing):
                if (other / f"{name}.tokens").read_bytes() != (batch.work / "tokens" / f"{name}.tokens").read_bytes():
                    batch.fail(name, "native", f"{options.cxx} and {options.also_native} disagree")
                    agreeing.remove(name)
            ready = [n for n in ready if n in agreeing]
    else:
        names = options.names
        batch.sources = {n: HERE / options.what / f"{n}.cpp" for n in names}
        shutil.rmtree(batch.work / "tokens", ignore_errors=True)
        ready = batch.run_native(names)
    batch.stage(f"{len(ready)} ran natively")
    good = batch.check(ready)
    for note in batch.notes:
        print(f"note: not as asked but with {note}")
    print(f"{len(good)} of {len(names)} equal: native = graph" + ("" if options.graph_only else " = RTL"))
    if options.json:
        batch.write_json(options.json, names)
    sys.exit(0 if len(good) == len(names) and not batch.failures else 1)


if __name__ == "__main__":
    main()
