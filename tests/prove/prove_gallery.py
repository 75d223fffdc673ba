#!/usr/bin/env python3
"""Proves every pass on many programs, and counts the verdicts by pass.

  prove_gallery.py EPILINE-HLS WORK [--seconds N] [--random FIRST COUNT] [--jobs N] [KERNEL.cpp ...]

--seconds: processor time for a pass. --random: programs of tests/compiler/random_program.py with these seeds. WORK gets a
folder a program and summary.json. Prints a table; exit code 1 if a pass was refuted or a program could not be compiled.
"""

import argparse
import concurrent.futures
import json
import pathlib
import subprocess
import sys

here = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(here.parent / "compiler"))

from kernel_options import options_of  # noqa: E402

verdicts = ["proved", "timed out", "refuted", "not covered"]


def prove(compiler, source, work, seconds):
    """What a run of the compiler said, and its proof.json, or None."""
    name = source.stem
    options = options_of(source)
    if "--ii" not in options:
        options += ["--ii", "auto"]
    folder = work / name
    folder.mkdir(parents=True, exist_ok=True)
    report = folder / "proof.json"
    report.unlink(missing_ok=True)
    ended = subprocess.run([compiler, source, "--top", name, "-o", folder, *options, "--prove", "--prove-seconds",
                            str(seconds)], text=True, capture_output=True, check=False)
    said = ended.stdout + ended.stderr
    (folder / "log.txt").write_text(said, encoding="utf-8")
    return said, json.loads(report.read_text(encoding="utf-8")) if report.exists() else None


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("compiler", type=pathlib.Path)
    parser.add_argument("work", type=pathlib.Path)
    parser.add_argument("--seconds", type=float, default=5)
    parser.add_argument("--random", type=int, nargs=2, default=(0, 0), metavar=("FIRST", "COUNT"))
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("kernels", type=pathlib.Path, nargs="*")
    given = parser.parse_intermixed_args()
    compiler = given.compiler.resolve()
    given.work.mkdir(parents=True, exist_ok=True)
    sources = list(given.kernels)
    for seed in range(given.random[0], given.random[0] + given.random[1]):
        folder = given.work / "programs"
        folder.mkdir(exist_ok=True)
        subprocess.run([sys.executable, here.parent / "compiler/random_program.py", str(seed), folder], check=True)
        sources.append(folder / f"random_{seed}.cpp")

    totals, bad, timed_out, solver = {}, [], [], ""
    with concurrent.futures.ThreadPoolExecutor(given.jobs) as pool:
        for source, (said, found) in zip(sources, pool.map(
                lambda s: prove(compiler, s, given.work, given.seconds), sources)):
            if found is None:
                bad.append(f"{source.name}: not compiled: {said.strip()[-300:]}")
                continue
            solver = found["solver"]
            for item in found["passes"]:
                total = totals.setdefault(item["pass"], dict.fromkeys(verdicts, 0))
                total[item["verdict"]] += 1
                if item["verdict"] in ("refuted", "not covered"):
                    bad.append(f"{source.name}: {item['process']}: {item['pass']}: {item['verdict']}")
                if item["verdict"] == "timed out":
                    timed_out.append(f"{source.name}: {item['process']}: {item['pass']}: "
                                     f"{item['unproved']} of {item['compared']} not proved")
    print("\n".join(timed_out + bad))
    print(f"\n{len(sources)} programs, {solver}, {given.seconds:g} s of processor time a pass\n")
    print("| pass | " + " | ".join(verdicts) + " |\n|---|" + "---|" * len(verdicts))
    for name, total in sorted(totals.items()):
        print(f"| {name} | " + " | ".join(str(total[v]) for v in verdicts) + " |")
    print("| all | " + " | ".join(str(sum(t[v] for t in totals.values())) for v in verdicts) + " |")
    (given.work / "summary.json").write_text(
        json.dumps({"programs": len(sources), "solver": solver, "seconds_a_pass": given.seconds, "totals": totals,
                    "bad": bad, "timed_out": timed_out}, indent=2) + "\n", encoding="utf-8")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
