#!/usr/bin/env python3
"""epiline-hls --prove, as a user types it: on small kernels every pass is proved, and a wrong one is refuted.

  prove_cli_test.py EPILINE-HLS
"""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

compiler = pathlib.Path(sys.argv.pop(1)).resolve()
kernels = pathlib.Path(__file__).resolve().parents[1] / "compiler/kernels"

# Small kernels: a recurrence, packets, a RAM that is read, modified and written, sums, conditions, processes.
proved_kernels = ["arbiter", "histogram", "leaky_integrator", "packet_parser", "prefix_sum", "dataflow_gain"]
passes = {"simplify", "order_memory_accesses", "merge_registers", "narrow_widths", "reduce_strength", "expand_arithmetic",
          "balance_trees", "pack_memories", "forward_memories", "fold_magnitudes", "place_tables", "foresee_reads"}


def compile_kernel(name, folder, *options):
    return subprocess.run([compiler, kernels / f"{name}.cpp", "--top", name, "-o", folder, "--ii", "auto", *options],
                          text=True, capture_output=True, check=False)


class prove(unittest.TestCase):
    def test_proves_every_pass_on_small_kernels(self):
        for kernel in proved_kernels:
            with self.subTest(kernel), tempfile.TemporaryDirectory() as folder:
                ended = compile_kernel(kernel, folder, "--prove", "--prove-seconds", "5", "-q")
                self.assertEqual(ended.returncode, 0, ended.stdout + ended.stderr)
                found = json.loads((pathlib.Path(folder) / "proof.json").read_text(encoding="utf-8"))
                self.assertEqual(found["version"], 1)
                self.assertTrue(found["solver"].startswith("Z3 "))
                self.assertEqual(set(found["totals"]), passes)
                for item in found["passes"]:
                    self.assertEqual(item["verdict"], "proved", item)
                self.assertEqual(sum(total["proved"] for total in found["totals"].values()), len(found["passes"]))
                # One line a pass.
                self.assertEqual(len(ended.stdout.splitlines()), len(found["passes"]))
                self.assertTrue((pathlib.Path(folder) / f"{kernel}.v").exists())

    def test_refutes_a_wrong_pass(self):
        for wrong in passes:
            with self.subTest(wrong), tempfile.TemporaryDirectory() as folder:
                ended = compile_kernel("prefix_sum", folder, "--prove", "--prove-fault", wrong)
                self.assertEqual(ended.returncode, 1, ended.stdout + ended.stderr)
                self.assertIn(f"prefix_sum: {wrong}: refuted", ended.stdout)
                self.assertRegex(ended.stdout, r"prefix_sum\.cpp:\d+: .* differs; the interpreter says so, too")
                self.assertRegex(ended.stderr, "^error: a pass changed what the program does")
                self.assertEqual([file.name for file in pathlib.Path(folder).iterdir()], ["proof.json"])
                found = json.loads((pathlib.Path(folder) / "proof.json").read_text(encoding="utf-8"))
                self.assertGreater(found["totals"][wrong]["refuted"], 0)
                example = next(i for i in found["passes"] if i["verdict"] == "refuted")["counterexample"]
                self.assertTrue(example["confirmed_by_interpreter"])
                self.assertTrue(example["what"])

    def test_proves_nothing_unless_asked(self):
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(compile_kernel("prefix_sum", folder).returncode, 0)
            self.assertFalse((pathlib.Path(folder) / "proof.json").exists())

    def test_refuses_a_time_that_is_none(self):
        for seconds in ["0", "-1", "soon"]:
            with self.subTest(seconds), tempfile.TemporaryDirectory() as folder:
                ended = compile_kernel("prefix_sum", folder, "--prove", "--prove-seconds", seconds)
                self.assertNotEqual(ended.returncode, 0)
                self.assertIn("--prove-seconds", ended.stderr)


if __name__ == "__main__":
    unittest.main()
