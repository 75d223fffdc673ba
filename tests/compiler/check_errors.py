#!/usr/bin/env python3
"""What epiline-hls refuses, and how.

  check_errors.py COMPILER

Every errors/NAME.cpp holds something unsupported in its top NAME. Lines that may be named carry a comment `// refused: words`, a regular
expression (case is ignored) of which the message must contain something; `// options: ...` adds command line options. The compiler
must name one of these lines as FILE:LINE, say the words and more, leave with an exit code from 1 to 127, and write nothing.
The command line's own errors are in the table below. A message begins with FILE:LINE: error:, and no word of compilers is in it.
"""

import os
import pathlib
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
KERNEL = HERE / "kernels" / "fir.cpp"

# Words of compilers and places of this flow that a message must not show.
JARGON = re.compile(r"\bllvm|\bi(1|8|16|32|64|128)\b|\bphi\b|\b_Z[A-Z0-9]|getelementptr|ptrtoint|\bicmp\b|%\w"
                    r"|__epiline|<epiline|/epiline-hls-|/hls/types/|call_top|static assertion|_BitInt|\[-W")

# (name, arguments, regular expression); {out} is a folder that does not exist, {source} a good kernel, {file} a plain file.
COMMAND_LINES = [
    ("missing file", ["{out}_no_such.cpp", "--top", "fir", "-o", "{out}"], r"no_such\.cpp"),
    ("source is a folder", ["{folder}", "--top", "fir", "-o", "{out}"], r"{folder}"),
    ("no such top", ["{source}", "--top", "no_such_top", "-o", "{out}"], r"no_such_top"),
    ("top is no name", ["{source}", "--top", "two words", "-o", "{out}"], r"two words"),
    ("top is a path", ["{source}", "--top", "../fir", "-o", "{out}"], r"--top \.\./fir: not the name of a function"),
    ("two tops for one folder", ["{source}", "--top", "fir", "--top", "other::fir", "-o", "{out}"],
     r"--top other::fir: another top has this name, and so its folder"),
    ("makefile rule for two tops", ["{source}", "--top", "fir", "--top", "main", "-o", "{out}", "--depfile", "{out}.d"],
     r"--depfile .*give one --top"),
    ("a record without a file", ["{source}", "--top", "fir", "-o", "{out}", "--recorded"], r"--recorded .*give --check and --stimulus"),
    ("top is nothing", ["{source}", "--top", "", "-o", "{out}"], r"--top"),
    ("top ends in a scope", ["{source}", "--top", "kernels::", "-o", "{out}"], r"--top kernels::: not the name"),
    ("top is code", ["{source}", "--top", "fir>(0); }} int evil = system(", "-o", "{out}"], r"evil.*not the name"),
    ("top is more than a line", ["{source}", "--top", 'fir\n#include "/etc/passwd"', "-o", "{out}"], r"not the name"),
    ("no top", ["{source}", "-o", "{out}"], r"--top"),
    ("no output", ["{source}", "--top", "fir"], r"-o|--output"),
    ("no source", ["--top", "fir", "-o", "{out}"], r"SOURCE|source"),
    ("output is a file", ["{source}", "--top", "fir", "-o", "{file}"], r"{file}"),
    ("output below a file", ["{source}", "--top", "fir", "-o", "{file}/below"], r"{file}"),
    ("clock 0", ["{source}", "--top", "fir", "--clock", "0ns", "-o", "{out}"], r"clock|0ns"),
    ("negative clock", ["{source}", "--top", "fir", "--clock=-3ns", "-o", "{out}"], r"clock|-3ns"),
    ("clock without a number", ["{source}", "--top", "fir", "--clock", "fast", "-o", "{out}"], r"fast"),
    ("clock with a strange unit", ["{source}", "--top", "fir", "--clock", "6parsecs", "-o", "{out}"], r"6parsecs"),
    ("clock nan", ["{source}", "--top", "fir", "--clock", "nanns", "-o", "{out}"], r"nanns"),
    ("two clocks", ["{source}", "--top", "fir", "--clock", "6", "--clock", "7", "-o", "{out}"],
     r"^error: --clock is there 2 times: give it once"),
    ("unknown target", ["{source}", "--top", "fir", "--target", "abacus", "-o", "{out}"], r"abacus.*ecp5"),
    ("no file of delays", ["{source}", "--top", "fir", "--device-delays", "{out}_no_such", "-o", "{out}"],
     r"--device-delays .*_no_such: cannot be read"),
    ("a file without delays", ["{source}", "--top", "fir", "--device-delays", "{empty}", "-o", "{out}"],
     r"--device-delays .*: not a file of delays"),
    ("unknown option", ["{source}", "--top", "fir", "--frobnicate", "-o", "{out}"], r"--frobnicate"),
    ("registers without arguments", ["{source}", "--top", "fir", "--axi-lite", "-o", "{out}"],
     r"--axi-lite: the top 'fir' has no scalar arguments"),
    ("interval 0", ["{source}", "--top", "fir", "--ii", "0", "-o", "{out}"], r"--ii 0: give a number from 1"),
    ("interval in words", ["{source}", "--top", "fir", "--ii", "two", "-o", "{out}"], r"--ii two: give a number"),
    ("negative interval", ["{source}", "--top", "fir", "--ii=-1", "-o", "{out}"], r"--ii -1: give a number"),
    ("unknown schedule", ["{source}", "--top", "fir", "--schedule", "best", "-o", "{out}"], r"--schedule.*best"),
    ("seed in words", ["{source}", "--top", "fir", "--seed", "lucky", "-o", "{out}"], r"--seed.*lucky"),
    ("empty file", ["{empty}", "--top", "fir", "-o", "{out}"], r"{empty}.*no function 'fir'"),
    ("binary file", ["{binary}", "--top", "fir", "-o", "{out}"], r"binary\.cpp:1: error: "),
    ("top in a namespace", ["{source}", "--top", "nowhere::fir", "-o", "{out}"], r"no function 'nowhere::fir'"),
    ("two sources", ["{source}", "{source}", "--top", "fir", "-o", "{out}"], r"not expected|fir\.cpp"),
    ("makefile rule below a file", ["{source}", "--top", "fir", "-o", "{out}", "--depfile", "{file}/rule.d"],
     r"{file}/rule\.d"),
    ("explaining in no folder", ["--explain", "x", "{out}_no_such"], r"{out}_no_such: cannot be read: No such file"),
    ("explaining in a foreign folder", ["--explain", "x", "{folder}"], r"{folder}: no \*\.signals\.json in it: name"),
    ("explaining without a folder", ["--explain", "x"], r"--explain"),
    ("period below any operation", ["{source}", "--top", "fir", "--clock", "0.01ns", "-o", "{out}"], r"period"),
]


def clean(folder):
    """Nothing was written."""
    return not folder.exists() or not any(folder.rglob("*"))


def run(compiler, arguments):
    environment = dict(os.environ, LC_ALL="C")
    try:
        return subprocess.run([compiler, *arguments], capture_output=True, text=True, timeout=60, env=environment,
                              check=False)
    except subprocess.TimeoutExpired:
        return None


def judge(result, out):
    if result is None:
        return ["takes more than 60 s"]
    problems = []
    if result.returncode == 0:
        problems.append("accepted")
    elif result.returncode < 0 or result.returncode > 127:
        problems.append(f"crashed ({result.returncode})")
    if not clean(out):
        problems.append("left output: " + ", ".join(sorted(p.name for p in out.rglob("*"))))
    if re.search(r"LLVM ERROR|Stack dump|Assertion|terminate called|error of epiline-hls", result.stderr):
        problems.append("ended by an internal error")
    jargon = JARGON.search(result.stderr)
    if jargon:
        problems.append(f"speaks of {jargon.group()!r}, which is no word of the user's")
    return problems


def check_source(compiler, source, folder):
    options, lines, words = [], [], []
    for number, line in enumerate(source.read_text(encoding="utf-8").splitlines(), 1):
        match = re.match(r"// options: (.*)", line)
        if match:
            options = match.group(1).split()
        match = re.search(r"// refused: (.*)", line)
        if match:
            lines.append(number)
            words.append(match.group(1))
    if not lines:
        return ["no line says // refused:"], ""
    out = folder / source.stem
    result = run(compiler, [str(source), "--top", source.stem, "-o", str(out), *options])
    problems = judge(result, out)
    if result is None:
        return problems, ""
    first = re.match(r"(?:.*/)?" + re.escape(source.name) + r":(\d+): error: \S", result.stderr)
    if not first:
        problems.append("does not begin with FILE:LINE: error: TEXT")
    named = [int(first.group(1))] if first else []
    if not set(named) & set(lines):
        problems.append(f"names line(s) {sorted(set(named)) or 'none'}, not {lines}")
    if not re.search("|".join(words), result.stderr, re.IGNORECASE):
        problems.append(f"does not say {'|'.join(sorted(set(words)))!r}")
    return problems, result.stderr


def check_command_line(compiler, arguments, expression, folder):
    out = folder / "out"
    plain = folder / "plain_file"
    plain.write_text("untouched", encoding="utf-8")
    empty = folder / "empty.cpp"
    empty.write_bytes(b"")
    binary = folder / "binary.cpp"
    binary.write_bytes(bytes(range(256)) * 64)
    values = {"out": str(out), "source": str(KERNEL), "file": str(plain), "folder": str(folder), "empty": str(empty),
              "binary": str(binary)}
    there = {path.name for path in folder.iterdir()} | {"out"}
    result = run(compiler, [a.format(**values) for a in arguments])
    problems = judge(result, out)
    new = {path.name for path in folder.iterdir()} - there
    if new:
        problems.append(f"wrote {sorted(new)} beside the output folder")
    if plain.read_text(encoding="utf-8") != "untouched":
        problems.append("changed a file it should not")
    expression = expression.format(**{k: re.escape(v) for k, v in values.items()})
    if result is not None and not re.search(expression, result.stderr, re.DOTALL):
        problems.append(f"does not say {expression!r}")
    return problems, "" if result is None else result.stderr


def check_write_protected(compiler, folder):
    """A folder that cannot be written; only meaningful when not root, so /proc stands in."""
    result = run(compiler, [str(KERNEL), "--top", "fir", "-o", "/proc/epiline"])
    problems = judge(result, folder / "out")
    if result is not None and "/proc/epiline" not in result.stderr:
        problems.append("does not name the folder")
    return problems, "" if result is None else result.stderr


def check_crash(compiler, kind, folder):
    """An error of the compiler itself: one line, and a folder with all that is needed to see it again."""
    out = folder / "out"
    temporary = folder / "temporary"
    temporary.mkdir()
    environment = dict(os.environ, TMPDIR=str(temporary))
    result = subprocess.run([compiler, str(KERNEL), "--top", "fir", "-o", str(out), "--crash", kind], timeout=60,
                            capture_output=True, text=True, env=environment, check=False)
    problems = [] if result.returncode == 70 else [f"exit code {result.returncode}, not 70"]
    if not clean(out):
        problems.append("left output")
    told = re.fullmatch(r"error: this is an error of epiline-hls: .*: please report it with the source and the command "
                        r"in (/.*)\n", result.stderr)
    if not told:
        return problems + ["does not tell where the reproducer is"], result.stderr
    saved = pathlib.Path(told.group(1))
    if str(KERNEL) not in (saved / "command.txt").read_text(encoding="utf-8"):
        problems.append("does not save the command")
    again = run(compiler, [str(saved / "source.cpp"), "--top", "fir", "-o", str(out)])
    if again is None or again.returncode != 0 or not (out / "fir.v").is_file():
        problems.append("the saved source does not compile: " + ("" if again is None else again.stderr))
    return problems, result.stderr


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__.split("\n\n")[1])
    compiler, only = sys.argv[1], sys.argv[2:]
    checks = []
    for source in sorted((HERE / "errors").glob("*.cpp")):
        checks.append((source.stem, lambda f, s=source: check_source(compiler, s, f)))
    for name, arguments, expression in COMMAND_LINES:
        checks.append((name, lambda f, a=arguments, e=expression: check_command_line(compiler, a, e, f)))
    for kind in ("exception", "fatal", "signal", "stack"):
        checks.append(("crash by " + kind, lambda f, k=kind: check_crash(compiler, k, f)))
    checks.append(("write-protected output", lambda f: check_write_protected(compiler, f)))
    bad = 0
    total = 0
    for name, check in checks:
        if only and name not in only:
            continue
        total += 1
        with tempfile.TemporaryDirectory() as folder:
            problems, message = check(pathlib.Path(folder))
        if problems:
            bad += 1
            print(f"FAILED {name}: {'; '.join(problems)}\n    message: {message.strip()[:600]}", flush=True)
        elif only:
            print(message)
    print(f"{total - bad} of {total} refused as they should be")
    sys.exit(1 if bad or not total else 0)


if __name__ == "__main__":
    main()
