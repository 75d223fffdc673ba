#!/usr/bin/env python3
"""Makes docs/gallery/README.md: the kernels of tests/compiler/kernels, what each shows, and what the compiler made of it.

  scripts/gallery_table.py --reports FOLDER           writes the page
  scripts/gallery_table.py --reports FOLDER --check   writes nothing; ends with exit code 1 if the page is another text

FOLDER holds NAME/report.json of every kernel; the test compiler.kernels leaves one in BUILD/tests/compiler/kernels/rtl. The
kernels' fields and the words about them stand in docs/gallery/kernels.json, what a kernel does in the head of its source.
"""

import argparse
import json
import pathlib
import re
import sys

from results_table import number, table
from whole_file import holds, write_whole

root = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(root / "tests" / "compiler"))

from kernel_options import options_of  # noqa: E402

head = """# Gallery

Made by `scripts/gallery_table.py`. {count} kernels of other fields than stereo vision, written as users of the vendors' tools write them, to be read and copied. The default tests run each natively against an independent computation, through the dataflow graph, and as Verilog under random pauses of every stream (`ctest --preset release -R compiler.kernels`); `cmake --build build --target check_gallery` runs each through [every level](../flow.md#every-level-runs).

One of them by hand, compiled, and checked at every level with random tokens (options that a kernel needs stand with it below):

```
build/bin/epiline-hls tests/compiler/kernels/cordic.cpp --top cordic -o out
build/bin/epiline-hls tests/compiler/kernels/cordic.cpp --top cordic -o out --check
```

With tokens that mean something, and the answers that an independent program expects, as its driver in [tests/compiler/drivers](../../tests/compiler/drivers) makes them:

```
build/bin/compiler_kernel_drivers . cordic
build/bin/epiline-hls tests/compiler/kernels/cordic.cpp --top cordic -o out --check --stimulus cordic.tokens
```

## What the compiler makes of them

Estimates of the compiler for ECP5, from each kernel's `report.json`: clocks from one iteration to the next (an iteration is a token in most of them), stages of the pipeline (of every process, in the order of the calls), the clock period (6 ns unless a recurrence of the source takes longer or the kernel asks for another; the report names the chain), LUT4, flip-flops, block RAMs.

"""


class gallery_error(Exception):
    """One sentence for the person at the terminal."""


def description_of(source):
    """The comment at the head of a source, without the lines that tools read."""
    lines = []
    for line in source.read_text(encoding="utf-8").splitlines():
        if not line.startswith("//"):
            break
        if not line.startswith("// epiline-hls:"):
            lines.append(line[2:].strip())
    text = re.sub(r"\s*\bone iteration a token of \w+\s*", " ", " ".join(lines)).strip()
    if not text:
        raise gallery_error(f"{source}: no comment at its head: say what the kernel does")
    return text


def read_entries(file, kernels):
    """Field, what it shows, and what to look at, by kernel; exactly the kernels of the folder."""
    entries = {}
    for field, members in json.loads(file.read_text(encoding="utf-8")).items():
        for name, entry in members.items():
            if name in entries:
                raise gallery_error(f"{file}: {name} stands there twice")
            entries[name] = {"field": field, **entry}
    present = {source.stem for source in kernels.glob("*.cpp")}
    for name in sorted(present - entries.keys()):
        raise gallery_error(f"{file}: no entry for {name}: say what it shows and what to look at")
    for name in sorted(entries.keys() - present):
        raise gallery_error(f"{file}: there is no kernel {name} in {kernels}")
    return entries


def row_of(name, entry, report):
    parts = [process["report"] for process in report["processes"]] if "processes" in report else [report]
    return [
        f"[{name}](#{name})",
        entry["field"],
        entry["shows"],
        " / ".join(str(interval) for interval in sorted({part["initiation_interval"] for part in parts})),
        " + ".join(str(part["depth"]) for part in parts),
        number(report["clock"]["period_ns"], 2),
        number(report["estimate"]["lut4"]),
        number(report["registers"]["total_bits"]),
        number(report["estimate"]["block_rams"]),
    ]


def make_text(kernels, words, reports):
    entries = read_entries(words, kernels)
    rows, sections, field = [], [], None
    for name, entry in entries.items():
        file = reports / name / "report.json"
        if not file.is_file():
            raise gallery_error(f"{file} is missing: run ctest -R compiler.kernels first")
        rows.append(row_of(name, entry, json.loads(file.read_text(encoding="utf-8"))))
        source = kernels / f"{name}.cpp"
        if entry["field"] != field:
            field = entry["field"]
            sections.append(f"\n## {field[0].upper()}{field[1:]}\n")
        options = options_of(source)
        link = f"../../tests/compiler/kernels/{name}.cpp"
        sections.append(
            f"\n### {name}\n\n[{name}.cpp]({link}), [driver](../../tests/compiler/drivers/{name}.cpp)"
            + (f", with `{' '.join(options)}`" if options else "")
            + f": {description_of(source)}\n\nLook at {entry['look_at']}\n"
        )
    columns = ["kernel", "field", "shows", "clocks>", "stages>", "period, ns>", "LUT4>", "flip-flops>", "block RAMs>"]
    return head.format(count=len(rows)) + table(columns, rows) + "".join(sections)


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="compare only")
    parser.add_argument("--reports", type=pathlib.Path, required=True, help="folder of NAME/report.json")
    gallery = root / "docs" / "gallery"
    sources = root / "tests" / "compiler" / "kernels"
    parser.add_argument("--kernels", type=pathlib.Path, default=sources, help="folder of the sources")
    parser.add_argument("--words", type=pathlib.Path, default=gallery / "kernels.json", help="what each kernel shows")
    parser.add_argument("-o", "--output", type=pathlib.Path, default=gallery / "README.md", help="the file to write")
    options = parser.parse_args(arguments)
    try:
        text = make_text(options.kernels, options.words, options.reports)
        if options.check:
            if not holds(options.output, text):
                again = f"scripts/gallery_table.py --reports {options.reports}"
                raise gallery_error(f"{options.output} is not what the kernels' reports give: run {again}")
            return 0
        write_whole(options.output, text)
    except KeyError as error:
        print(f"gallery_table.py: error: an entry or a report has no key {error}", file=sys.stderr)
        return 1
    except (gallery_error, OSError, ValueError) as error:
        print(f"gallery_table.py: error: {error}", file=sys.stderr)
        return 1
    print(f"wrote {options.output}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
