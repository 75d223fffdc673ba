#!/usr/bin/env python3
"""epiline-hls with a planted fault, for the tests of the fuzzer: takes its options and runs it, then spoils what it wrote.

Environment: EPILINE_HLS = the compiler; EPILINE_FAULTS = "TOP:LEVEL,...": of the top TOP (* for all) every subtraction of the
source becomes an addition, in the Verilog (level RTL) or in the dataflow graph (level graph).
"""

import os
import pathlib
import re
import subprocess
import sys


def spoil(folder, top, level):
    if level == "RTL":
        file = folder / f"{top}.v"
        # Only lines of the source's operators end in a place; handshakes stay right.
        lines = [re.sub(r" - (?=.*// \S+:\d+)", " + ", line) for line in file.read_text(encoding="utf-8").splitlines()]
        file.write_text("\n".join(lines) + "\n", encoding="utf-8")
    else:
        file = folder / f"{top}.graph"
        file.write_text(file.read_text(encoding="utf-8").replace("= subtract ", "= add "), encoding="utf-8")


def main():
    code = subprocess.run([os.environ["EPILINE_HLS"], *sys.argv[1:]], check=False).returncode
    tops = [top.split("::")[-1] for option, top in zip(sys.argv, sys.argv[1:]) if option == "--top"]
    output = pathlib.Path(sys.argv[sys.argv.index("-o") + 1])
    for top in tops:
        folder = output / top if len(tops) > 1 else output
        if not (folder / f"{top}.v").exists():
            continue
        for fault in os.environ["EPILINE_FAULTS"].split(","):
            name, _, level = fault.partition(":")
            if name in ("*", top):
                spoil(folder, top, level)
    sys.exit(code)


if __name__ == "__main__":
    main()
