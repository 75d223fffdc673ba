#!/usr/bin/env python3
"""Reduces random programs that failed, and makes regression tests of them. Called by scripts/fuzz.sh.

A reduction is only one if the smaller program still fails at the same level, with a message of the same kind, and still means
something: clang++ with the undefined behaviour sanitizer and variables filled with a pattern, and g++, must run it to the same
tokens. (A disagreement of the two is a failure of its own, of the level "native".)
"""

import argparse
import json
import os
import pathlib
import re
import shutil
import stat
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
SECONDS = 1800  # processor time is not counted here: a reduction may be stopped, and what it has found so far is kept
MOST_REDUCED = 10  # failures of a run that are reduced by itself, the first of each kind


def is_interesting(build, folder, failure):
    """Whether folder/NAME.cpp (with its driver) fails as `failure` says."""
    import fuzz

    name = failure["name"]
    result = folder / "result.json"
    command = [sys.executable, str(HERE / "run_batch.py"),
               *(f"--{n}={p}" for n, p in fuzz.programs_of(build).items()), "--cxx", "clang++-19", "--also-native", "g++",
               "--sanitize", "--jobs", "1", "--model-flags=-O0", "--precompiled", failure["precompiled"],
               "--work", str(folder / "work"), "--json", str(result)]
    if failure["level"] not in ("RTL", "check", "native"):
        command.append("--graph-only")
    subprocess.run([*command, "files", str(folder), name], capture_output=True, check=False)
    if not result.exists():
        return False
    program = json.loads(result.read_text(encoding="utf-8"))["programs"].get(name, {})
    return fuzz.level_of(program) == failure["level"] and (
        failure["level"] not in ("refused", "crashed") or fuzz.kind_of(program["text"]) == failure["kind"])


def reduce_one(build, folder):
    """Leaves folder/reduced.cpp; returns whether the failure was seen again at all."""
    name = folder.name
    failure = json.loads((folder / "failure.json").read_text(encoding="utf-8"))
    failure.update(name=name, precompiled=str(folder.parent.parent / "precompiled"))
    work = folder / "reduction"
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir()
    (work / "failure.json").write_text(json.dumps(failure), encoding="utf-8")
    shutil.copy(folder / f"{name}.cpp", work)
    shutil.copy(folder / f"{name}.drive.cpp", work)
    script = work / "interesting.sh"
    # cvise runs it in a folder of its own that holds nothing but the candidate.
    script.write_text(f"#!/bin/sh\nexec {sys.executable} {HERE / 'reduce_program.py'} --build {build} "
                      f"--interesting {work}\n", encoding="utf-8")
    script.chmod(script.stat().st_mode | stat.S_IXUSR)
    if subprocess.run([str(script)], cwd=work, check=False).returncode != 0:
        print(f"{name}: does not fail alone as it did: level {failure['level']} (it may need its batch)", flush=True)
        return False
    try:
        subprocess.run(["cvise", "--n", "1", "--no-cache", "--timeout", "300", str(script), f"{name}.cpp"], cwd=work,
                       stdout=open(work / "log", "w", encoding="utf-8"), stderr=subprocess.STDOUT, timeout=SECONDS,
                       check=False)
    except subprocess.TimeoutExpired:
        pass
    shutil.copy(work / f"{name}.cpp", folder / "reduced.cpp")
    lines = len((folder / "reduced.cpp").read_text(encoding="utf-8").splitlines())
    print(f"{name}: {failure['level']}, reduced to {lines} lines: {folder / 'reduced.cpp'}\n"
          f"    make it a test: scripts/fuzz.sh --keep {name} NAME_OF_THE_BUG", flush=True)
    return True


def reduce_all(fuzzer):
    """The first failure of each kind of a run."""
    kinds = set()
    for folder in sorted((fuzzer.state / "failures").iterdir(), key=lambda f: (len(f.name), f.name)):
        failure = json.loads((folder / "failure.json").read_text(encoding="utf-8"))
        kind = (failure["level"], failure["kind"] if failure["level"] in ("refused", "crashed") else folder.name)
        if kind in kinds or (folder / "reduced.cpp").exists() or len(kinds) >= MOST_REDUCED:
            continue
        kinds.add(kind)
        reduce_one(fuzzer.build, folder)


def keep(folder, wanted, tests=HERE):
    """Writes regressions/WANTED.cpp and drivers/WANTED.cpp from a kept failure."""
    name = folder.name
    reduced = folder / "reduced.cpp"
    program = (reduced if reduced.exists() else folder / f"{name}.cpp").read_text(encoding="utf-8")
    driver = (folder / f"{name}.drive.cpp").read_text(encoding="utf-8")
    files = {tests / "regressions" / f"{wanted}.cpp": re.sub(rf"\b{name}\b", wanted, program)}
    driver = driver.replace('"drive.hpp"', '"../drive.hpp"').replace(f'"{name}.cpp"', f'"../regressions/{name}.cpp"')
    driver = driver.replace(f"program_{name}", f"regression_{name}")
    files[tests / "drivers" / f"{wanted}.cpp"] = re.sub(rf"(?<=[^a-z])(regression_)?{name}\b", rf"\g<1>{wanted}", driver)
    for file in files:
        if file.exists():
            sys.exit(f"fuzz: error: {file} is there already: choose another name")
    for file, text in files.items():
        file.write_text(text, encoding="utf-8")
        print(f"written: {file}")
    print("Say in a comment on top what was wrong, and tidy the names; `ctest -R compiler.regressions` runs it.")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", required=True)
    parser.add_argument("--state", default="", help="state folder of the runs")
    parser.add_argument("--reduce", default="", metavar="NAME")
    parser.add_argument("--keep", nargs=2, metavar=("NAME", "AS"))
    parser.add_argument("--interesting", default="", metavar="FOLDER", help="of a reduction: judges the program in .")
    options = parser.parse_args()
    build = pathlib.Path(options.build).resolve()
    if options.interesting:
        origin = pathlib.Path(options.interesting)
        failure = json.loads((origin / "failure.json").read_text(encoding="utf-8"))
        here = pathlib.Path(os.getcwd())
        if here != origin:
            shutil.copy(origin / f"{failure['name']}.drive.cpp", here)
        sys.exit(0 if is_interesting(build, here, failure) else 1)
    name = options.reduce or (options.keep[0] if options.keep else "")
    folder = pathlib.Path(options.state).resolve() / "latest" / "failures" / name
    if not name or not (folder / "failure.json").exists():
        sys.exit(f"fuzz: error: no failure '{name}' in {folder.parent}: name one of those kept there")
    if options.keep:
        keep(folder.resolve(), options.keep[1])
    elif not reduce_one(build, folder.resolve()):
        sys.exit(1)


if __name__ == "__main__":
    sys.path.insert(0, str(HERE))
    main()
