#!/usr/bin/env python3
"""tb/cosim/make_model.py: what it writes, and what it refuses. Takes the project's root as its argument."""

import copy
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(sys.argv.pop(1)) if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parents[2]

REPORT = {
    "interface": {
        "module": "top",
        "ports": [
            {"name": "in", "direction": "input", "kind": "stream", "width": 40, "valid": "s_axis_in_tvalid",
             "ready": "s_axis_in_tready",
             "fields": [{"signal": "tdata", "rtl": "s_axis_in_tdata", "width": 40, "offset": 0}]},
            {"name": "total", "direction": "output", "kind": "result", "width": 8, "valid": "m_axis_total_tvalid",
             "ready": "m_axis_total_tready",
             "fields": [{"signal": "tdata", "rtl": "m_axis_total__tdata", "width": 8, "offset": 0}]},
        ],
    }
}


class make_model(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def run_on(self, text, *arguments):
        (self.folder / "report.json").write_text(text, encoding="utf-8")
        return subprocess.run([sys.executable, ROOT / "tb/cosim/make_model.py", self.folder / "report.json", "thing",
                               self.folder / "out", *arguments], text=True, capture_output=True, check=False)

    def test_writes_the_factory_and_the_binding(self):
        result = self.run_on(json.dumps(REPORT))
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("make_thing_model(std::uint64_t seed)", (self.folder / "out/thing_model.hpp").read_text())
        source = (self.folder / "out/thing_model.cpp").read_text()
        self.assertIn('{"in", port_kind::stream, true, 40, {{"tdata", 40, 0}}}', source)
        self.assertIn('{"total", port_kind::result, false, 8, {{"tdata", 8, 0}}}', source)
        self.assertIn("put_field(top_->s_axis_in_tdata, words, 0, 40);", source)
        # Verilator's spelling of a double underscore.
        self.assertIn("get_field(top_->m_axis_total___05Ftdata, words, 0, 8);", source)

    def test_same_report_same_bytes(self):
        self.run_on(json.dumps(REPORT))
        first = (self.folder / "out/thing_model.cpp").read_bytes()
        self.run_on(json.dumps(REPORT))
        self.assertEqual((self.folder / "out/thing_model.cpp").read_bytes(), first)

    def test_refuses_what_is_no_report(self):
        cases = {"no JSON": "{", "no interface": "{}"}
        for key in ("direction", "kind", "width", "valid", "ready", "fields"):
            broken = copy.deepcopy(REPORT)
            del broken["interface"]["ports"][0][key]
            cases[key] = json.dumps(broken)
        sideways = copy.deepcopy(REPORT)
        sideways["interface"]["ports"][0]["direction"] = "inout"
        cases["direction inout"] = json.dumps(sideways)
        for name, text in cases.items():
            with self.subTest(name):
                result = self.run_on(text)
                self.assertNotEqual(result.returncode, 0)
                self.assertIn("report.json", result.stderr)
                self.assertFalse((self.folder / "out").exists())

    def test_refuses_wrong_arguments(self):
        self.assertIn("make_model.py REPORT.json NAME FOLDER", self.run_on(json.dumps(REPORT), "more").stderr)


if __name__ == "__main__":
    unittest.main()
