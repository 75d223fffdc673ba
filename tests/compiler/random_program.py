#!/usr/bin/env python3
"""Writes random, well-defined streaming programs in the style of HLS kernels, with drivers for their native run.

random_program.py SEED FOLDER        writes FOLDER/random_SEED.cpp (the program) and FOLDER/random_SEED.drive.cpp

The same seed gives the same text. A program never does what C++ leaves undefined: every object is initialised, indices are
masked into range, C integers stay within their type, divisors are never 0, and RAM words are written before their content
matters.

Programs come in two classes. In a "fast" one (6 ns, or the smallest period possible) no loop-carried value feeds back through more than one small operation, as
people write kernels for a real clock; everything else may be as deep as it likes. In a "slow" one anything may feed back into
anything, and the clock is slow enough to allow it. Every sixth program is a network of processes
(DATAFLOW, or tasks). Some programs ask whether there are tokens before they read.
"""

import pathlib
import sys

from generator.networks import Network
from generator.programs import Program


def generate(seed):
    """(program, driver, features) of a seed; features: (name, width class and sign) -> how often."""
    made = Network(seed) if seed % 6 == 5 else Program(seed)
    program, driver = made.generate()
    return program, driver, made.features


def write(seed, folder):
    """Writes a program and its driver, and returns its features."""
    program, driver, features = generate(seed)
    (folder / f"random_{seed}.cpp").write_text(program, encoding="utf-8")
    (folder / f"random_{seed}.drive.cpp").write_text(driver, encoding="utf-8")
    return features


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__.split("\n\n")[1])
    folder = pathlib.Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    write(int(sys.argv[1]), folder)


if __name__ == "__main__":
    main()
