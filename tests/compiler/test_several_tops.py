#!/usr/bin/env python3
"""Several tops of one source in one run of epiline-hls: each becomes what it becomes alone, and one that is wrong leaves the
others alone.

test_several_tops.py COMPILER
"""

import pathlib
import subprocess
import sys
import tempfile
import unittest

COMPILER = sys.argv[1]

# What a module of several tops could mix up: arrays of streams, what is returned, processes, static state, and values computed
# before main.
SOURCE = """#include "ap_int.h"
#include "hls_stream.h"
namespace first {
struct table_of_squares {
  ap_uint<8> values[32];
  table_of_squares() { for (int i = 0; i < 32; ++i) values[i] = i * i; }
};
const table_of_squares table;
void lanes(hls::stream<ap_uint<8>> in[3], hls::stream<ap_uint<10>>& out) {
#pragma HLS PIPELINE II=1
  out.write(in[0].read() + in[1].read() + table.values[in[2].read() & 31]);
}
}
namespace second {
static void load(hls::stream<ap_uint<8>>& in, hls::stream<ap_uint<8>>& way) {
#pragma HLS PIPELINE II=1
  static ap_uint<8> state = 5;
  state ^= in.read();
  way.write(state);
}
static void store(hls::stream<ap_uint<8>>& way, hls::stream<ap_uint<8>>& out) {
#pragma HLS PIPELINE II=1
  out.write(way.read() + 1);
}
void chain(hls::stream<ap_uint<8>>& in, hls::stream<ap_uint<8>>& out) {
#pragma HLS DATAFLOW
  hls::stream<ap_uint<8>> way("way");
  load(in, way);
  store(way, out);
}
}
ap_uint<9> sum(hls::stream<ap_uint<8>>& in, ap_uint<8> offset) {
#pragma HLS PIPELINE II=1
  return in.read() + offset;
}
void floats(hls::stream<ap_uint<8>>& in, hls::stream<ap_uint<8>>& out) {
#pragma HLS PIPELINE II=1
  out.write(int(0.5f * int(in.read())));
}
ap_uint<8>* points(hls::stream<ap_uint<8>>& in) { in.read(); return nullptr; }
"""
GOOD = ["first::lanes", "second::chain", "sum"]


class several_tops(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.root = pathlib.Path(temporary.name)
        (self.root / "tops.cpp").write_text(SOURCE, encoding="utf-8")

    def compile(self, folder, *tops):
        return subprocess.run([COMPILER, "tops.cpp", *sum((["--top", top] for top in tops), []), "-o", folder, "-q"],
                              cwd=self.root, capture_output=True, text=True, check=False)

    def files(self, folder, top):
        """What is written of a top, without the reports, which tell how long it took."""
        name = top.split("::")[-1]
        return {file: (self.root / folder / f"{name}{file}").read_bytes() for file in (".v", ".graph", ".signals.json")}

    def test_each_is_compiled_as_if_alone_whatever_becomes_of_the_others(self):
        run = self.compile("together", *GOOD[:2], "floats", *GOOD[2:])
        self.assertEqual(run.returncode, 1, run.stderr)
        self.assertRegex(run.stderr, r"\Atops\.cpp:38: error: floating point.*\n\Z")
        self.assertFalse((self.root / "together" / "floats").exists())
        for top in GOOD:
            alone = self.compile("alone_" + top.replace(":", ""), top)
            self.assertEqual((alone.returncode, alone.stderr), (0, ""))
            self.assertEqual(self.files("together/" + top.split("::")[-1], top),
                             self.files("alone_" + top.replace(":", ""), top))

    def test_a_top_that_breaks_the_whole_source_is_named(self):
        run = self.compile("together", "sum", "points")
        self.assertEqual((run.returncode, run.stdout), (1, ""))
        self.assertIn("points", run.stderr)
        self.assertFalse((self.root / "together").exists())
        run = self.compile("together", "sum", "nothing")
        self.assertEqual(run.returncode, 1)
        self.assertIn("nothing", run.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
