#!/usr/bin/env python3
"""epiline-hls --check on kernels: all levels run and are equal; and what it says when they cannot run.

levels_test.py EPILINE_HLS [unittest options]
"""

import json
import os
import unittest

import check_fixture
from check_fixture import KERNELS, CheckTest

LEVELS = ["native-gcc", "native-clang", "ir-source", "ir-lowered", "graph", "passes", "text", "rtl-icarus",
          "rtl-verilator", "random-schedule", "netlist"]


class AllLevels(CheckTest):
    def check_all(self, name, *options, folder=KERNELS):
        run = self.check(folder / f"{name}.cpp", name, *options)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        rows = self.table(run)
        self.assertEqual(list(rows), LEVELS, run.stdout)
        self.assertEqual(rows["native-gcc"][0], "run")
        self.assertEqual({rows[level][0] for level in LEVELS[1:]}, {"equal"}, run.stdout)
        self.assertIn("11 levels are equal\n", run.stdout)
        self.assertEqual(os.listdir(self.folder), ["out"])  # nothing is written beside the output folder

    def test_structs_and_two_outputs_to_a_netlist_of_a_device(self):
        self.check_all("packet_parser")

    def test_scalars_and_a_memory(self):
        self.check_all("zoom", "--target", "generic", "--tokens", "60")

    def test_processes_with_scalars_and_how_full_their_fifos_were(self):
        self.check_all("dataflow_gain", "--target", "generic", "--tokens", "60")
        out = self.folder / "out"
        streams = json.loads((out / "report.json").read_text(encoding="utf-8"))["streams"]
        self.assertTrue(streams)
        text = (out / "report.txt").read_text(encoding="utf-8")
        for stream in streams:
            # Under pauses something waits in every FIFO, and none holds more than it has places for.
            self.assertGreaterEqual(stream["peak_fill"], 1, stream)
            self.assertLessEqual(stream["peak_fill"], stream["depth"], stream)
            self.assertIn(f"  {stream['name']}: {stream['depth']} x {stream['width']} bits (at most "
                          f"{stream['peak_fill']} held), from", text)

    def test_reads_that_depend_on_state(self):
        # Its Verilog once had two operators in front of one another, which Verilator takes and Icarus does not.
        self.check_all("not_of_a_not", "--target", "generic", "--tokens", "60", folder=KERNELS.parent / "regressions")

    def test_processes_that_ask_before_they_read(self):
        # Natively every fourth question finds nothing, and the call does nothing; hardware waits. The levels behind the
        # graph know nothing of questions.
        run = self.check(KERNELS.parent / "regressions" / "asks_before_reading.cpp", "asks_before_reading",
                         "--target", "generic", "--tokens", "60", "--levels", "native-gcc,native-clang,ir-source,graph")
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        self.assertIn("4 levels are equal\n", run.stdout)

    def test_a_memory_that_many_ports_read(self):
        # Written as one array, it took synthesis over 20 GB.
        run = self.check(KERNELS.parent / "regressions" / "many_readers.cpp", "many_readers", "--levels", "netlist", "--tokens",
                         "260")
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        self.assertEqual(self.table(run)["netlist"][0], "equal")

    def test_a_netlist_that_verilator_optimises_wrongly(self):
        # With its data-flow optimiser, Verilator 5.006 computes other sums than Icarus of these gates.
        run = self.check(KERNELS / "matrix_vector.cpp", "matrix_vector", "--target", "generic", "--levels", "netlist")
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)


class Stimulus(CheckTest):
    def test_what_a_run_leaves_can_be_given_to_the_next_which_notices_other_answers(self):
        source = KERNELS / "crc32.cpp"
        first = self.check(source, "crc32", "--levels", "native-clang,graph", "--tokens", "50")
        self.assertEqual(first.returncode, 0, first.stderr)
        kept = self.folder / "out" / "check" / "stimulus.tokens"
        stimulus = self.folder / "stimulus.tokens"
        stimulus.write_text(kept.read_text(encoding="utf-8"), encoding="utf-8")
        again = self.check(source, "crc32", "--levels", "native-clang,graph", "--stimulus", "stimulus.tokens")
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertIn("stimulus file", again.stdout)
        self.assertEqual(kept.read_text(encoding="utf-8"), stimulus.read_text(encoding="utf-8"))
        # As a record of whole calls it is compared with, and nothing runs natively.
        record = [source, "crc32", "--levels", "passes", "--recorded", "--stimulus", "stimulus.tokens"]
        recorded = self.check(*record)
        self.assertEqual(recorded.returncode, 0, recorded.stderr)
        self.assertEqual(list(self.table(recorded)), ["passes"])
        # The last token of the file is one that comes out.
        lines = stimulus.read_text(encoding="utf-8").splitlines()
        lines[-1] = "token " + ("0" if lines[-1] != "token 00000000" else "1")
        stimulus.write_text("\n".join(lines) + "\n", encoding="utf-8")
        wrong = self.check(source, "crc32", "--levels", "native-clang,graph", "--stimulus", "stimulus.tokens")
        self.assertEqual(wrong.returncode, 1)
        self.assertRegex(wrong.stderr, r"crc32.cpp:\d+: error: level stimulus file differs: output 'checksum': token \d+ .* "
                                       r"the stimulus file says tdata=0\n")

        wrong = self.check(*record)
        self.assertEqual(wrong.returncode, 1)
        self.assertRegex(wrong.stderr, r"crc32.cpp:\d+: error: level passes differs: after pass 1 .*: output 'checksum': token \d+ ")

    def test_random_tokens_depend_on_the_seed_only(self):
        kept = []
        for seed in ("1", "1", "2"):
            run = self.check(KERNELS / "scrambler.cpp", "scrambler", "--levels", "native-clang", "--tokens", "30", "--seed",
                             seed)
            self.assertEqual(run.returncode, 0, run.stderr)
            kept.append((self.folder / "out" / "check" / "stimulus.tokens").read_bytes())
        self.assertEqual(kept[0], kept[1])
        self.assertNotEqual(kept[0], kept[2])


class Refusals(CheckTest):
    def refused(self, message, *options, source=KERNELS / "crc32.cpp", top="crc32", environment=None):
        run = self.check(source, top, *options, environment=environment)
        self.assertEqual(run.returncode, 1, run.stdout + run.stderr)
        self.assertEqual(run.stderr.strip().splitlines()[-1], message)

    def write(self, name, text):
        (self.folder / name).write_text(text, encoding="utf-8")
        return name

    def test_unknown_level(self):
        self.refused("error: --levels netlists: there is no such level: there are " + ", ".join(LEVELS), "--levels",
                     "graph,netlists")

    def test_registers_for_scalars(self):
        self.refused("error: --check drives the call port: leave --axi-lite away", "--axi-lite")

    def test_no_stimulus_file(self):
        self.refused("error: --stimulus none.tokens: cannot be read: is there such a file?", "--stimulus", "none.tokens",
                     "--levels", "graph")

    def test_wrong_stimulus_file(self):
        name = self.write("x.tokens", "port inn input stream tdata:8\n")
        self.refused("x.tokens:1: error: the top has no port 'inn': it has data, checksum", "--stimulus", name, "--levels", "graph")

    def test_stimulus_with_which_nothing_comes_out(self):
        name = self.write("x.tokens", "# nothing\n")
        source = KERNELS / "crc32.cpp"
        self.refused(f"{source}: error: nothing comes out with this stimulus, so nothing can be compared: give another one "
                     "with --stimulus FILE", "--stimulus", name, "--levels", "graph")

    def test_a_native_run_without_meaning(self):
        name = self.write("overrun.cpp", '#include "hls_stream.h"\n#include "ap_int.h"\n'
                          "void overrun(hls::stream<ap_uint<8> >& in, hls::stream<int>& out) {\n"
                          "  static int table[20];\n"
                          "  int index = in.read() % 64;\n"
                          "  out.write(table[index]);\n"
                          "  table[index]++;\n}\n")
        stimulus = self.write("x.tokens", "port in input stream tdata:8\ntoken 3\ntoken 20\n")
        run = self.check(name, "overrun", "--stimulus", stimulus, "--levels", "graph")
        self.assertEqual(run.returncode, 1)
        self.assertRegex(run.stderr, r"overrun.cpp: error: the kernel cannot be run natively .*overrun.cpp:6:13: runtime "
                                     r"error: index 32 out of bounds for type 'int\[20\]'")
        # Random tokens keep clear of it: only inputs that a native run can take are used.
        run = self.check(name, "overrun", "--levels", "graph", "--tokens", "40")
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)

    def test_missing_tools_are_skipped_or_refused_by_name(self):
        tools = self.folder / "tools"
        tools.mkdir()
        for tool in ("clang++-19", "ld"):
            path = next(p for p in os.environ["PATH"].split(":") if os.path.exists(os.path.join(p, tool)))
            (tools / tool).symlink_to(os.path.join(path, tool))
        environment = dict(os.environ, PATH=str(tools))
        run = self.check(KERNELS / "crc32.cpp", "crc32", "--tokens", "20", environment=environment)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        rows = self.table(run)
        self.assertEqual(rows["native-gcc"], ("skipped", "g++ is not installed (Debian package g++)"))
        self.assertEqual(rows["native-clang"][0], "run")
        self.assertEqual(rows["rtl-icarus"], ("skipped", "iverilog is not installed (Debian package iverilog)"))
        self.assertEqual(rows["netlist"], ("skipped", "verilator is not installed (Debian package verilator)"))
        self.assertIn("6 levels are equal, 5 skipped", run.stdout)
        self.refused("error: --levels rtl-icarus: iverilog is not installed (Debian package iverilog)", "--levels",
                     "rtl-icarus", environment=environment)


if __name__ == "__main__":
    check_fixture.main()
