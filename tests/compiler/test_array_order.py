#!/usr/bin/env python3
"""Arrays of data that are accessed in order are streams; those that might not be are kept in memory, and a note says so.

test_array_order.py COMPILER

That either form computes what the source does is tested by regressions/arrays_of_*.cpp.
"""

import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

COMPILER = sys.argv[1]

SOURCE = """\
struct pair {{ int a; short b; }};
void top(const int a[64], const pair p[40], int b[64], pair q[40], int n, int& last) {{
  int s = 0, k = 0;
  {body}
  last = s;
}}
"""

# What a body does with the arrays, and which of them it needs memory for.
ALL = "for (int i = 0; i < 40; ++i) q[i] = p[i];"
CASES = {
    "in order": ("for (int i = 0; i < 64; ++i) b[i] = a[i];" + ALL, ""),
    "in two dimensions": ("for (int y = 0; y < 8; ++y) for (int x = 0; x < 8; ++x) b[8 * y + x] = a[8 * y + x];" + ALL, ""),
    "by a count through two loops": ("for (int y = 0; y < 8; ++y) for (int x = 0; x < 8; ++x) { b[k] = a[k]; ++k; }" + ALL, ""),
    "some at a time": ("for (int i = 0; i < 64; i += 4) for (int j = 0; j < 4; ++j) b[i + j] = a[i + 3 - j];" + ALL, "a"),
    "pairs": ("for (int i = 0; i < 32; ++i) { b[2 * i + 1] = a[2 * i]; b[2 * i] = a[2 * i + 1]; }" + ALL, ""),
    "one twice in a pass": ("for (int i = 0; i < 64; ++i) b[i] = a[i] + a[i];" + ALL, ""),
    "backwards": ("for (int i = 63; i >= 0; --i) b[i] = a[i];" + ALL, "ab"),
    "a pass too few": ("for (int i = 0; i < 63; ++i) b[i] = a[i];" + ALL, "ab"),
    "not from the beginning": ("for (int i = 1; i < 64; ++i) b[i] = a[i];" + ALL, "ab"),
    "every other one": ("for (int i = 0; i < 64; i += 2) b[i] = a[i];" + ALL, "b"),  # the others are read and left
    "with the one before": ("for (int i = 1; i < 64; ++i) s += a[i] - a[i - 1];\n for (int i = 0; i < 64; ++i) b[i] = s;" + ALL, "a"),
    "a number of passes not known": ("for (int i = 0; i < n; ++i) b[i] = a[i];" + ALL, "ab"),
    "left early": ("for (int i = 0; i < 64; ++i) { s += a[i]; if (s == n) break; b[i] = s; }" + ALL, "ab"),
    "under a condition": ("for (int i = 0; i < 64; ++i) { if (s != n) s += a[i]; b[i] = s; }" + ALL, "a"),
    "written under a condition": ("for (int i = 0; i < 64; ++i) { s += a[i]; if (s != n) b[i] = s; }" + ALL, "b"),
    "in a call in two": ("if (n & 1) for (int i = 0; i < 64; ++i) b[i] = a[i];" + ALL, "ab"),
    "again": ("for (int t = 0; t < 2; ++t) for (int i = 0; i < 64; ++i) b[i] = a[i] + t;" + ALL, "ab"),
    "in two places": ("for (int i = 0; i < 64; ++i) b[i] = a[i];" + ALL + " s = a[n & 63];", "a"),
    "read back": ("for (int i = 0; i < 64; ++i) { b[i] = a[i]; s += b[i]; }" + ALL, "b"),
    "read back elsewhere": ("for (int i = 0; i < 64; ++i) b[i] = a[i];" + ALL + " s = b[n & 63];", "b"),
    "a histogram": ("for (int i = 0; i < 64; ++i) b[i] = 0; for (int i = 0; i < 64; ++i) ++b[a[i] & 63];" + ALL, "b"),
    "member by member": (
        "for (int i = 0; i < 64; ++i) b[i] = a[i];\nfor (int i = 0; i < 40; ++i) { q[i].b = p[i].b; q[i].a = n; }", ""),
    "a member left out": (
        "for (int i = 0; i < 64; ++i) b[i] = a[i];\nfor (int i = 0; i < 40; ++i) q[i].b = p[i].b;", "q"),
}


class array_order(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)

    def compile(self, source, *options):
        """What the compiler says of a source that it takes."""
        (self.root / "top.cpp").write_text(source)
        run = subprocess.run([COMPILER, "top.cpp", "--top", "top", "-o", "out", *options], cwd=self.root,
                             capture_output=True, text=True, check=False)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        return run.stderr

    def test_which_arrays_are_streams(self):
        for case, (body, wanted) in CASES.items():
            with self.subTest(case):
                said = self.compile(SOURCE.format(body=body), "--clock", "20")
                kept = re.findall(r"^top\.cpp:2: note: the array '(\w)' is kept in memory", said, re.M)
                self.assertEqual("".join(sorted(kept)), wanted, said)

    def test_a_process_that_is_called_again_goes_through_the_array_again(self):
        source = """\
#include <hls_stream.h>
static void load(const int a[64], hls::stream<int>& s) { for (int i = 0; i < 64; ++i) s.write(a[i]); }
static void store(hls::stream<int>& s, hls::stream<int>& out) { for (int i = 0; i < 64; ++i) out.write(s.read()); }
void top(const int a[64], hls::stream<int>& out) {
#pragma HLS DATAFLOW
  hls::stream<int> s;
  %s
}
"""
        calls = "load(a, s); store(s, out);"
        for body, is_kept in ((calls, False), ("for (int t = 0; t < 2; ++t) { " + calls + " }", True)):
            with self.subTest(body):
                said = self.compile(source % body, "--check", "--levels", "native-gcc", "--levels", "graph")
                self.assertEqual("'a' is kept in memory" in said, is_kept, said)

    def test_an_array_that_nobody_looks_at_is_taken_all_the_same(self):
        said = self.compile("void top(const int a[64], int b[64]) { for (int i = 0; i < 64; ++i) b[i] = i; }\n")
        self.assertIn("top.cpp:1: note: the array 'a' is not used: its elements are taken before the call", said)
        self.assertIn("s_axis_a_tready", (self.root / "out" / "top.v").read_text())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
