"""The command line of Yosys over the Python package pyosys, which brings the library only.

Understands what this project and edalize call: -V, -Q, -T, -q, -l FILE, -p COMMANDS, -s SCRIPT, -c TCL_SCRIPT, SCRIPT.
"""

import os
import sys


def main(arguments):
    # Read first: pyosys prints a banner when it is loaded.
    log, commands, quiet, version = None, [], False, False
    words = iter(arguments)
    for word in words:
        if word in ("-l", "-p", "-s", "-c"):
            value = next(words, None)
            if value is None:
                sys.exit(f"yosys: error: {word} needs a value")
            if word == "-l":
                log = value
            else:
                commands.append({"-p": "", "-s": "script ", "-c": "tcl "}[word] + value)
        elif word == "-q":
            quiet = True
        elif word in ("-V", "--version"):
            version = True
        elif word in ("-Q", "-T"):
            pass
        elif word.startswith("-"):
            sys.exit(f"yosys: error: unknown argument '{word}'")
        else:
            commands.append(("tcl " if word.endswith(".tcl") else "script ") + word)
    if any(command.startswith("tcl ") for command in commands):
        # pyosys is built without Tcl, which edalize's scripts are written in.
        print("yosys: a Tcl script, which pyosys cannot run: Debian's Yosys takes it", file=sys.stderr)
        os.execv("/usr/bin/yosys", ["yosys", *arguments])
    # Yosys logs to standard output; errors go to standard error, too.
    terminal = os.dup(1)
    target = os.open(log or os.devnull, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o666)
    if log or quiet or version:
        os.dup2(target, 1)
    from pyosys import libyosys

    if version:
        os.write(terminal, (libyosys.yosys_maybe_version() + "\n").encode())
        return
    design = libyosys.Design()
    for command in commands:
        libyosys.run_pass(command, design)


if __name__ == "__main__":
    main(sys.argv[1:])
