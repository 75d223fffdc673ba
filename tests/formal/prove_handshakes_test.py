#!/usr/bin/env python3
"""Streams keep their rules, proved by k-induction: the FIFO between processes, and in generated modules the input buffers,
the credits and the output FIFOs; delay lines give every word after its clocks; and proofs of faulty ones, which must fail (see
handshake_properties.py).

  prove_handshakes_test.py EPILINE-HLS
"""

import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

from handshake_properties import prove, with_delay_line_properties, with_fifo_properties, with_handshake_properties

compiler = pathlib.Path(sys.argv.pop(1)).resolve()
here = pathlib.Path(__file__).resolve().parent
kernels = here.parent / "compiler/kernels"

# An iteration a clock, of bit_reversal one that reads and writes in some iterations only; an iteration every other clock.
modules = ["prefix_sum", "moving_average", "bit_reversal", "multiply_and_keep"]

# Faults, each as (what it is, regular expression, what takes its place).
fifo_faults = [
    ("a word too many", r"room <= next_fill <= \{1'b0, LAST\}", "room <= 1'b1"),
    ("a word too few", r"room <= next_fill <= \{1'b0, LAST\}", "room <= next_fill < {1'b0, LAST}"),
    ("an offer taken back", r"word_there <= load \| \(word_there & ~out_tready\)", "word_there <= load"),
    ("a word over one that waits", r"& \(out_tready \| ~word_there\);", ";"),
    ("a word twice", r"if \(load\) out_at <=", "if (load & ~push) out_at <="),
    ("words in another order", r"places\[in_at\] <= in_tdata", "places[LAST - in_at] <= in_tdata"),
    ("no way around", r"in_at <= \(in_at == LAST\) \? \{POINTER\{1'b0\}\} : in_at \+ 1'b1", "in_at <= in_at + 1'b1"),
    ("a fill that a reset leaves", r"      fill <= [^;]*;", ""),
    ("no word without a push", r"wire load = ", "wire load = in_tvalid & "),
]
module_faults = [
    ("input: a token into the wrong register", r"s_ready & ~s_fills_second", "s_ready & s_fills_second"),
    ("input: registers that are not read in turn", r"s_reads_second <= s_reads_second \^ s_take",
     "s_reads_second <= s_reads_second"),
    ("input: a token over another", r"s_ready <= ~\(.*\);", "s_ready <= 1'b1;"),
    ("input: room for one only", r"s_ready <= ~\(.*\);", "s_ready <= ~s_push;"),
    ("input: a token that is forgotten", r"s_there <= s_push \| .*;", "s_there <= s_push;"),
    ("input: a token that stays", r"s_there <= s_push \| .*;", "s_there <= s_push | s_there;"),
    ("an iteration without its token", r"    & s_there;", "    ;"),
    ("an iteration without room", r"may_issue <= ~holding_next & m_room", "may_issue <= ~holding_next"),
    ("room that is counted twice", r"m_credits_next > 5'd1", "m_credits_next > 5'd0"),
    ("room given back early", r"m_leaves\[2:0\], m_load\}", "m_leaves[2:0], m_load | (m_in != m_out)}"),
    ("a place that nobody gives back", r"m_change = \{\{4\{m_fewer\}\}, ", "m_change = {4'd0, "),
    ("room lost in a reset", r"m_credits <= 5'd16", "m_credits <= 5'd15"),
    ("output: an offer taken back", r"m_word_there <= m_load \| .*;", "m_word_there <= m_load;"),
    ("output: a word that changes", r"if \(m_load\) m_word <=", "m_word <="),
    ("output: a word that is offered late", r"wire m_load = ", "wire m_load = ~s_push & "),
    ("output: a word out of an empty FIFO", r"m_waits <= .* : m_holds_one;", "m_waits <= 1'b1;"),
    ("output: a word that nobody hears of", r"m_waits <= .* : m_holds_one;", "m_waits <= 1'b0;"),
    ("output: a word that is taken twice", r"m_waits <= .* : m_holds_one;", "m_waits <= m_holds_one;"),
    ("output: a place that is left out", r"m_after_out <= m_after_out \+ 5'd1", "m_after_out <= m_after_out + 5'd2"),
    ("output: a word at another place", r"m_fifo\[m_in\[3:0\]\] <= m_data", "m_fifo[~m_in[3:0]] <= m_data"),
    ("issue while a reset drains the pipeline", r"      holding <= 1'b1;", "      holding <= 1'b0;"),
]
interval_faults = [
    ("issue in the next clock", r"holding_next = fire \| ", "holding_next = "),
    ("issue a clock later", r"hold <= fire \? 4'd1", "hold <= fire ? 4'd2"),
    ("no end of the wait", r"hold <= fire \? 4'd1", "hold <= fire ? 4'd0"),
    ("an iteration without its token", r"    & in_there;", "    ;"),
    ("room lost where nothing is written", r"out_skipped <= valid\[1\] & ~\(.*\);", "out_skipped <= 1'b0;"),
]
delay_line_faults = [
    ("a line in LUT RAM one word too short", r"\(delay_8_out == 3'd7\)", "(delay_8_out == 3'd6)"),
    ("a pointer that does not follow the other one", r"delay_16_in <= delay_16_out;", "delay_16_in <= delay_16_in;"),
    ("a copy of one pointer beside the other one", r"\.d\(delay_8_out_copy1\)", ".d(delay_8_out)"),
    ("a word read through another pointer", r"\[delay_8_out_copy1\]", "[delay_8_out]"),
    ("a line in block RAM one word too short", r"\(delay_16_out == 4'd15\)", "(delay_16_out == 4'd14)"),
    ("an issue before the pointers run", r"resetting & \(hold != (\d+)'d4\)", r"resetting & (hold != \1'd2)"),
]


class handshakes(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        place = tempfile.TemporaryDirectory()
        cls.addClassCleanup(place.cleanup)
        cls.verilog = {}
        for name in [*modules, "waits", "dataflow_gain"]:
            source = next(path for folder in (kernels, here / "modules") if (path := folder / f"{name}.cpp").exists())
            subprocess.run([compiler, source, "--top", name, "-o", place.name, "--quiet"], check=True, capture_output=True)
            cls.verilog[name] = (pathlib.Path(place.name) / f"{name}.v").read_text(encoding="utf-8")

    def with_fault(self, name, pattern, replacement):
        verilog, count = re.subn(pattern, replacement, self.verilog[name])
        self.assertEqual(count, 1)
        return verilog

    def prove_fifo(self, verilog, depth):
        self.assertIn("module epiline_fifo_distributed", verilog)
        pointer = (depth - 1).bit_length()
        return prove(with_fifo_properties(verilog), "epiline_fifo_distributed",
                     [("WIDTH", 2), ("DEPTH", depth), ("POINTER", pointer), ("LAST", depth - 1)])

    def test_the_fifo_keeps_order_and_number(self):
        for depth in (2, 3, 4):
            with self.subTest(depth):
                verdict, output = self.prove_fifo(self.verilog["dataflow_gain"], depth)
                self.assertEqual(verdict, "proved", output[-3000:])

    def test_a_faulty_fifo_does_not(self):
        for fault, pattern, replacement in fifo_faults:
            with self.subTest(fault):
                verilog = self.with_fault("dataflow_gain", pattern, replacement)
                verdict, output = self.prove_fifo(verilog, 3)
                self.assertEqual(verdict, "refuted", output[-3000:])

    def test_generated_modules_keep_the_rules(self):
        for name in modules:
            with self.subTest(name):
                verilog, inputs, outputs = with_handshake_properties(self.verilog[name], name)
                self.assertEqual((inputs, outputs), (1, 1))
                verdict, output = prove(verilog, name, cut="*_data")
                self.assertEqual(verdict, "proved", output[-3000:])

    def test_a_faulty_module_does_not(self):
        for name, faults in (("prefix_sum", module_faults), ("multiply_and_keep", interval_faults)):
            for fault, pattern, replacement in faults:
                with self.subTest(name, fault=fault):
                    verilog = self.with_fault(name, pattern, replacement)
                    verdict, output = prove(with_handshake_properties(verilog, name)[0], name, cut="*_data")
                    self.assertIn(verdict, ("refuted", "not inductive"), output[-3000:])

    def prove_delay_lines(self, verilog):
        verilog, lines = with_delay_line_properties(verilog, "waits")
        self.assertEqual(lines, 3)
        return prove(verilog, "waits")

    def test_delay_lines_give_every_word_after_its_clocks(self):
        verdict, output = self.prove_delay_lines(self.verilog["waits"])
        self.assertEqual(verdict, "proved", output[-3000:])

    def test_faulty_delay_lines_do_not(self):
        for fault, pattern, replacement in delay_line_faults:
            with self.subTest(fault):
                verdict, output = self.prove_delay_lines(self.with_fault("waits", pattern, replacement))
                self.assertIn(verdict, ("refuted", "not inductive"), output[-3000:])


if __name__ == "__main__":
    unittest.main()
