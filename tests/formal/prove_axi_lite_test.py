#!/usr/bin/env python3
"""AXI4-Lite's rules of the register slave, proved for every master by temporal induction; and proofs that must fail.

  prove_axi_lite_test.py COUNT_UP.v    Verilog of tests/cosim/modules/count_up.cpp, made with --axi-lite
"""

import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

PROPERTIES = pathlib.Path(__file__).resolve().parent / "axi_lite_properties.v"
VERILOG = pathlib.Path(sys.argv.pop(1))

# Faults, each as (what it is, regular expression, what takes its place).
FAULTS = [
    ("a response that is not waited for", r"write \| \(s_axi_bvalid & ~s_axi_bready\)", "write"),
    ("a write over a response that waits", r"(assign write = aw_there & w_there) & .*;", r"\1;"),
    ("a write without its data", r"assign write = aw_there & w_there &", "assign write = aw_there &"),
    ("a read over data that wait", r"assign read = ar_there & .*;", "assign read = ar_there;"),
    ("data with an error", r"s_axi_rdata <= 32'd0;", "s_axi_rdata <= calls;"),
    ("a start that stays", r"if \(started\) start <= 1'b0;", ""),
    ("arguments written before the address is there", r"    if \(write\) begin", "    if (w_there) begin"),
    ("no reset of a control bit", r"      keep <= 1'b0;", ""),
    ("two addresses taken for one place", r"s_axi_arready <= ~ar_waits", "s_axi_arready <= ~ar_there"),
    ("a response that does not exist", r"s_axi_bresp <= slave_error", "s_axi_bresp <= 2'b11"),
]


def prove(verilog):
    """Whether the proof succeeds, and Yosys' output."""
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "slave.v").write_text(verilog, encoding="utf-8")
        (pathlib.Path(folder) / "properties.v").write_text(PROPERTIES.read_text(encoding="utf-8"), encoding="utf-8")
        result = subprocess.run(
            ["yosys", "-Q", "-T", "-p", "read_verilog slave.v; read_verilog -formal properties.v; "
             "prep -top axi_lite_properties; flatten; opt_clean; "
             "sat -verify -prove-asserts -tempinduct -maxsteps 12 -seq 1"],
            text=True, capture_output=True, check=False, cwd=folder)
    return result.returncode == 0 and "Induction step proven: SUCCESS!" in result.stdout, result.stdout + result.stderr


class axi_lite_proof(unittest.TestCase):
    def test_the_slave_keeps_the_rules(self):
        proven, output = prove(VERILOG.read_text(encoding="utf-8"))
        self.assertTrue(proven, output[-3000:])

    def test_a_faulty_slave_does_not(self):
        for fault, pattern, replacement in FAULTS:
            with self.subTest(fault):
                verilog, count = re.subn(pattern, replacement, VERILOG.read_text(encoding="utf-8"))
                self.assertEqual(count, 1)
                proven, output = prove(verilog)
                self.assertFalse(proven)
                self.assertIn("proof did fail", output)


if __name__ == "__main__":
    unittest.main()
