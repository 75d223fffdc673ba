#!/usr/bin/env python3
"""The synthesized netlist does what the Verilog does: proved by Yosys for every input and every state, over all
registers and outputs, by induction; and proofs of faulty netlists, which must fail.

  prove_netlist_test.py WINDOW_MINIMUM.v    Verilog of modules/window_minimum.cpp

RAM cells have other names for their contents than the Verilog's arrays, so the proof has arrays as registers; what RAM
cells do is compared in simulation (tests/cosim/netlist_cells_test.cpp). Environment: YOSYS = the program that
synthesizes.
"""

import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

root = pathlib.Path(__file__).resolve().parents[2]
verilog = pathlib.Path(sys.argv.pop(1)).resolve()
top = "window_minimum"

proof = """
read_verilog rtl.v
hierarchy -top {top}
proc
memory -nomap
memory_map
flatten
opt_clean
rename {top} gold
design -stash gold
read_verilog +/ecp5/cells_sim.v
read_verilog netlist.v
hierarchy -top {top}
proc
flatten
opt_clean
rename {top} gate
design -stash gate
design -copy-from gold -as gold gold
design -copy-from gate -as gate gate
equiv_make gold gate equiv
hierarchy -top equiv
opt_clean
equiv_struct
equiv_induct -seq 3
equiv_status -assert
"""


def inverted(match):
    """A table of a LUT or of a carry cell with every bit the other way."""
    return f"{match[1]}{0xffff ^ int(match[2], 16):04x}"


# Faults, each as (what it is, regular expression, what takes its place); the first place it fits is taken.
faults = [
    ("a LUT of another function", r"(LUT4 #\(\s*\.INIT\(16'h)([0-9a-f]{4})", inverted),
    ("a carry cell of another function", r"(CCU2C #\((?:[^;](?!LUT4))*?\.INIT1\(16'h)([0-9a-f]{4})", inverted),
    ("a flip-flop without its enable", r"\.CE\((?!1'h)[^)]*\)", ".CE(1'h1)"),
    ("a flip-flop set by what clears it", r'\.REGSET\("RESET"\)([^;]*\.LSR\(rst\))', r'.REGSET("SET")\1'),
]


class netlist(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        place = tempfile.TemporaryDirectory()
        cls.addClassCleanup(place.cleanup)
        cls.folder = pathlib.Path(place.name)
        text = re.sub(
            r'ram_style = "(?:block|distributed)"', 'ram_style = "registers"', verilog.read_text(encoding="utf-8")
        )
        (cls.folder / "rtl.v").write_text(text, encoding="utf-8")
        ended = subprocess.run(
            [root / "scripts/synthesize.sh", "rtl.v", top, "-o", "out"],
            cwd=cls.folder,
            text=True,
            capture_output=True,
            check=False,
        )
        assert ended.returncode == 0, ended.stderr
        cls.text = (cls.folder / "out" / f"{top}_netlist.v").read_text(encoding="utf-8")

    def prove(self, text):
        """Whether this netlist is proved equal, and what Yosys says."""
        (self.folder / "netlist.v").write_text(text, encoding="utf-8")
        ended = subprocess.run(
            ["yosys", "-Q", "-T", "-p", proof.format(top=top)],
            cwd=self.folder,
            text=True,
            capture_output=True,
            check=False,
        )
        return ended.returncode == 0 and "Equivalence successfully proven!" in ended.stdout, ended.stdout + ended.stderr

    def test_is_equal_to_the_verilog(self):
        self.assertIn("CCU2C", self.text)
        proven, output = self.prove(self.text)
        self.assertTrue(proven, output[-3000:])
        self.assertGreater(int(re.search(r"Of those cells (\d+) are proven and 0 are unproven", output)[1]), 200)

    def test_a_faulty_one_is_not(self):
        for fault, pattern, replacement in faults:
            with self.subTest(fault):
                text, count = re.subn(pattern, replacement, self.text, count=1)
                self.assertEqual(count, 1)
                proven, output = self.prove(text)
                self.assertFalse(proven)
                self.assertRegex(output, r"ERROR: Found \d+ unproven \$equiv cells")


if __name__ == "__main__":
    unittest.main()
