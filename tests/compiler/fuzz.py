#!/usr/bin/env python3
"""Runs many random programs through every level of the compiler, for as long as it takes. Called by scripts/fuzz.sh.

Seeds go in batches through run_batch.py. A finished batch leaves a file in the state folder, under a key of everything that
its outcome depends on: the compiler, the generator, the types, the tests' own programs. So a run that was stopped goes on where
it was, and one with another compiler begins anew. A program that fails is kept with its driver in `failures`.
"""

import argparse
import collections
import concurrent.futures
import fcntl
import hashlib
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import threading
import time

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
LEVELS = ("native", "refused", "crashed", "graph", "RTL", "check")


def programs_of(build):
    """What run_batch.py needs of a build folder."""
    return {"compiler": build / "bin" / "epiline-hls", "checker": build / "bin" / "compiler_check_levels",
            "verilated": build / "tb" / "cosim" / "libepiline_verilated.a"}


def key_of(build):
    """A name for everything that decides what becomes of a seed."""
    files = list(programs_of(build).values())
    files += [HERE / name for name in ("random_program.py", "run_batch.py", "kernel_options.py", "verilator_group.py",
                                       "group_model.hpp", "drive.hpp", "drive_main.cpp")]
    files += sorted((HERE / "generator").glob("*.py")) + sorted((ROOT / "hls" / "types").rglob("*.h"))
    files += sorted((ROOT / "tb" / "cosim").glob("*.hpp"))
    digest = hashlib.sha256()
    for file in files:
        digest.update(file.read_bytes())
    return digest.hexdigest()[:12]


def level_of(program):
    """Where a program failed, or None: the compiler's refusals are not its crashes."""
    if program.get("level") != "compiler":
        return program.get("level")
    return "refused" if program["text"].startswith("exit code 1:") else "crashed"


def kind_of(text):
    """A message without what differs from program to program: places, names, numbers."""
    line = next((l for l in text.splitlines() if "error:" in l), text.splitlines()[0] if text else "")
    line = re.sub(r"^.*?error: ", "", line)
    line = re.sub(r"'[^']*'", "'...'", line)
    line = re.sub(r"/\S+", "FILE", line)
    return re.sub(r"[0-9][0-9.]*", "N", line)[:160]


def statistics(results, jobs):
    """What the finished batches say together, as written to statistics.json (docs/fuzzing.md)."""
    levels, refusals = collections.Counter(), collections.Counter()
    features = collections.defaultdict(collections.Counter)
    programs = notes = 0
    failed = {level: [] for level in LEVELS}
    for result in results:
        notes += len(result["notes"])
        for name, program in result["programs"].items():
            programs += 1
            level = level_of(program)
            levels[level] += 1
            if level:
                failed.setdefault(level, []).append(name)
            if level in ("refused", "crashed"):
                refusals[kind_of(program["text"])] += 1
            for feature in program.get("features", []):
                name_of_feature, _, where = feature.rpartition(" ")
                if re.fullmatch(r"[0-9]+(-[0-9]+)?[su]?", where) and name_of_feature:
                    features[name_of_feature][where] += 1
                else:
                    features[feature]["any"] += 1
    processor = sum(r["processor_seconds"] for r in results)
    return {
        "programs": programs,
        "equal": levels[None],
        "failures": {level: levels[level] for level in LEVELS},
        "failed": {level: sorted(names, key=lambda n: (len(n), n)) for level, names in failed.items() if names},
        "messages": dict(refusals.most_common()),
        "other_period_or_interval": notes,
        "processor_seconds": round(processor, 1),
        "programs_per_second_on_two_cores": round(2 * programs / processor, 2) if processor else 0,
        "jobs": jobs,
        "features": {f: dict(sorted(w.items())) for f, w in sorted(features.items())},
    }


class Fuzzer:
    def __init__(self, options):
        self.options = options
        built = pathlib.Path(options.build).resolve()
        self.state = pathlib.Path(options.state).resolve() / key_of(built)
        self.build = self.state / "build"  # copies: the build folder may go on to another version
        for file in programs_of(built).values():
            copy = self.build / file.relative_to(built)
            if not copy.exists():
                copy.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(file, copy.with_suffix(".part"))
                copy.with_suffix(".part").rename(copy)
        (self.state.parent / "latest").unlink(missing_ok=True)
        (self.state.parent / "latest").symlink_to(self.state.name)
        self.lock = open(self.state / "lock", "w", encoding="utf-8")
        try:
            fcntl.flock(self.lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            sys.exit(f"fuzz: error: another run is at work in {self.state}: wait for it, or choose another --state")
        self.running = set()
        self.stopping = threading.Event()
        self.guard = threading.Lock()

    def batches(self):
        first, end = self.options.seed, self.options.seed + self.options.programs
        return [(s, min(self.options.batch, end - s)) for s in range(first, end, self.options.batch)]

    def file_of(self, batch):
        return self.state / f"batch_{batch[0]}_{batch[1]}.json"

    def command(self, work, *what):
        return [sys.executable, str(HERE / "run_batch.py"),
                *(f"--{name}={path}" for name, path in programs_of(self.build).items()),
                "--cxx", "clang++-19", "--also-native", "g++", "--precompiled", str(self.state / "precompiled"),
                "--work", str(work), *what]

    def run(self, batch):
        """Runs a batch and leaves its file; nothing if the run is being stopped."""
        if self.stopping.is_set():
            return
        work = self.state / "work" / f"batch_{batch[0]}"
        shutil.rmtree(work, ignore_errors=True)
        work.mkdir(parents=True)
        result = work / "result.json"
        with open(work / "log", "w", encoding="utf-8") as log:
            process = subprocess.Popen(
                self.command(work, "--jobs", "1", "--model-flags=-O0", "--group", str(self.options.group), "--json",
                             str(result), "random", str(batch[0]), str(batch[1])),
                stdout=log, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL, start_new_session=True)
            with self.guard:
                self.running.add(process)
            if self.stopping.is_set():
                self.kill(process)
            process.wait()
            with self.guard:
                self.running.discard(process)
        if self.stopping.is_set():
            shutil.rmtree(work, ignore_errors=True)
            return
        if not result.exists():
            raise RuntimeError(f"run_batch.py failed: see {work / 'log'}")
        outcome = json.loads(result.read_text(encoding="utf-8"))
        failed = {n: p for n, p in outcome["programs"].items() if level_of(p)}
        for name, program in failed.items():
            self.keep(work, name, program)
        part = self.file_of(batch).with_suffix(".part")
        part.write_text(json.dumps(outcome), encoding="utf-8")
        part.rename(self.file_of(batch))
        shutil.rmtree(work, ignore_errors=True)

    def keep(self, work, name, program):
        folder = self.state / "failures" / name
        folder.mkdir(parents=True, exist_ok=True)
        for file in (f"{name}.cpp", f"{name}.drive.cpp"):
            if (work / "programs" / file).exists():
                shutil.copy(work / "programs" / file, folder)
        (folder / "failure.json").write_text(
            json.dumps({"level": level_of(program), "text": program["text"], "kind": kind_of(program["text"])}, indent=1),
            encoding="utf-8")
        print(f"\nFAILED {name}: {level_of(program)}: {kind_of(program['text'])}\n    program: {folder}", flush=True)

    @staticmethod
    def kill(process):
        try:
            os.killpg(process.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass

    def stop(self, *_):
        self.stopping.set()
        for process in list(self.running):
            self.kill(process)

    def results(self):
        return [json.loads(self.file_of(b).read_text(encoding="utf-8")) for b in self.batches() if self.file_of(b).exists()]

    def write_statistics(self):
        found = statistics(self.results(), self.options.jobs)
        found = {"seeds": [self.options.seed, self.options.seed + self.options.programs - 1], "key": self.state.name, **found}
        part = self.state / "statistics.part"
        part.write_text(json.dumps(found, indent=1) + "\n", encoding="utf-8")
        part.rename(self.state / "statistics.json")
        return found

    def run_all(self):
        open_batches = [b for b in self.batches() if not self.file_of(b).exists()]
        done = self.options.programs - sum(b[1] for b in open_batches)
        print(f"fuzz: {self.options.programs} programs, {done} of them done before; state in {self.state}", flush=True)
        signal.signal(signal.SIGINT, self.stop)
        signal.signal(signal.SIGTERM, self.stop)
        started, first = time.monotonic(), done
        terminal = sys.stdout.isatty()
        with concurrent.futures.ThreadPoolExecutor(self.options.jobs) as pool:
            waiting = {pool.submit(self.run, b): b for b in open_batches}
            for future in concurrent.futures.as_completed(waiting):
                future.result()
                if self.stopping.is_set():
                    continue
                done += waiting[future][1]
                found = self.write_statistics()
                rate = (done - first) / (time.monotonic() - started)
                left = (self.options.programs - done) / rate if rate else 0
                print(f"{chr(13) if terminal else ''}fuzz: {done}/{self.options.programs} programs, "
                      f"{found['programs'] - found['equal']} failed, {rate:.2f}/s, {left / 60:.0f} min left   ",
                      end="" if terminal else "\n", flush=True)
        if terminal:
            print()
        found = self.write_statistics()
        if self.stopping.is_set():
            print(f"fuzz: stopped after {found['programs']} programs; the same command goes on from there")
            return 130
        print(f"fuzz: {found['equal']} of {found['programs']} programs equal at all levels; "
              + ", ".join(f"{n} {level}" for level, n in found["failures"].items() if n)
              + f"\nfuzz: statistics in {self.state / 'statistics.json'}")
        return 0 if found["equal"] == found["programs"] else 1


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", required=True, help="build folder with the target compiler_test_programs")
    parser.add_argument("--state", required=True, help="folder for batches, failures and statistics")
    parser.add_argument("--programs", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1000)
    parser.add_argument("-j", "--jobs", type=int, default=2)
    parser.add_argument("--batch", type=int, default=200, help="programs in a batch: what is lost when the run is stopped")
    parser.add_argument("--group", type=int, default=50, help="modules in one Verilator build")
    parser.add_argument("--statistics", default="", help="also copy the statistics there, if nothing failed")
    parser.add_argument("--no-reduce", dest="reduce", action="store_false", help="leave failures as they are")
    options = parser.parse_args()
    if options.programs < 1 or options.seed < 0 or options.jobs < 1 or options.batch < 1:
        sys.exit("fuzz: error: --programs, --jobs and --batch are at least 1, --seed at least 0")
    fuzzer = Fuzzer(options)
    code = fuzzer.run_all()
    if code == 0 and options.statistics:
        shutil.copy(fuzzer.state / "statistics.json", options.statistics)
    if code == 1 and options.reduce:
        import reduce_program

        reduce_program.reduce_all(fuzzer)
    sys.exit(code)


if __name__ == "__main__":
    main()
