"""Runs one program of a YoWASP package: yowasp_program.py PACKAGE FUNCTION ARGUMENT...

YoWASP gives its programs a /tmp of their own, so the real one is shown to them under another name.
"""

import importlib
import os
import sys


def mounts():
    """YoWASP's list of folders to show: everything below / under its name but for /tmp; the root is the current folder,
    since a WebAssembly program looks there for relative names."""
    folders = [f"/{name}" for name in sorted(os.listdir("/"))]
    shown = [folder for folder in folders if os.path.isdir(folder) and os.access(folder, os.R_OK | os.X_OK)]
    return ":".join(
        ["/=" + os.getcwd(), "/host_tmp=/tmp"]
        + [f"{folder}={folder}" for folder in shown if folder not in ("/tmp", "/proc", "/sys")]
    )


def as_shown(word):
    """An argument as the program must see it."""
    if word == ".." or word.startswith("../"):
        word = os.path.abspath(word)
    return "/host_tmp" + word[len("/tmp") :] if word.startswith("/tmp/") else word


def main(arguments):
    package, function, *words = arguments
    os.environ["YOWASP_MOUNT"] = mounts()
    return getattr(importlib.import_module(package), function)([as_shown(word) for word in words])


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
