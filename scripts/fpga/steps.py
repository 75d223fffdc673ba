"""Steps that are done once: each makes a folder, under a temporary name until it is complete, and keeps it under a key.

A key is a hash of all that the step's result hangs on. A folder that is there with the same key is not made again; one
with another key, or whose files are not the size they had, is.
"""

import ctypes
import dataclasses
import errno
import fcntl
import hashlib
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import time

from flow_error import flow_error

heartbeat_seconds = 30


class progress:
    """Lines with the time since the start."""

    def __init__(self, start=None):
        self.start = time.monotonic() if start is None else start

    def say(self, text):
        elapsed = int(time.monotonic() - self.start)
        print(f"[{elapsed // 60}:{elapsed % 60:02}] {text}", flush=True)


def digest(*parts):
    """Of files (pathlib.Path: their contents) and of anything that JSON can hold."""
    total = hashlib.sha256()
    for part in parts:
        if isinstance(part, pathlib.Path):
            total.update(hashlib.sha256(part.read_bytes()).digest())
        else:
            total.update(json.dumps(part, sort_keys=True).encode() + b"\0")
    return total.hexdigest()


@dataclasses.dataclass
class program:
    """A program to run as part of a step."""

    title: str
    command: list
    folder: pathlib.Path  # where it runs
    log: pathlib.Path  # its standard output and standard error
    environment: dict = dataclasses.field(default_factory=dict)
    phases: tuple = ()  # (regular expression of a line of the log, what to say)
    followed: pathlib.Path = None  # the log with those lines, where it is another one


libc = ctypes.CDLL(None)
end_with_parent = 1  # PR_SET_PDEATHSIG


class running:
    """A program that was started: reports its phases and, now and then, that it still runs."""

    def __init__(self, what, report):
        self.what, self.report = what, report
        self.started = self.spoken = time.monotonic()
        self.phase, self.seen = "", 0
        with open(what.log, "wb") as log:
            # A process group of its own: an interrupt reaches it, and all it started, through stop() only.
            self.process = subprocess.Popen(
                [str(word) for word in what.command],
                cwd=what.folder,
                stdin=subprocess.DEVNULL,
                stdout=log,
                stderr=subprocess.STDOUT,
                start_new_session=True,
                # If this process is killed, a placement of many minutes is of no use.
                preexec_fn=lambda: libc.prctl(end_with_parent, signal.SIGKILL),
                env={**os.environ, **what.environment},
            )

    def follow(self):
        """Looks at the log; True while the program runs."""
        alive = self.process.poll() is None
        try:
            with open(self.what.followed or self.what.log, "rb") as log:
                log.seek(self.seen)
                new = log.read()
        except FileNotFoundError:  # not yet
            new = b""
        complete = new.rfind(b"\n") + 1
        self.seen += complete
        phase = self.phase
        for line in new[:complete].decode(errors="replace").splitlines():
            for pattern, saying in self.what.phases:
                match = re.search(pattern, line)
                if match:
                    phase = match.expand(saying)
        now = time.monotonic()
        if alive and (phase != self.phase or now - self.spoken >= heartbeat_seconds):
            self.spoken = now
            if phase != self.phase or not phase:
                self.report.say(f"{self.what.title}: {phase or 'running'}")
            else:
                self.report.say(f"{self.what.title}: {phase}, {int(now - self.started)} s so far")
        self.phase = phase
        return alive

    def stop(self):
        if self.process.poll() is None:
            os.killpg(self.process.pid, signal.SIGKILL)
            self.process.wait()


def run_programs(programs, at_once, report, ended=lambda what, status, seconds: None):
    """Runs all of them, `at_once` at a time; calls ended(program, exit status, seconds) for each as it ends. An
    exception from there or an interrupt stops the others."""
    waiting, active = list(programs), []
    try:
        while waiting or active:
            while waiting and len(active) < at_once:
                active.append(running(waiting.pop(0), report))
            time.sleep(0.1)
            for one in [one for one in active if not one.follow()]:
                active.remove(one)
                ended(one.what, one.process.returncode, time.monotonic() - one.started)
    finally:
        for one in active:
            one.stop()


def explain_failure(log):
    """What a failed program's log says, in a sentence."""
    text = log.read_text(encoding="utf-8", errors="replace") if log.exists() else ""
    if "No space left on device" in text or os.strerror(errno.ENOSPC) in text:
        return f"the disk is full ({log.parent})"
    said = [line.strip() for line in text.splitlines() if re.search(r"\berror\b", line, re.IGNORECASE)]
    said = said or text.strip().splitlines()[:1]
    return "; ".join(dict.fromkeys(said[:3])) or "it said nothing"


class step_store:
    """The steps' folders below one folder, which one run at a time may use."""

    def __init__(self, folder, report):
        self.folder, self.report = folder, report
        try:
            folder.mkdir(parents=True, exist_ok=True)
            self.lock = open(folder / ".lock", "w", encoding="utf-8")
            fcntl.flock(self.lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError as error:
            raise flow_error(f"another run is at work in {folder}; name another folder with -o, or wait") from error
        for left in folder.glob(".partial-*"):  # of a run that was killed
            shutil.rmtree(left, ignore_errors=True)

    def kept(self, name, key):
        """The step's folder if it is there as it was finished with this key."""
        place = self.folder / name
        try:
            state = json.loads((place / "step.json").read_text(encoding="utf-8"))
            whole = state["key"] == key and all(
                (place / file).stat().st_size == size for file, size in state["files"].items()
            )
        except (OSError, ValueError, KeyError, TypeError):
            return None
        return place if whole else None

    def begin(self, name):
        """A fresh folder for the step's files."""
        partial = self.folder / f".partial-{name}-{os.getpid()}"
        shutil.rmtree(partial, ignore_errors=True)
        partial.mkdir()
        return partial

    def finish(self, name, key, partial, seconds):
        """Gives the complete folder its name."""
        files = {
            str(file.relative_to(partial)): file.stat().st_size for file in sorted(partial.rglob("*")) if file.is_file()
        }
        state = {"key": key, "seconds": round(seconds, 1), "files": files}
        (partial / "step.json").write_text(json.dumps(state, indent=1) + "\n", encoding="utf-8")
        place = self.folder / name
        if place.exists():
            old = self.folder / f".partial-old-{name}-{os.getpid()}"
            place.rename(old)
            partial.rename(place)
            shutil.rmtree(old, ignore_errors=True)
        else:
            partial.rename(place)
        return place

    def seconds(self, name):
        return json.loads((self.folder / name / "step.json").read_text(encoding="utf-8"))["seconds"]

    def fail(self, name, partial, sentence):
        """Keeps a failed step's logs, not its results, and ends the run."""
        for file in partial.rglob("*"):
            if file.is_file() and file.suffix not in (".log", ".out", ".txt"):
                file.unlink()
        place = self.folder / f"failed_{name}"
        shutil.rmtree(place, ignore_errors=True)
        partial.rename(place)
        raise flow_error(f"{sentence} (logs: {place})")

    def close(self):
        for left in self.folder.glob(f".partial-*-{os.getpid()}"):
            shutil.rmtree(left, ignore_errors=True)
        self.lock.close()


def check_space(folder, needed):
    """An error if the disk has less than `needed` bytes left."""
    free = shutil.disk_usage(folder).free
    if free < needed:
        raise flow_error(
            f"not enough space in {folder}: {free // 2**20} MB are free, the run needs up to "
            f"{-(-needed // 2**20)} MB; make room, or name another folder with -o"
        )
