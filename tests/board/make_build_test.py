#!/usr/bin/env python3
"""boards/make_build.py: the PLL's dividers, what the board says of itself, and one error for everything that does not fit.

Takes the project's root as its argument.
"""

import copy
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(sys.argv.pop(1)) if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "boards"))
import make_build  # noqa: E402

BOARD = json.loads((ROOT / "boards/ulx3s_85f/board.json").read_text(encoding="utf-8"))
CORES = json.loads((ROOT / "boards/cores.json").read_text(encoding="utf-8"))


def field(name, signal, rtl, width):
    return {"name": name, "signal": signal, "rtl": rtl, "width": width, "offset": 0}


def stream(name, direction, width):
    prefix = ("s_axis_" if direction == "input" else "m_axis_") + name
    return {"name": name, "kind": "stream", "direction": direction, "valid": prefix + "_tvalid", "ready": prefix + "_tready",
            "fields": [field(name, "tdata", prefix + "_tdata", width), field(name, "tlast", prefix + "_tlast", 1)]}


REPORT = {"interface": {"module": "color_fuzzy_small", "ports": [
    stream("left", "input", 24), stream("right", "input", 24), stream("disparity", "output", 8),
    {"name": "call", "kind": "call", "direction": "input", "valid": "call_tvalid", "ready": "call_tready",
     "fields": [field("width", "width", "width", 7), field("height", "height", "height", 8),
                field("levels", "levels", "levels", 4)]}]}}


class build(unittest.TestCase):
    def test_dividers_are_those_of_ecppll(self):
        # yowasp-ecppll 1.4 -i 25 -o CLOCK
        self.assertEqual(make_build.pll_dividers(25, 100), (1, 4, 6))
        self.assertEqual(make_build.pll_dividers(25, 125), (1, 5, 5))
        self.assertEqual(make_build.pll_dividers(25, 150), (1, 6, 4))

    def test_dividers_make_the_clock_within_the_limits_of_the_oscillator(self):
        for clock in (20, 62.5, 80, 110, 112.5, 133.333333333333, 137.5, 160, 200):
            with self.subTest(clock):
                reference, feedback, output = make_build.pll_dividers(25, clock)
                self.assertAlmostEqual(25 / reference * feedback, clock, delta=1e-4)
                self.assertTrue(400 <= clock * output <= 800)

    def test_a_clock_that_cannot_be_made_is_an_error(self):
        for clock in (1, 1000, 100.00123):
            with self.assertRaisesRegex(make_build.build_error, "the PLL cannot make"):
                make_build.pll_dividers(25, clock)

    def test_one_clock_sets_the_pll_the_identity_and_the_serial_rate(self):
        board = dict(BOARD, core_clock_mhz=150)
        text = make_build.make(board, REPORT, CORES)
        self.assertIn(".FEEDBACK_DIVIDER(6)", text)
        self.assertIn(".OUTPUT_DIVIDER(4)", text)
        self.assertIn("clock=150000000;", text)
        self.assertIn(".INITIAL_PERIOD(800)", text)
        identity = re.search(r'\.IDENTITY\("(.*)"\)', text).group(1)
        self.assertIn(f".IDENTITY_BYTES({len(identity)})", text)
        self.assertIn("core=color_fuzzy_small;design=color_fuzzy;lanes=1;size=64x255x8;", identity)
        self.assertTrue(identity.endswith("call=width,height,levels"), identity)

    def expect_error(self, change, message, cores=None):
        report = copy.deepcopy(REPORT)
        change(report["interface"])
        with self.assertRaisesRegex(make_build.build_error, message):
            make_build.make(BOARD, report, cores or CORES)

    def test_a_design_that_does_not_fit_is_an_error(self):
        self.expect_error(lambda i: i.update(module="scale"), "'scale' is not in boards/cores.json")
        self.expect_error(lambda i: i.update(registers={}), "without --axi-lite")
        self.expect_error(lambda i: i["ports"].append(stream("more", "input", 8)), "port 'more' .* has no part")
        self.expect_error(lambda i: i["ports"].pop(0), "no stereo design")
        self.expect_error(lambda i: i["ports"][0]["fields"][0].update(width=48), "streams of")
        self.expect_error(lambda i: i["ports"][3]["fields"][0].update(width=17), "has 17 bits, the board 16")
        self.expect_error(lambda i: i["ports"][3]["fields"][0].update(width=6), "max_width of 'color_fuzzy_small'")

    def test_the_program_writes_the_whole_file_or_none(self):
        with tempfile.TemporaryDirectory() as folder:
            report, output = pathlib.Path(folder) / "report.json", pathlib.Path(folder) / "build.v"
            program = [sys.executable, str(ROOT / "boards/make_build.py"), "--board",
                       str(ROOT / "boards/ulx3s_85f/board.json"), "--report", str(report), "-o", str(output)]
            result = subprocess.run(program, capture_output=True, text=True, check=False)
            self.assertNotEqual(result.returncode, 0)
            self.assertRegex(result.stderr, r"^make_build.py: error: cannot read '.*report.json'")
            self.assertFalse(output.exists())
            report.write_text(json.dumps(REPORT), encoding="utf-8")
            subprocess.run(program, check=True)
            self.assertIn("module epiline_board_build", output.read_text(encoding="utf-8"))

    def test_the_board_lists_files_that_are_there(self):
        folder = ROOT / "boards/ulx3s_85f"
        for name in BOARD["sources"] + [BOARD["constraints"]]:
            self.assertTrue((folder / name).exists(), name)
        self.assertIn(BOARD["generated_top"], CORES)


if __name__ == "__main__":
    unittest.main()
