"""A bench for scripts/fpga.sh: stand-ins for the compiler, nextpnr and the packer, which are quick and fail on demand.

Yosys is the real one of Debian's. The stand-ins obey files in the bench's folder, so that a test can change its mind
between two runs.
"""

import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

root = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(root / "scripts" / "fpga"))
import tools  # noqa: E402

# A counter of WIDTH bits; the line of the C++ source stands behind the names as epiline-hls has it.
verilog = """module counter (
  input  wire clk,
  input  wire rst,
  input  wire [{high}:0] step,  // counter.cpp:3
  output reg [{high}:0] total  // counter.cpp:3
);
  reg [{high}:0] step_s1;
  wire [{high}:0] sum = total + step_s1;  // counter.cpp:5
  always @(posedge clk) begin
    step_s1 <= step;
    total <= rst ? {width}'d0 : sum;
  end
endmodule
"""

compiler = """#!{python}
import json, os, pathlib, sys
if sys.argv[1:] == ["--version"]:
    print("epiline-hls 9.9")
    sys.exit(0)
bench = pathlib.Path("{bench}")
option = {{sys.argv[i]: sys.argv[i + 1] for i in range(2, len(sys.argv) - 1)}}
if (bench / "compiler_fails").exists():
    print("counter.cpp:5: error: `goto` cannot become hardware", file=sys.stderr)
    sys.exit(1)
width = int((bench / "width").read_text())
out = pathlib.Path(option["-o"])
(out / (option["--top"] + ".v")).write_text({verilog!r}.format(high=width - 1, width=width))
period = float(option["--clock"][:-2])
(out / "report.json").write_text(json.dumps(
    {{"clock": {{"period_ns": period, "estimated_period_ns": period - 0.25}}, "depth": 4}}))
(bench / "calls").open("a").write("hls " + option["--clock"] + " " + option["--target"] + "\\n")
"""

# Seed N reaches 100 + 10 N MHz.
nextpnr = """#!{python}
import json, pathlib, sys, time
bench = pathlib.Path("{bench}")
option = {{sys.argv[i]: sys.argv[i + 1] for i in range(1, len(sys.argv) - 1)}}
seed = int(option["--seed"])
(bench / "calls").open("a").write("nextpnr " + str(seed) + "\\n")
print("Info: Packing constants..", flush=True)
if (bench / "nextpnr_sleeps").exists():
    (bench / "nextpnr_is_there").write_text("")
    pathlib.Path("report.json").write_text("{{")
    time.sleep(60)
if (bench / "nextpnr_says").exists():
    print((bench / "nextpnr_says").read_text())
    sys.exit(1)
wanted = float(option["--freq"])
reached = 100.0 + 10 * seed
clock = "$glbnet$clk$TRELLIS_IO_IN"
cells = json.load(open(option["--json"]))["modules"][option["--top"]]["cells"]
carry = next(name for name, cell in cells.items() if cell["type"] == "CCU2C")
step, total = "step_s1_TRELLIS_FF_Q_1", "total_TRELLIS_FF_Q_3"
def part(kind, delay, to, **more):
    return dict({{"type": kind, "delay": delay, "to": {{"cell": to, "loc": [1, 1], "port": "X"}},
                 "from": {{"cell": more.pop("start", to), "loc": [1, 1], "port": "X"}}}}, **more)
path = [part("clk-to-q", 0.5, step), part("routing", 1.5, carry, start=step, net="step_s1[1]", sources=[]),
        part("logic", 0.5, carry), part("routing", 1.25, total, start=carry, net="sum[3]", sources=[]),
        part("setup", 0.25, total)]
pathlib.Path("report.json").write_text(json.dumps({{
    "fmax": {{clock: {{"achieved": reached, "constraint": wanted}}}},
    "utilization": {{"TRELLIS_COMB": {{"used": 40, "available": 24288}},
                    "TRELLIS_FF": {{"used": 16, "available": 24288}}}},
    "critical_paths": [{{"from": "posedge " + clock, "to": "<async>", "path": [part("clk-to-q", 9, total)]}},
                       {{"from": "posedge " + clock, "to": "posedge " + clock, "path": path}}]}}))
pathlib.Path(option["--textcfg"]).write_text(f".device {{seed}}\\n")
"""

packer = """#!{python}
import pathlib, sys
bench = pathlib.Path("{bench}")
if (bench / "packer_says").exists():
    print((bench / "packer_says").read_text())
    sys.exit(1)
pathlib.Path(sys.argv[-1]).write_bytes(b"\\xff\\x00" + pathlib.Path(sys.argv[-2]).read_bytes())
"""

environment_python = """#!/bin/sh
exec cat {bench}/installed_versions
"""


class fpga_bench(unittest.TestCase):
    """A test of scripts/fpga.sh with the stand-ins."""

    session = tempfile.TemporaryDirectory()  # pylint: disable=consider-using-with
    kept = pathlib.Path(session.name) / "synthesis"

    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.folder = pathlib.Path(place.name)
        (self.folder / "counter.cpp").write_text("void counter() {}\n")
        (self.folder / "width").write_text("8")
        (self.folder / "build" / "bin").mkdir(parents=True)
        self.program("build/bin/epiline-hls", compiler)
        (self.folder / "tools" / "bin").mkdir(parents=True)
        (self.folder / "tools" / "pyvenv.cfg").write_text("")
        (self.folder / "tools" / "installed.json").write_text(json.dumps({"fingerprint": tools.fingerprint()}))
        self.program("tools/bin/python3", environment_python)
        self.program("tools/bin/nextpnr-ecp5", nextpnr)
        self.program("tools/bin/ecppack", packer)
        (self.folder / "tools" / "bin" / "yosys").symlink_to("/usr/bin/yosys")
        self.versions = tools.pinned_versions()
        self.install(self.versions)

    def synthesized(self, folder="out"):
        """Puts the counter's synthesis into a folder as a finished step, which takes Yosys once for all tests."""
        place = self.folder / folder / "synthesis"
        if not fpga_bench.kept.exists():
            (self.folder / "nextpnr_says").write_text("ERROR: not now")
            self.run_flow("--clock", "9.5", "--seeds", "1", "-o", "first")
            (self.folder / "nextpnr_says").unlink()
            shutil.copytree(self.folder / "first" / "synthesis", fpga_bench.kept)
            self.calls()
        shutil.copytree(fpga_bench.kept, place)

    def program(self, name, text):
        path = self.folder / name
        path.write_text(text.format(python=sys.executable, bench=self.folder, verilog=verilog))
        path.chmod(0o755)

    def install(self, versions):
        (self.folder / "installed_versions").write_text(json.dumps(versions))

    def environment(self):
        return {
            **os.environ,
            "EPILINE_BUILD": str(self.folder / "build"),
            "EPILINE_FPGA_TOOLS": str(self.folder / "tools"),
        }

    def command(self, *arguments, top="counter.cpp:counter"):
        return [str(root / "scripts" / "fpga.sh"), top, "--target", "ecp5-25k", *arguments]

    def run_flow(self, *arguments, top="counter.cpp:counter"):
        return subprocess.run(
            self.command(*arguments, top=top),
            cwd=self.folder,
            env=self.environment(),
            text=True,
            capture_output=True,
            check=False,
        )

    def run_plain(self, *arguments):
        """With these arguments and no others."""
        return subprocess.run(
            [str(root / "scripts" / "fpga.sh"), *arguments],
            cwd=self.folder,
            env=self.environment(),
            text=True,
            capture_output=True,
            check=False,
        )

    def calls(self):
        """What the stand-ins were called for since the last question."""
        file = self.folder / "calls"
        said = file.read_text().splitlines() if file.exists() else []
        file.unlink(missing_ok=True)
        return said

    def expect_error(self, ended, *words):
        self.assertEqual(ended.returncode, 1, ended.stdout + ended.stderr)
        last = ended.stderr.strip().splitlines()[-1]
        self.assertTrue(last.startswith("fpga.sh: error: "), ended.stderr)
        self.assertNotIn("Traceback", ended.stderr)
        for word in words:
            self.assertIn(word, last)

    def result(self, folder="out"):
        return json.loads((self.folder / folder / "counter.json").read_text())
