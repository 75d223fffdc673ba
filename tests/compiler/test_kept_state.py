#!/usr/bin/env python3
"""State that a reset leaves alone is there after one, whatever step runs between the reset and the loop that has it.

test_kept_state.py COMPILER IVERILOG

Simulates two resets, which comparing tokens with a native run does not: what a step sets again at power-up looks the same.
"""

import pathlib
import subprocess
import sys
import tempfile
import unittest

COMPILER, IVERILOG = sys.argv[1:]

SOURCE = """\
#include <ap_int.h>
#include <hls_stream.h>
#include <hls_task.h>
static void process(hls::stream<ap_uint<8>>& in, hls::stream<ap_uint<8>>& out) {{
  static ap_uint<8> kept = 77;
#pragma HLS RESET variable = kept {pragma}
  ap_uint<8> ram[64];
  {before}
  while (true) {{
#pragma HLS PIPELINE II = 1
    const ap_uint<8> value = in.read();
    out.write(kept + ram[value & 7]);
    ram[value & 7] = 0;
    if (value != 255) kept = value;
  }}
}}
void top(hls::stream<ap_uint<8>>& in, hls::stream<ap_uint<8>>& out) {{
  hls_thread_local hls::task task(process, in, out);
}}
"""

# The same tokens after each of two resets.
TESTBENCH = """\
module testbench;
  reg clk = 0, rst = 1;
  always #5 clk = ~clk;
  reg [7:0] tokens [0:{last}];
  integer next = 0;
  wire in_ready, out_valid;
  wire [7:0] out;
  wire in_valid = next <= {last} && !rst;
  top dut(.clk(clk), .rst(rst), .s_axis_in_tdata(tokens[next]), .s_axis_in_tvalid(in_valid), .s_axis_in_tready(in_ready),
          .m_axis_out_tdata(out), .m_axis_out_tvalid(out_valid), .m_axis_out_tready(1'b1));
  always @(posedge clk) if (!rst) begin
    if (in_valid && in_ready) next <= next + 1;
    if (out_valid) $display("%0d", out);
  end
  initial begin
    {contents}
    repeat (5) @(posedge clk);
    rst <= 0;
    repeat (300) @(posedge clk);
    rst <= 1;
    repeat (5) @(posedge clk);
    next <= 0;
    $display("reset");
    rst <= 0;
    repeat (300) @(posedge clk);
    $finish;
  end
endmodule
"""

# What comes before the loop, and how many tokens that takes.
BEFORE = {
    "all words at once": ("for (int i = 0; i < 64; ++i) ram[i] = i + 1;", 0),
    "a word at a time": ("for (int i = 0; i < 64; ++i) ram[i] = in.read();", 64),
}


class kept_state(unittest.TestCase):
    def outputs(self, before, tokens, pragma):
        """What the Verilog gives for the same tokens after the first reset and after the second."""
        with tempfile.TemporaryDirectory() as name:
            root = pathlib.Path(name)
            (root / "top.cpp").write_text(SOURCE.format(before=before, pragma=pragma), encoding="utf-8")
            contents = " ".join(f"tokens[{i}] = {token};" for i, token in enumerate(tokens))
            (root / "testbench.v").write_text(TESTBENCH.format(last=len(tokens) - 1, contents=contents), encoding="utf-8")
            for command in ([COMPILER, "top.cpp", "--top", "top", "--clock", "25ns", "-q", "-o", "out"],
                            [IVERILOG, "-g2005", "-o", "simulation", "testbench.v", "out/top.v"]):
                ended = subprocess.run(command, cwd=root, text=True, capture_output=True, check=False)
                self.assertEqual(ended.returncode, 0, ended.stderr)
            said = subprocess.run(["vvp", "-n", "simulation"], cwd=root, text=True, capture_output=True, check=True).stdout
        first, second = said.split("reset\n")
        return [int(line) for line in first.split()], [int(line) for line in second.split() if line.isdigit()]

    def test_state_survives_a_reset_only_where_it_is_to(self):
        for name, (before, count) in BEFORE.items():
            for pragma, after_reset in (("off", 9), ("", 77)):
                with self.subTest(before=name, pragma=pragma):
                    words = [3 * i + 1 for i in range(count)] or [i + 1 for i in range(64)]
                    first, second = self.outputs(before, words[:count] + [5, 6, 255, 9], pragma)
                    self.assertEqual(first, [77 + words[5], 5 + words[6], 6 + words[7], 6 + words[1]])
                    self.assertEqual(second, [after_reset + words[5], *first[1:]])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
