#!/usr/bin/env python3
"""The commands of docs/board.md as a user types them, against the simulated board.

Takes the programs epiline and epiline_board_simulator as its arguments.
"""

import json
import pathlib
import random
import subprocess
import sys
import tempfile
import unittest

SIMULATOR = sys.argv.pop()
EPILINE = sys.argv.pop()


class command(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.addCleanup(self.scratch.cleanup)
        self.folder = pathlib.Path(self.scratch.name)
        numbers = random.Random(1)
        rows = [[bytes(numbers.randrange(256) for _ in range(3)) for _ in range(44)] for _ in range(10)]
        for name, shift in (("left", 0), ("right", 3)):
            pixels = b"".join(b"".join(row[shift : shift + 40]) for row in rows)
            (self.folder / f"{name}.ppm").write_bytes(b"P6\n40 10\n255\n" + pixels)
        self.port = str(self.folder / "board")
        self.simulator = subprocess.Popen([SIMULATOR, "--link", self.port], stdout=subprocess.PIPE, text=True)
        self.addCleanup(self.stop)
        self.assertEqual(self.simulator.stdout.readline(), f"color_fuzzy_small at {self.port}\n")

    def stop(self):
        self.simulator.terminate()
        self.simulator.wait()
        self.simulator.stdout.close()

    def epiline(self, *arguments):
        return subprocess.run([EPILINE, *arguments, "--port", self.port, "--patience", "60000"], cwd=self.folder, text=True,
                              capture_output=True, check=False)

    def test_match_writes_the_same_file_as_native(self):
        pictures = ["left.ppm", "right.ppm", "--levels", "8"]
        for engine in ("board", "native"):
            result = self.epiline("match", "--engine", engine, *pictures, "-o", engine + ".pfm")
            self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual((self.folder / "board.pfm").read_bytes(), (self.folder / "native.pfm").read_bytes())

    def test_self_test_proves_the_rate(self):
        result = self.epiline("board", "self-test", "--frames", "3", "--width", "50", "--height", "20", "--json", "test.json")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("equal", result.stdout)
        figures = json.loads((self.folder / "test.json").read_text(encoding="utf-8"))
        self.assertTrue(figures["equal"])
        self.assertEqual(figures["clock_hz"], 1e8)
        self.assertGreater(figures["clocks_a_frame"], 50 * 20)
        self.assertAlmostEqual(figures["frames_per_second"], 1e8 / figures["clocks_a_frame"], places=3)

    def test_identify_says_what_the_board_holds(self):
        result = self.epiline("board", "identify")
        self.assertEqual(result.stdout, "ulx3s_85f: color_fuzzy_small (design color_fuzzy), 1 pixel a clock, up to 64x255, "
                                        "8 levels, 100 MHz\n")

    def test_an_error_is_one_line_and_leaves_no_file(self):
        self.stop()
        result = self.epiline("match", "--engine", "board", "left.ppm", "right.ppm", "--levels", "8", "-o", "map.pfm")
        self.assertEqual(result.returncode, 1)
        self.assertRegex(result.stderr, r"\Aepiline: error: there is no serial port '.*'.*\n\Z")
        self.assertFalse((self.folder / "map.pfm").exists())
        self.simulator = subprocess.Popen(["true"], stdout=subprocess.PIPE, text=True)


if __name__ == "__main__":
    unittest.main()
