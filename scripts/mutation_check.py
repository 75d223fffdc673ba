#!/usr/bin/env python3
"""Breaks the kernels on purpose, one fault at a time, and shows that the default tests notice each.

    scripts/mutation_check.py [--only TEXT] [--work FOLDER] [--jobs N] [--list]

The faults stand in tests/mutation/mutants.json: a file below hls/, what is wrong then, the text to find (exactly once)
and its replacement. Works on a copy of the sources in FOLDER (default build-mutation/), never on the sources
themselves. A fault is killed when a test fails or does not end; one that survives every test is an error, unless the
table explains under "equivalent" why nothing can notice it. Finished faults are kept in FOLDER/results.json and not
repeated until the sources change. Exit code 0: all killed or explained.
"""

import argparse
import hashlib
import json
import os
import pathlib
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
TABLE = ROOT / "tests" / "mutation" / "mutants.json"
# Default tests; the first one that fails ends a fault's run.
TESTS = ["kernels_test"]
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


def source_files():
    listed = subprocess.run(["git", "-C", str(ROOT), "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
                            check=True, capture_output=True).stdout.decode()
    return sorted(name for name in listed.split("\0") if name and (ROOT / name).is_file())


def copy_sources(target):
    """Copies what changed (times of equal files stay, so nothing is rebuilt); returns a digest of what TESTS depend on."""
    digest = hashlib.sha256()
    for name in source_files():
        content = (ROOT / name).read_bytes()
        if name.startswith(("hls/", "tests/kernels/")):
            digest.update(f"{name}\0{len(content)}\0".encode() + content)
        copy = target / name
        if copy.is_file() and copy.read_bytes() == content:
            continue
        copy.parent.mkdir(parents=True, exist_ok=True)
        copy.write_bytes(content)
    return digest.hexdigest()


class Workshop:
    def __init__(self, folder, jobs):
        self.source = folder / "source"
        self.build = folder / "build"
        self.jobs = jobs
        self.log = folder / "log.txt"

    def configure(self):
        self.call(["cmake", "-S", str(self.source), "-B", str(self.build), "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                   "-DCMAKE_CXX_COMPILER=clang++-19"], "the configuration of the copy failed")

    def call(self, command, problem):
        with open(self.log, "ab") as log:
            if subprocess.run(command, stdout=log, stderr=subprocess.STDOUT).returncode != 0:
                fail(f"{problem}; see {self.log}")

    def compiles(self, target):
        with open(self.log, "ab") as log:
            return subprocess.run(["cmake", "--build", str(self.build), "-j", str(self.jobs), "--target", target],
                                  stdout=log, stderr=subprocess.STDOUT).returncode == 0

    def failing_test(self, target):
        """The first test of a program that fails, or None."""
        try:
            run = subprocess.run([str(self.build / "bin" / target), "--gtest_fail_fast", "--gtest_brief=1"],
                                 capture_output=True, text=True, errors="replace", timeout=TEST_SECONDS)
        except subprocess.TimeoutExpired:
            return f"{target} (does not end)"
        if run.returncode == 0:
            return None
        for line in run.stdout.splitlines():
            if line.startswith("[  FAILED  ]"):
                return line.split("]", 1)[1].split("(")[0].split(",")[0].strip()
        return f"{target} (exit code {run.returncode})"

    def killer(self):
        """The test that notices the copy's fault; None if there is none; compilation failures as text in angles."""
        for target in TESTS:
            if not self.compiles(target):
                return f"<{target} does not compile>"
            failing = self.failing_test(target)
            if failing is not None:
                return failing
        return None


def run(mutants, workshop, results, save):
    for number, mutant in enumerate(mutants):
        key = f"{mutant['file']}: {mutant['fault']}"
        if results.get(key, {}).get("change") == [mutant["find"], mutant["replace"]]:
            continue
        start = time.time()
        path = workshop.source / "hls" / mutant["file"]
        original = path.read_text()
        path.write_text(original.replace(mutant["find"], mutant["replace"]))
        try:
            killer = workshop.killer()
        finally:
            path.write_text(original)
        results[key] = {"change": [mutant["find"], mutant["replace"]], "killed_by": killer,
                        "seconds": round(time.time() - start, 1)}
        save()
        print(f"[{number + 1}/{len(mutants)}] {key}: {'killed by ' + killer if killer else 'SURVIVED'} "
              f"({results[key]['seconds']} s)", flush=True)


def report(mutants, results):
    bad = 0
    killed = explained = 0
    for mutant in mutants:
        key = f"{mutant['file']}: {mutant['fault']}"
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
    work = arguments.work.resolve()
    work.mkdir(parents=True, exist_ok=True)
    workshop = Workshop(work, arguments.jobs)
    digest = copy_sources(workshop.source)
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

    if not results:
        print("building and testing without a fault first", flush=True)
        workshop.configure()
        failing = workshop.killer()
        if failing is not None:
            fail(f"without any fault: {failing}; see {workshop.log}")
    run(mutants, workshop, results, save)
    return report(mutants, results)


if __name__ == "__main__":
    sys.exit(main())
