"""scripts/fpga.sh with its real tools: a small design from C++ to a bitstream, killed once on the way.

The environment names the build folder (EPILINE_BUILD) and the folder of the pinned tools (EPILINE_FPGA_TOOLS).
"""

import json
import os
import pathlib
import re
import signal
import subprocess
import tempfile
import time
import unittest

root = pathlib.Path(__file__).resolve().parents[2]
top = "color_fuzzy_small"
command = [str(root / "scripts" / "fpga.sh"), top, "--target", "ecp5-25k", "--clock", "12", "--seeds", "1", "-o", "out"]
idcode_25f = bytes.fromhex("41111043")


class place_and_route(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.folder = pathlib.Path(place.name)
        self.out = self.folder / "out"

    def kill_while_routing(self):
        """Starts the run and kills it when nextpnr is at work."""
        log = open(self.folder / "first.log", "w+", encoding="utf-8")
        self.addCleanup(log.close)
        process = subprocess.Popen(
            command, cwd=self.folder, stdout=log, stderr=subprocess.STDOUT, start_new_session=True
        )
        placing = False
        while not placing and process.poll() is None:
            time.sleep(0.2)
            placing = "seed 1: placing" in (self.folder / "first.log").read_text(encoding="utf-8")
        self.assertTrue(placing, (self.folder / "first.log").read_text(encoding="utf-8"))
        process.send_signal(signal.SIGKILL)
        process.wait()

    def test_from_source_to_bitstream_over_a_kill(self):
        self.kill_while_routing()
        self.assertTrue((self.out / "synthesis" / "step.json").exists())
        self.assertFalse((self.out / "seed_1").exists())
        self.assertFalse((self.out / f"{top}.json").exists())

        ended = subprocess.run(command, cwd=self.folder, capture_output=True, text=True, check=False)
        self.assertEqual(ended.returncode, 0, ended.stdout + ended.stderr)
        self.assertIn("synthesis: kept", ended.stdout)
        self.check_figures()
        self.check_bitstream()

    def test_the_small_device(self):
        ended = subprocess.run(
            [
                command[0],
                f"{root}/tests/formal/modules/window_minimum.cpp:window_minimum",
                "--target",
                "hx8k",
                "--clock",
                "20",
                "--seeds",
                "1",
                "-o",
                "out",
            ],
            cwd=self.folder,
            capture_output=True,
            text=True,
            check=False,
        )
        self.assertEqual(ended.returncode, 0, ended.stdout + ended.stderr)
        run = json.loads((self.out / "window_minimum.json").read_text(encoding="utf-8"))
        self.assertGreater(run["fmax_mhz"]["median"], 50)
        log = (self.out / "seed_1" / "nextpnr.log").read_text(encoding="utf-8")
        cells = int(re.search(r"ICESTORM_LC: +(\d+)/", log)[1])
        self.assertEqual(run["resources"]["after_packing"]["logic_cells"], cells)
        self.assertLess(run["resources"]["lut4"], cells)
        self.assertGreater(run["resources"]["flip_flops"], 50)
        bits = (self.out / "window_minimum.bin").read_bytes()
        self.assertEqual(len(bits), 135100)  # every bitstream of this device
        self.assertIn(bytes.fromhex("7eaa997e"), bits[:64])  # the word that a bitstream is found by

    def check_figures(self):
        run = json.loads((self.out / f"{top}.json").read_text(encoding="utf-8"))
        log = (self.out / "seed_1" / "nextpnr.log").read_text(encoding="utf-8")
        # nextpnr's own words: the last frequency is after routing, the sum of LUT4 before packing.
        frequency = re.findall(r"Max frequency for clock .*: ([\d.]+) MHz", log)[-1]
        self.assertAlmostEqual(run["fmax_mhz"]["median"], float(frequency), places=2)
        self.assertGreater(run["fmax_mhz"]["median"], run["clock"]["wanted_mhz"])
        self.assertEqual(run["resources"]["lut4"], int(re.search(r"Total LUT4s: +(\d+)/", log)[1]))
        self.assertEqual(run["resources"]["flip_flops"], int(re.search(r"Total DFFs: +(\d+)/", log)[1]))
        self.assertGreater(run["resources"]["block_rams"], 0)
        path = run["seeds"][0]["critical_path"]
        self.assertAlmostEqual(1000 / path["period_ns"], run["fmax_mhz"]["median"], delta=0.5)
        lines = [hop["source"] for hop in path["hops"] if hop["source"]]
        self.assertTrue(lines, "no part of the critical path has a line of the source")
        for line in lines:
            name, number = line.split(":")
            found = list((root / "hls").rglob(name))
            self.assertTrue(found and any(len(file.read_text().splitlines()) >= int(number) for file in found), line)

    def check_bitstream(self):
        bits = (self.out / f"{top}.bit").read_bytes()
        self.assertGreater(len(bits), 50000)
        header = bits[:512]
        self.assertTrue(header.startswith(b"\xff\x00"), header[:16])
        self.assertIn(b"LFE5U-25F", header)
        self.assertIn(b"\xbd\xb3", header)  # the preamble, and the device's number behind it
        self.assertIn(idcode_25f, header)
        # Unpacked again it has every wire and every LUT of what nextpnr wrote.
        unpack = pathlib.Path(os.environ["EPILINE_FPGA_TOOLS"]) / "bin" / "ecpunpack"
        subprocess.run([unpack, self.out / f"{top}.bit", self.out / "unpacked.config"], check=True, capture_output=True)
        routed, unpacked = (
            settings_of(file.read_text(encoding="utf-8"))
            for file in (self.out / "seed_1" / f"{top}.config", self.out / "unpacked.config")
        )
        missing = routed - unpacked
        self.assertFalse(missing, f"{len(missing)} of {len(routed)} settings are missing, as {sorted(missing)[:3]}")
        self.assertGreater(len(routed), 10000)


def settings_of(text):
    """{(tile, arc or table of a LUT)} of a configuration in Trellis's text format, without what has no bits: the ways
    out of a slice or a pad, which are fixed or follow from others, and LUTs of ones, as an empty device has them."""
    tile, found = "", set()
    for line in text.splitlines():
        line = line.rstrip()
        if line.startswith(".tile "):
            tile = line
        elif re.match(r"arc: (?!.*_(?:SLICE|PIO)$)", line) or re.match(r"word: SLICE\w\.K\d\.INIT (?!1+$)", line):
            found.add((tile, line))
    return found


if __name__ == "__main__":
    unittest.main()
