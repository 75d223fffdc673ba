#!/usr/bin/env python3
"""Runs epiline-hls --check on every kernel, with the tokens of its driver and with random ones.

  check_gallery.py [options] NAME...     tests/compiler/kernels/NAME.cpp

Prints one line a kernel and stimulus, and what --check said where it did not end well. Exit code 1 if anything differed.
"""

import argparse
import concurrent.futures
import pathlib
import shutil
import subprocess
import sys

from kernel_options import options_of

HERE = pathlib.Path(__file__).resolve().parent


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--compiler", required=True, help="epiline-hls")
    parser.add_argument("--drivers", required=True, help="program of the kernels' drivers")
    parser.add_argument("--work", required=True, help="folder for everything that is made")
    parser.add_argument("--target", default="generic", help="device: of the delays, and of the netlist")
    parser.add_argument("--levels", default="", help="as of epiline-hls; without it all")
    parser.add_argument("--stimuli", default="driver,random", help="driver, random or both, with a comma between")
    parser.add_argument("--seed", default="1", help="of the random stimulus")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("names", nargs="+")
    options = parser.parse_args()
    work = pathlib.Path(options.work).resolve()
    tokens = work / "tokens"
    tokens.mkdir(parents=True, exist_ok=True)
    if "driver" in options.stimuli.split(","):
        subprocess.run([options.drivers, str(tokens), *options.names], check=True)

    def check(job):
        name, stimulus = job
        source = HERE / "kernels" / f"{name}.cpp"
        folder = work / f"{name}_{stimulus}"
        shutil.rmtree(folder, ignore_errors=True)
        command = [options.compiler, str(source), "--top", name, "-o", str(folder), "--check", "--quiet", "--seed",
                   options.seed, "--target", options.target, *options_of(source)]
        if options.levels:
            command += ["--levels", options.levels]
        if stimulus == "driver":
            command += ["--stimulus", str(tokens / f"{name}.tokens")]
        run = subprocess.run(command, capture_output=True, text=True, check=False)
        last = (run.stdout.strip().splitlines() or ["it printed nothing"])[-1]
        if run.returncode == 0:
            print(f"{name}, {stimulus}: {last}", flush=True)
        else:
            print(f"FAILED {name}, {stimulus}: {' '.join(command)}\n{run.stdout}{run.stderr}", flush=True)
        return run.returncode == 0

    jobs = [(name, stimulus) for name in options.names for stimulus in options.stimuli.split(",")]
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        good = sum(pool.map(check, jobs))
    print(f"{good} of {len(jobs)} kernels and stimuli: all levels are equal")
    sys.exit(0 if good == len(jobs) else 1)


if __name__ == "__main__":
    main()
