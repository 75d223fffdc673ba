#!/usr/bin/env python3
"""scripts/synthesize.sh: what it counts, and that it fails where it must. Takes the project's root as its argument."""

import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(sys.argv.pop(1)) if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parents[2]

ADDER = """
module top (input wire clk, input wire [7:0] a, input wire [7:0] b, output reg [8:0] sum);
  always @(posedge clk) sum <= a + b;
endmodule
"""

RAM = """
module top (input wire clk, input wire write, input wire [9:0] from, input wire [9:0] to, input wire [17:0] data,
            output reg [17:0] word);
  (* ram_style = "block", no_rw_check *)
  reg [17:0] store [0:1023];
  always @(posedge clk) begin
    if (write) store[to] <= data;
    word <= store[from];
  end
endmodule
"""

# Two writes at two addresses and a read at a third: more ports than a RAM has.
THREE_PORTS = """
module top (input wire clk, input wire write, input wire [5:0] from, input wire [5:0] to, input wire [5:0] clear,
            input wire [7:0] data, output reg [7:0] word);
  reg [7:0] store[0:63];
  always @(posedge clk) begin
    if (write) store[to] <= data;
    store[clear] <= 8'd0;
    word <= store[from];
  end
endmodule
"""

# Written as a whole: Yosys makes registers of such an array while it reads the Verilog.
TAKEN_APART = """
module top (input wire clk, input wire [7:0] data, output wire [7:0] word);
  (* ram_style = "block", mem2reg *)
  reg [7:0] line [0:1];
  always @(posedge clk) begin
    line[0] <= data;
    line[1] <= line[0];
  end
  assign word = line[1];
endmodule
"""

TABLE = """
module top (input wire clk, input wire [1:0] index, output reg [5:0] word);
  reg [5:0] entries [0:3];
  initial begin
    entries[0] = 6'd63;
    entries[1] = 6'd31;
    entries[2] = 6'd17;
    entries[3] = 6'd5;
  end
  always @(posedge clk) word <= entries[index];
endmodule
"""

LATCH = """
module top (input wire enable, input wire a, output reg q);
  always @* if (enable) q = a;
endmodule
"""

TWO_DRIVERS = """
module top (input wire clk, input wire a, input wire b, output wire y);
  reg p, q;
  always @(posedge clk) p <= a;
  always @(posedge clk) q <= b;
  assign y = p;
  assign y = q;
endmodule
"""

LOOP = """
module top (input wire a, output wire y);
  wire z = ~(y & a);
  assign y = ~(z | a);
endmodule
"""


class synthesize(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def run_script(self, *arguments, **environment):
        return subprocess.run([ROOT / "scripts/synthesize.sh", *arguments], cwd=self.folder, text=True,
                              capture_output=True, env={**os.environ, **environment}, check=False)

    def synthesize(self, verilog):
        (self.folder / "top.v").write_text(verilog, encoding="utf-8")
        return self.run_script("top.v", "top", "-o", "out")

    def resources(self):
        return json.loads((self.folder / "out/resources.json").read_text(encoding="utf-8"))

    def expect_failure(self, result, *words):
        self.assertNotEqual(result.returncode, 0)
        for word in words:
            self.assertIn(word, result.stderr)

    def test_counts_luts_carries_and_flip_flops(self):
        result = self.synthesize(ADDER)
        self.assertEqual(result.returncode, 0, result.stderr)
        resources = self.resources()
        self.assertEqual(resources["flip_flops"], 9)
        cells = resources["cells"]
        self.assertGreater(cells["CCU2C"], 0)
        self.assertEqual(resources["lut4"], cells["LUT4"] + 2 * cells["CCU2C"] + 6 * cells["TRELLIS_DPR16X4"])
        self.assertTrue((self.folder / "out/top_netlist.v").exists())
        self.assertTrue((self.folder / "out/top.json").exists())

    def test_counts_block_rams_and_knows_their_names(self):
        result = self.synthesize(RAM)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(self.resources()["block_rams"], 1)
        self.assertEqual(self.resources()["memories"], ["store"])

    def registered_ram(self, register):
        """A RAM whose word goes through `register`; returns the output modes of the block RAM."""
        result = self.synthesize(RAM.replace("output reg [17:0] word", "output reg [17:0] last, input wire go")
                                 .replace("  always", "  reg [17:0] word;\n  always", 1)
                                 .replace("endmodule", register + "\nendmodule"))
        self.assertEqual(result.returncode, 0, result.stderr)
        netlist = json.loads((self.folder / "out/top.json").read_text(encoding="utf-8"))
        rams = [cell for cell in netlist["modules"]["top"]["cells"].values() if cell["type"] == "DP16KD"]
        self.assertEqual(len(rams), 1)
        return {rams[0]["parameters"]["REGMODE_A"], rams[0]["parameters"]["REGMODE_B"]}

    def test_moves_registers_after_a_ram_into_it(self):
        self.assertIn("OUTREG", self.registered_ram("always @(posedge clk) last <= word;"))
        self.assertEqual(self.resources()["flip_flops"], 0)

    def test_leaves_registers_that_a_ram_does_not_have(self):
        for register in ("always @(posedge clk) if (go) last <= word;",  # an enable of its own
                         "always @(posedge clk) last <= go ? 18'd0 : word;",  # a reset or a gate before it
                         "reg [17:0] other; always @(posedge clk) begin other <= word; last <= word ^ other; end",
                         "always @(negedge clk) last <= word;"):
            with self.subTest(register):
                self.assertEqual(self.registered_ram(register), {"NOREG"})
                self.assertGreaterEqual(self.resources()["flip_flops"], 18)

    def test_keeps_copies_of_a_flip_flop(self):
        copies = """
module epiline_copy #(parameter WIDTH = 1) (input wire clk, input wire [WIDTH-1:0] d, output wire [WIDTH-1:0] q);
  reg [WIDTH-1:0] bits;
  always @(posedge clk) bits <= d;
  assign q = bits;
endmodule
module top (input wire clk, input wire [2:0] a, output wire [8:0] sum);
  reg [2:0] first;
  always @(posedge clk) first <= a;
  epiline_copy #(.WIDTH(3)) second (.clk(clk), .d(a), .q(sum[5:3]));
  epiline_copy #(.WIDTH(3)) third (.clk(clk), .d(a), .q(sum[8:6]));
  assign sum[2:0] = first;
endmodule
"""
        for target in ("ecp5", "hx8k"):
            (self.folder / "top.v").write_text(copies, encoding="utf-8")
            result = self.run_script("top.v", "top", "-o", "out", "--target", target)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertEqual(self.resources()["flip_flops"], 9, target)

    def test_fails_when_a_memory_became_flip_flops(self):
        self.expect_failure(self.synthesize(THREE_PORTS), "store", "flip-flops")
        self.assertEqual(self.resources()["lost_memories"], ["store"])

    def test_fails_when_an_array_for_ram_is_no_memory_at_all(self):
        self.expect_failure(self.synthesize(TAKEN_APART), "line", "flip-flops")

    def test_accepts_a_small_table_in_logic(self):
        result = self.synthesize(TABLE)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(self.resources()["lost_memories"], [])

    def test_fails_when_a_table_for_ram_became_logic(self):
        verilog = TABLE.replace("  reg [5:0] entries", '  (* ram_style = "block" *)\n  reg [5:0] entries').replace(
            "always @(posedge clk) word <=", "always @* word =")
        self.expect_failure(self.synthesize(verilog))

    def test_accepts_an_array_that_is_to_be_registers(self):
        result = self.synthesize(THREE_PORTS.replace("  reg [7:0] store", '  (* ram_style = "registers" *) reg [7:0] store'))
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_reads_several_files(self):
        (self.folder / "inner.v").write_text(RAM.replace("module top", "module inner"), encoding="utf-8")
        outer = """module top (input wire clk, input wire write, input wire [9:0] from, input wire [9:0] to,
                               input wire [17:0] data, output wire [17:0] word);
          inner instance_of_it (.clk(clk), .write(write), .from(from), .to(to), .data(data), .word(word));
        endmodule"""
        (self.folder / "top.v").write_text(outer, encoding="utf-8")
        result = self.run_script("inner.v", "top.v", "top", "-o", "out")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(self.resources()["memories"], ["store"])

    def test_counts_cells_of_the_small_device(self):
        (self.folder / "top.v").write_text(RAM, encoding="utf-8")
        result = self.run_script("top.v", "top", "-o", "out", "--target", "hx8k")
        self.assertEqual(result.returncode, 0, result.stderr)
        resources = self.resources()
        self.assertEqual(resources["block_rams"], resources["cells"]["SB_RAM40_4K"])
        self.assertEqual(resources["block_rams"], 5)  # 4 bits wide at 1024 words each
        self.assertEqual(resources["lut4"], resources["cells"]["SB_LUT4"])

    def test_fails_on_a_latch(self):
        self.expect_failure(self.synthesize(LATCH), "Yosys failed")

    def test_fails_on_two_drivers(self):
        self.expect_failure(self.synthesize(TWO_DRIVERS), "Yosys failed")

    def test_fails_on_a_combinational_loop(self):
        self.expect_failure(self.synthesize(LOOP), "combinational loop")

    def test_fails_on_verilog_with_an_error(self):
        self.expect_failure(self.synthesize("module top (; endmodule"), "ERROR", "Yosys failed")
        self.assertFalse((self.folder / "out/resources.json").exists())

    def test_fails_on_wrong_arguments(self):
        (self.folder / "top.v").write_text(ADDER, encoding="utf-8")
        self.expect_failure(self.run_script("top.v"), "usage")
        self.expect_failure(self.run_script("top.v", "top", "-o"), "-o needs a value")
        self.expect_failure(self.run_script("top.v", "top", "--fast"), "unknown argument '--fast'")
        self.expect_failure(self.run_script("top.v", "top", "-o", "out", "--target", "abacus"), "unknown target 'abacus'")
        self.expect_failure(self.run_script("none.v", "top", "-o", "out"), "none.v' is not a readable file")
        self.expect_failure(self.run_script("top.v", "a b", "-o", "out"), "not the name of a module")
        self.expect_failure(self.run_script("top.v", "other", "-o", "out"), "Yosys failed")
        self.expect_failure(self.run_script("top.v", "top", "-o", "out", YOSYS="no_such_yosys"),
                            "Debian package yosys")


if __name__ == "__main__":
    unittest.main()
