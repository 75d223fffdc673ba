"""Faults of every level in single programs of one batch: each is named, as that program's, at that level.

test_fuzz_faults.py COMPILER CHECKER VERILATED CXX
"""

import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

from generator.drivers import driver  # noqa: E402

COMPILER, CHECKER, VERILATED, CXX = sys.argv[1:5]

PROGRAM = """#include "ap_int.h"
#include "hls_stream.h"
void {name}(hls::stream<ap_uint<8>>& in0, hls::stream<ap_int<10>>& out0) {{
#pragma HLS PIPELINE II=1
  const ap_uint<8> a = in0.read();
  out0.write({value});
}}
"""
SUBTRACTS = "a - (a >> 3)"
VALUES = {
    "all_right": SUBTRACTS,
    "wrong_verilog": SUBTRACTS,
    "wrong_graph": SUBTRACTS,
    "compilers_disagree": "a + COMPILER",
    "refused_program": "a + int(0.5f * int(a))",
    "does_not_compile": "a + unknown_name",
    "right_again": "a & 15",
}
FAULTS = "wrong_verilog:RTL,wrong_graph:graph"


class faults(unittest.TestCase):
    def test_each_is_found_in_its_program_at_its_level(self):
        with tempfile.TemporaryDirectory() as root:
            root = pathlib.Path(root)
            port = {"members": [], "axis": False}
            ports = [{**port, "name": "in0", "input": True, "type": "ap_uint<8>"},
                     {**port, "name": "out0", "input": False, "type": "ap_int<10>"}]
            for name, value in VALUES.items():
                text = PROGRAM.format(name=name, value=value)
                text = text.replace("COMPILER", "\n#ifdef __clang__\n1\n#else\n2\n#endif\n")
                (root / f"{name}.cpp").write_text(text, encoding="utf-8")
                (root / f"{name}.drive.cpp").write_text(driver(name, ports, [], [], 40, 2), encoding="utf-8")
            run = subprocess.run(
                [sys.executable, "-B", str(HERE / "run_batch.py"), "--compiler", str(HERE / "faulty_compiler.py"),
                 "--checker", CHECKER, "--verilated", VERILATED, "--cxx", CXX, "--also-native", "g++",
                 "--model-flags=-O0", "--group", "50", "--work", str(root / "work"), "--json", str(root / "result.json"),
                 "files", str(root), *VALUES],
                env={**os.environ, "EPILINE_HLS": COMPILER, "EPILINE_FAULTS": FAULTS}, capture_output=True, text=True,
                check=False)
            self.assertEqual(run.returncode, 1, run.stdout + run.stderr)
            found = json.loads((root / "result.json").read_text(encoding="utf-8"))["programs"]
            self.assertEqual({name: program.get("level") for name, program in found.items()},
                             {"all_right": None, "right_again": None, "wrong_verilog": "RTL", "wrong_graph": "graph",
                              "compilers_disagree": "native", "refused_program": "compiler",
                              "does_not_compile": "native"}, run.stdout + run.stderr)
            self.assertIn("token", found["wrong_verilog"]["text"])
            self.assertIn("disagree", found["compilers_disagree"]["text"])
            self.assertEqual(len(list((root / "work" / "groups").iterdir())), 1)  # in one model


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
