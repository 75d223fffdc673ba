"""What the tests of epiline-hls --check have in common: a folder of their own, and the command."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
KERNELS = ROOT / "tests" / "compiler" / "kernels"
COMPILER = ""


class CheckTest(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.addCleanup(self.scratch.cleanup)
        self.folder = pathlib.Path(self.scratch.name)

    def check(self, source, top, *options, environment=None):
        """epiline-hls --check, run in the folder. Its output goes to `out` there."""
        return subprocess.run([COMPILER, str(source), "--top", top, "-o", "out", "--check", "--quiet", *options],
                              cwd=self.folder, capture_output=True, text=True, check=False, env=environment)

    @staticmethod
    def table(run):
        """The rows of the table: level -> (verdict, remark)."""
        rows = {}
        for line in run.stdout.splitlines():
            for verdict in ("run", "equal", "skipped", "DIFFERS"):
                level, found, remark = line.partition(f" {verdict} ")
                if found and " " not in level.strip():
                    rows[level.strip()] = (verdict, remark.strip())
        return rows


def main():
    global COMPILER
    COMPILER = sys.argv.pop(1)
    unittest.main(module="__main__")
