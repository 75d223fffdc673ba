#!/usr/bin/env python3
"""A fault in one form of a program: --check names that level, the first token that differs, and the line it is written in.

faults_test.py EPILINE_HLS [unittest options]
"""

import unittest

import check_fixture
from check_fixture import CheckTest

ODD_LINE, EVEN_LINE = 17, 19
SOURCE = """#include "ap_int.h"
#include "hls_stream.h"
#if defined(WRONG_IN_CLANG) && defined(__clang__) && !defined(__SYNTHESIS__)
#define STEP 38
#elif defined(WRONG_IN_SYNTHESIS) && defined(__SYNTHESIS__)
#define STEP 38
#else
#define STEP 37
#endif

void faulty(hls::stream<ap_uint<8> >& in, hls::stream<ap_uint<8> >& out) {
#pragma HLS PIPELINE
  static ap_uint<8> sum = 0;
  const ap_uint<8> value = in.read();
  sum = sum ^ value;
  if (value[0]) {
    out.write(sum + STEP);
  } else {
    out.write(~sum);
  }
}
"""
# The first odd value is the third: only there the step is seen.
STIMULUS = "port in input stream tdata:8\n" + "".join(f"token {v:02x}\n" for v in (2, 4, 7, 8, 9))
FIRST = "output 'out': token 2 of 5 is tdata=27, native tdata=26"


class Faults(CheckTest):
    def setUp(self):
        super().setUp()
        (self.folder / "faulty.cpp").write_text(SOURCE, encoding="utf-8")
        (self.folder / "x.tokens").write_text(STIMULUS, encoding="utf-8")

    def differs(self, level, text, line, *options):
        run = self.check("faulty.cpp", "faulty", "--stimulus", "x.tokens", "--target", "generic", *options)
        self.assertEqual(run.returncode, 1, run.stdout + run.stderr)
        message = run.stderr.strip().splitlines()[-1]
        self.assertTrue(message.startswith(f"faulty.cpp:{line}: error: level {level} differs: {text}"), run.stdout + message)
        self.assertEqual(self.table(run)[level][0], "DIFFERS")
        return run

    def fault(self, level, change, *options, named=None, text=FIRST, line=ODD_LINE):
        run = self.differs(named or level, text, line, "--levels", named or level, "--fault",
                           f"{level}:{change}", *options)
        self.assertEqual(list(self.table(run)), ["native-clang", named or level])

    def test_two_compilers_disagree(self):
        self.differs("native-clang", FIRST, ODD_LINE, "-D", "WRONG_IN_CLANG", "--levels",
                     "native-gcc,native-clang,ir-source,ir-lowered")

    def test_the_source_means_something_else_to_the_compiler(self):
        run = self.differs("ir-source", FIRST, ODD_LINE, "-D", "WRONG_IN_SYNTHESIS", "--levels",
                           "native-gcc,native-clang,ir-source,ir-lowered,graph,passes,rtl-icarus")
        # All the levels behind it say the same as it does; the first one is named.
        self.assertEqual([verdict for verdict, _ in self.table(run).values()], ["run", "equal"] + 5 * ["DIFFERS"])

    def test_lowered_ir(self):
        self.fault("ir-lowered", ", 37:, 38")

    def test_built_graph(self):
        self.fault("graph", "constant 8 0x25:constant 8 0x26")

    def test_a_pass(self):
        self.fault("passes/balance_trees", "constant 8 0x25:constant 8 0x26", named="passes", text="after pass ")

    def test_text_of_the_graph(self):
        self.fault("text", "constant 8 0x25:constant 8 0x26")

    def test_text_that_is_none(self):
        run = self.check("faulty.cpp", "faulty", "--stimulus", "x.tokens", "--levels", "text", "--fault",
                         "text:constant 8:constant 9")
        self.assertRegex(run.stderr, "error: level text differs: line [0-9]+: ")

    def test_rtl_in_icarus(self):
        self.fault("rtl-icarus", "8'd37:8'd38")

    def test_rtl_in_verilator(self):
        self.fault("rtl-verilator", "8'd37:8'd38")

    def test_random_schedule(self):
        self.fault("random-schedule", "8'd37:8'd38")

    def test_rtl_that_offers_tokens_only_when_they_are_taken(self):
        run = self.differs("rtl-icarus", "output 'out': 0 tokens, native 5", EVEN_LINE, "--levels", "rtl-icarus",
                           "--fault", "rtl-icarus:= out_end_there;:= out_end_there & m_axis_out_tready;")
        self.assertIn("(with random pauses, ready after valid)", run.stderr)

    def test_rtl_that_withdraws_a_token(self):
        run = self.check("faulty.cpp", "faulty", "--stimulus", "x.tokens", "--levels", "rtl-icarus", "--fault",
                         "rtl-icarus:assign m_axis_out_tvalid = out_end_there;:reg toggle = 0; always @(posedge clk) "
                         "toggle <= !toggle; assign m_axis_out_tvalid = out_end_there & (m_axis_out_tready | toggle);")
        self.assertEqual(run.returncode, 1)
        self.assertRegex(run.stderr, r"level rtl-icarus differs: out: tvalid is withdrawn before tready in clock \d+ \(")

    def test_netlist(self):
        self.fault("netlist", "] <= choice:] <= 8'd1 ^ choice", line=EVEN_LINE,
                   text="output 'out': token 0 of 5 is tdata=fc, native tdata=fd")

    def test_rtl_that_does_not_compile(self):
        run = self.check("faulty.cpp", "faulty", "--stimulus", "x.tokens", "--levels", "rtl-icarus", "--fault",
                         "rtl-icarus:endmodule:endmodul")
        self.assertEqual(run.returncode, 1)
        self.assertIn("error: level rtl-icarus differs: iverilog refuses the Verilog: icarus.v:", run.stderr)

    def test_a_fault_that_changes_nothing_is_no_test(self):
        run = self.check("faulty.cpp", "faulty", "--stimulus", "x.tokens", "--levels", "graph", "--fault",
                         "graph:constant 77:x")
        self.assertEqual(run.returncode, 1)
        self.assertIn("--fault: 'constant 77' is not in level graph", run.stderr)


PROCESSES = """#include "ap_int.h"
#include "hls_stream.h"

static void add(hls::stream<ap_uint<8> >& in, hls::stream<ap_uint<8> >& sums) {
#pragma HLS PIPELINE
  sums.write(in.read() + 37);
}

static void halve(hls::stream<ap_uint<8> >& sums, hls::stream<ap_uint<8> >& out) {
#pragma HLS PIPELINE
  out.write(sums.read() >> 1);
}

void processes(hls::stream<ap_uint<8> >& in, hls::stream<ap_uint<8> >& out) {
#pragma HLS DATAFLOW
  hls::stream<ap_uint<8> > sums("sums");
  add(in, sums);
  halve(sums, out);
}
"""
OUT_LINE = 11


class FaultsInAProcess(CheckTest):
    """The process with the fault writes to a FIFO: what is seen, and named, is the token of the top's output."""

    def differs(self, level, change, named=None):
        (self.folder / "processes.cpp").write_text(PROCESSES, encoding="utf-8")
        # 37 and 38 more, halved: the same for the first token.
        (self.folder / "x.tokens").write_text("port in input stream tdata:8\ntoken 01\ntoken 02\n", encoding="utf-8")
        run = self.check("processes.cpp", "processes", "--stimulus", "x.tokens", "--levels", named or level, "--fault",
                         f"{level}:{change}")
        self.assertEqual(run.returncode, 1, run.stdout + run.stderr)
        message = run.stderr.strip().splitlines()[-1]
        self.assertTrue(message.startswith(f"processes.cpp:{OUT_LINE}: error: level {named or level} differs: "), message)
        self.assertIn("output 'out': token 1 of 2 is tdata=14, native tdata=13", message)

    def test_lowered_ir(self):
        self.differs("ir-lowered", ", 37:, 38")

    def test_built_graph(self):
        self.differs("graph", "constant 8 0x25:constant 8 0x26")

    def test_a_pass_over_one_process(self):
        self.differs("passes/balance_trees", "constant 8 0x25:constant 8 0x26", named="passes")

    def test_rtl(self):
        self.differs("rtl-icarus", "8'd37:8'd38")


if __name__ == "__main__":
    check_fixture.main()
