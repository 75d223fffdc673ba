"""scripts/frame_rates.py with programs of the test's own in place of epiline and epiline-hls."""

import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

script = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "frame_rates.py"

# Lists two designs, and "counts" width * height + 7 clocks.
epiline = """#!{python}
import json, pathlib, sys
words = sys.argv[1:]
if words == ["match", "--list"]:
    for name, width in (("narrow", 500), ("wide", 1024)):
        print(f"{{name}}: a design\\n  images up to {{width}}x4095, levels 1 to 80 (default 80), 2 pixel(s) a beat")
        print("  parameters (--set NAME=VALUE):")
    sys.exit(0)
option = {{words[i]: words[i + 1] for i in range(len(words) - 1)}}
assert option["--engine"] == "rtl"
if "{failing}" == option["--design"]:
    print("epiline: error: the model is stuck", file=sys.stderr)
    sys.exit(1)
header = pathlib.Path(words[words.index("--levels") - 1]).read_bytes().split(b"\\n")
width, height = (int(side) for side in header[1].split())
pathlib.Path(option["--json"]).write_text(json.dumps({{"cycles": width * height + 7}}))
"""
compiler = """#!{python}
import json, pathlib, sys
folder = pathlib.Path(sys.argv[sys.argv.index("-o") + 1])
folder.mkdir()
(folder / "report.json").write_text(json.dumps({{"clock": {{"period_ns": 6, "estimated_period_ns": 5}}}}))
"""


class frame_rates(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.folder = pathlib.Path(place.name)
        self.output = self.folder / "timing.json"
        self.write_programs()

    def write_programs(self, failing=""):
        for name, text in (("epiline", epiline), ("epiline-hls", compiler)):
            program = self.folder / name
            program.write_text(text.format(python=sys.executable, failing=failing))
            os.chmod(program, 0o755)

    def run_script(self, *arguments):
        command = [sys.executable, str(script), "--programs", str(self.folder), "-o", str(self.output), *arguments]
        return subprocess.run(command, capture_output=True, text=True)

    def test_writes_clock_and_clocks_of_every_size_that_fits(self):
        ended = self.run_script()
        self.assertEqual(ended.returncode, 0, ended.stderr)
        written = json.loads(self.output.read_text())
        self.assertEqual(written["schema"], "epiline-timing/1")
        self.assertEqual(sorted(written["designs"]), ["narrow", "wide"])
        wide = written["designs"]["wide"]
        self.assertAlmostEqual(wide["clock"]["megahertz"], 200)
        self.assertIn("before place and route", wide["clock"]["source"])
        self.assertIn("pixels a beat: 2", wide["cycles_source"])
        self.assertIn({"width": 640, "height": 480, "levels": 80, "cycles": 640 * 480 + 7}, wide["frames"])
        self.assertEqual(len(wide["frames"]), 6)  # all but 1280x1024
        self.assertEqual([frame["width"] for frame in written["designs"]["narrow"]["frames"]], [320, 384, 434])
        self.assertIn("narrow 640x480: left out", ended.stdout)

    def test_measures_the_designs_asked_for(self):
        self.assertEqual(self.run_script("--design", "narrow").returncode, 0)
        self.assertEqual(list(json.loads(self.output.read_text())["designs"]), ["narrow"])

    def expect_error(self, part, *arguments):
        ended = self.run_script(*arguments)
        self.assertEqual(ended.returncode, 1)
        self.assertRegex(ended.stderr, r"^frame_rates.py: error: .*\n$")
        self.assertIn(part, ended.stderr)
        self.assertFalse(self.output.exists())

    def test_names_what_is_wrong_and_writes_nothing(self):
        self.expect_error("unknown design 'none'; designs: narrow, wide", "--design", "none")
        self.write_programs(failing="wide")
        self.expect_error("the model is stuck")
        self.output = self.folder / "missing" / "timing.json"
        self.expect_error("is not a folder")
        self.output = self.folder / "timing.json"
        (self.folder / "epiline").unlink()
        self.expect_error("build it first")


if __name__ == "__main__":
    unittest.main()
