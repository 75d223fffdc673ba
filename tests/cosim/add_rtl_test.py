#!/usr/bin/env python3
"""cmake/EpilineAddRtl.cmake: wrong arguments end the configuration with one error that names function, target and argument.

Takes the project's root as its argument.
"""

import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(sys.argv.pop(1)) if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parents[2]

# No language is enabled, and Verilator's library is already there: configuring compiles nothing.
PROJECT = """cmake_minimum_required(VERSION 3.25)
project(wrong_arguments LANGUAGES NONE)
add_library(epiline_verilated INTERFACE)
include({root}/cmake/EpilineAddRtl.cmake)
{call}
"""

WRONG = [
    ("epiline_add_rtl(thing TOP top)", "epiline_add_rtl(thing): SOURCE is missing"),
    ("epiline_add_rtl(thing SOURCE top.cpp)", "epiline_add_rtl(thing): TOP is missing"),
    ("epiline_add_rtl(thing TOP top SOURCE top.cpp CLOCK)", "epiline_add_rtl(thing): no value after CLOCK"),
    ("epiline_add_rtl(thing AXILITE TOP top SOURCE top.cpp)", "epiline_add_rtl(thing): unknown argument AXILITE"),
    ("epiline_add_rtl(thing TOP top SOURCE top.cpp OPTIONS --axi-lite)",
     "epiline_add_rtl(thing): write AXI_LITE instead of OPTIONS --axi-lite"),
    ("epiline_add_verilog_model(thing TOP top VERILOG top.v)", "epiline_add_verilog_model(thing): REPORT is missing"),
    ("epiline_add_netlist_model(thing TOP top REPORT report.json)",
     "epiline_add_netlist_model(thing): VERILOG is missing"),
    ("epiline_add_netlist_library(thing)", "epiline_add_netlist_library(thing): RTL is missing"),
]


class wrong_arguments(unittest.TestCase):
    def configure(self, call):
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "CMakeLists.txt").write_text(PROJECT.format(root=ROOT.as_posix(), call=call),
                                                                 encoding="utf-8")
            result = subprocess.run(["cmake", "-S", folder, "-B", folder + "/build"], text=True, capture_output=True,
                                    check=False)
        return result.returncode, " ".join(result.stderr.split())

    def test_nothing_is_wrong_with_the_project_itself(self):
        self.assertEqual(self.configure(""), (0, ""))

    def test_one_error_says_what_is_wrong(self):
        for call, message in WRONG:
            with self.subTest(call):
                code, errors = self.configure(call)
                self.assertNotEqual(code, 0)
                self.assertIn(message, errors)
                self.assertEqual(errors.count("CMake Error"), 1, errors)


if __name__ == "__main__":
    unittest.main()
