#!/usr/bin/env python3
"""Breaks the kernels on purpose, one fault at a time, and shows that the default tests notice each.

    scripts/mutation_check.py [--only TEXT] [--work FOLDER] [--jobs N] [--list]

The faults stand in tests/mutation/mutants.json: a file below hls/, what is wrong then, the text to find (exactly once)
and its replacement. Works on copies of hls/ in FOLDER (default build-mutation/), never on the sources themselves. For
every fault the tests of tests/kernels that include the file are compiled and run, quickest first. A fault is killed when
a test fails or does not end; one that survives every test is an error, unless the table explains under "equivalent" why
nothing can notice it. Finished faults are kept in FOLDER/results.json and not repeated until the sources change.
Exit code 0: all killed or explained.
"""

import argparse
import concurrent.futures
import hashlib
import json
import os
import pathlib
import queue
import shutil
import subprocess
import sys
import threading
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
TABLE = ROOT / "tests" / "mutation" / "mutants.json"
TESTS = sorted(path for path in (ROOT / "tests" / "kernels").glob("*_test.cpp") if path.stem != "real_pairs_test")
COMPILER = ["clang++-19", "-std=c++20", "-O1", "-w"]
TEST_SECONDS = 300
FIELDS = {"file", "fault", "find", "replace", "equivalent"}


def fail(message):
    sys.exit(f"mutation_check.py: error: {message}")


def read_table():
    try:
        table = json.loads(TABLE.read_text())
    except (OSError, ValueError) as error:
        fail(f"{TABLE}: {error}")
    for number, mutant in enumerate(table):
        where = f"{TABLE}: [{number}]"
        if not FIELDS >= set(mutant) >= FIELDS - {"equivalent"}:
            fail(f"{where}: needs exactly the fields {', '.join(sorted(FIELDS))} ('equivalent' may be absent)")
        path = ROOT / "hls" / mutant["file"]
        if not path.is_file():
            fail(f"{where}: there is no file hls/{mutant['file']}")
        found = path.read_text().count(mutant["find"])
        if found != 1:
            fail(f"{where} ({mutant['fault']}): its text stands {found} times in hls/{mutant['file']}, not once")
        if mutant["find"] == mutant["replace"]:
            fail(f"{where} ({mutant['fault']}): the replacement changes nothing")
    names = [(m["file"], m["fault"]) for m in table]
    if len(set(names)) != len(names):
        fail(f"{TABLE}: two faults of one file have the same description")
    return table


def name_of(mutant):
    return f"{mutant['file']}: {mutant['fault']}"


def digest_of_sources():
    digest = hashlib.sha256()
    for folder in ("hls", "tests/kernels"):
        for path in sorted((ROOT / folder).rglob("*")):
            if path.is_file():
                digest.update(f"{path.relative_to(ROOT)}\0".encode() + path.read_bytes() + b"\0")
    return digest.hexdigest()


class Bench:
    """One copy of hls/, with which one fault at a time is tried."""

    def __init__(self, folder):
        self.hls = folder / "hls"
        self.program = folder / "test"
        shutil.rmtree(self.hls, ignore_errors=True)
        shutil.copytree(ROOT / "hls", self.hls)

    def compile(self, test, *more):
        command = [*COMPILER, *more, f"-I{self.hls}", f"-I{self.hls / 'types'}", str(test)]
        if "-MM" not in more:
            command += ["-o", str(self.program), "-lgtest", "-lgtest_main"]
        return subprocess.run(command, capture_output=True, text=True, errors="replace")

    def headers_of(self, test):
        listed = self.compile(test, "-MM").stdout.replace("\\\n", " ").split()
        return {str(pathlib.Path(name).relative_to(self.hls)) for name in listed if name.startswith(f"{self.hls}/")}

    def failing_test(self, test):
        """The first test of a source file that fails, or None; what does not compile in angles."""
        compiled = self.compile(test)
        if compiled.returncode != 0:
            return f"<{test.name} does not compile: {(compiled.stderr.splitlines() or ['?'])[0]}>"
        try:
            run = subprocess.run([str(self.program), "--gtest_fail_fast", "--gtest_brief=1"], capture_output=True,
                                 text=True, errors="replace", timeout=TEST_SECONDS)
        except subprocess.TimeoutExpired:
            return f"{test.name} (does not end)"
        if run.returncode == 0:
            return None
        for line in run.stdout.splitlines():
            if line.startswith("[  FAILED  ]"):
                return line.split("]", 1)[1].split("(")[0].split(",")[0].strip()
        return f"{test.name} (exit code {run.returncode})"

    def killer(self, mutant, tests):
        path = self.hls / mutant["file"]
        original = path.read_text()
        path.write_text(original.replace(mutant["find"], mutant["replace"]))
        try:
            for test in tests:
                failing = self.failing_test(test)
                if failing is not None:
                    return failing
        finally:
            path.write_text(original)
        return None


def measure_tests(benches, jobs):
    """Every test without a fault: {test: (seconds, headers)}. All must pass."""
    measured = {}

    def measure(test):
        bench = benches.get()
        try:
            start = time.time()
            failing = bench.failing_test(test)
            if failing is not None:
                fail(f"without any fault: {failing}")
            measured[test] = (time.time() - start, bench.headers_of(test))
        finally:
            benches.put(bench)

    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        for _ in pool.map(measure, TESTS):
            pass
    return measured


def run(mutants, benches, jobs, measured, results, save):
    lock = threading.Lock()
    left = [m for m in mutants if results.get(name_of(m), {}).get("change") != [m["find"], m["replace"]]]

    def attempt(mutant):
        tests = sorted((t for t in measured if mutant["file"] in measured[t][1]), key=lambda t: measured[t][0])
        bench = benches.get()
        try:
            start = time.time()
            killer = bench.killer(mutant, tests)
            seconds = round(time.time() - start, 1)
        finally:
            benches.put(bench)
        with lock:
            results[name_of(mutant)] = {"change": [mutant["find"], mutant["replace"]], "killed_by": killer}
            save()
            done = sum(name_of(m) in results for m in mutants)
            print(f"[{done}/{len(mutants)}] {name_of(mutant)}: {'killed by ' + killer if killer else 'SURVIVED'} "
                  f"({seconds} s)", flush=True)

    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        for _ in pool.map(attempt, left):
            pass


def report(mutants, results):
    bad = 0
    killed = explained = 0
    for mutant in mutants:
        key = name_of(mutant)
        killer = results[key]["killed_by"]
        if killer is not None and killer.startswith("<"):
            print(f"error: {key}: {killer[1:-1]}; a fault must compile", file=sys.stderr)
            bad += 1
        elif killer is None and "equivalent" not in mutant:
            print(f"error: {key}: survived; write the test that is missing", file=sys.stderr)
            bad += 1
        elif killer is not None and "equivalent" in mutant:
            print(f"error: {key}: killed by {killer}, but the table says that nothing can notice it", file=sys.stderr)
            bad += 1
        elif killer is None:
            explained += 1
        else:
            killed += 1
    print(f"{len(mutants)} faults: {killed} killed, {explained} explained, {bad} wrong")
    return 1 if bad else 0


def main():
    parser = argparse.ArgumentParser(description="show that the default tests notice every fault of the table")
    parser.add_argument("--only", default="", help="faults whose file or description contains this text")
    parser.add_argument("--work", type=pathlib.Path, default=ROOT / "build-mutation", help="folder to work in")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="compilations at once")
    parser.add_argument("--list", action="store_true", help="print the table and stop")
    arguments = parser.parse_args()
    mutants = [m for m in read_table() if arguments.only in m["file"] or arguments.only in m["fault"]]
    if not mutants:
        fail(f"no fault's file or description contains '{arguments.only}'; --list prints them")
    if arguments.list:
        for mutant in mutants:
            print(f"{mutant['file']}: {mutant['fault']}")
        return 0
    if shutil.which(COMPILER[0]) is None:
        fail(f"{COMPILER[0]} is missing: scripts/setup.sh installs it")
    jobs = max(1, arguments.jobs)
    work = arguments.work.resolve()
    benches = queue.Queue()
    for number in range(jobs):
        folder = work / f"bench{number}"
        folder.mkdir(parents=True, exist_ok=True)
        benches.put(Bench(folder))
    digest = digest_of_sources()
    stored = work / "results.json"
    try:
        kept = json.loads(stored.read_text())
    except (OSError, ValueError):
        kept = {}
    results = kept["faults"] if kept.get("digest") == digest else {}

    def save():
        partial = stored.with_suffix(".part")
        partial.write_text(json.dumps({"digest": digest, "faults": results}, indent=1) + "\n")
        partial.replace(stored)

    print(f"{len(TESTS)} test programs without a fault first", flush=True)
    run(mutants, benches, jobs, measure_tests(benches, jobs), results, save)
    return report(mutants, results)


if __name__ == "__main__":
    sys.exit(main())
