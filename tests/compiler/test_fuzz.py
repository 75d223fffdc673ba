"""The random programs and the run over them: nothing is compiled here, run_batch.py is replaced by a program of the test's."""

import argparse
import io
import contextlib
import json
import pathlib
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

import fuzz  # noqa: E402
import random_program  # noqa: E402
import reduce_program  # noqa: E402
import verilator_group  # noqa: E402

# Every program equal but those whose seeds are given; a line in `calls` a batch.
STAND_IN = """
import json, pathlib, sys
work, bad, result, first, count = pathlib.Path(sys.argv[1]), json.loads(sys.argv[2]), sys.argv[3], *map(int, sys.argv[4:])
with open(work.parents[1] / "calls", "a") as calls:
    calls.write(f"{first} {count}\\n")
(work / "programs").mkdir()
programs = {}
for seed in range(first, first + count):
    name = f"random_{seed}"
    programs[name] = {"features": ["+ 1u", "switch"]}
    (work / "programs" / f"{name}.cpp").write_text(f"void {name}() {{}}\\n")
    (work / "programs" / f"{name}.drive.cpp").write_text(
        f'#include "drive.hpp"\\nnamespace program_{name} {{\\n#include "{name}.cpp"\\n}}\\nusing namespace program_{name};\\n'
        f"EPILINE_DRIVER({name}) {{ {name}(); }}\\n")
    if str(seed) in bad:
        programs[name].update(level=bad[str(seed)][0], text=bad[str(seed)][1])
pathlib.Path(result).write_text(json.dumps({"programs": programs, "notes": [], "seconds": 1, "processor_seconds": 2}))
"""


class fuzzer_without_compiler(fuzz.Fuzzer):
    bad = {}

    def command(self, work, *what):
        result, first, count = what[what.index("--json") + 1], what[-2], what[-1]
        return [sys.executable, "-c", STAND_IN, str(work), json.dumps(self.bad), result, first, count]


class runs(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.root = pathlib.Path(temporary.name)
        for file in fuzz.programs_of(self.root / "build").values():
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text("a program")

    def run_fuzzer(self, bad=None, **changes):
        given = {"build": str(self.root / "build"), "state": str(self.root / "state"), "programs": 10, "seed": 5, "jobs": 2,
                 "batch": 4, "group": 2}
        fuzzer = fuzzer_without_compiler(argparse.Namespace(**{**given, **changes}))
        fuzzer.bad = bad or {}
        with contextlib.redirect_stdout(io.StringIO()) as output:
            code = fuzzer.run_all()
        fuzzer.lock.close()
        calls = fuzzer.state / "calls"
        done = sorted(calls.read_text().splitlines()) if calls.exists() else []
        calls.unlink(missing_ok=True)
        return code, done, output.getvalue(), fuzzer.state

    def test_every_seed_is_run_once_and_finished_batches_are_kept(self):
        code, done, _, state = self.run_fuzzer()
        self.assertEqual((code, done), (0, ["13 2", "5 4", "9 4"]))
        found = json.loads((state / "statistics.json").read_text())
        self.assertEqual((found["programs"], found["equal"], found["seeds"]), (10, 10, [5, 14]))
        self.assertEqual(found["features"], {"+": {"1u": 10}, "switch": {"any": 10}})
        (state / "batch_9_4.json").unlink()
        self.assertEqual(self.run_fuzzer()[1], ["9 4"])
        self.assertEqual(self.run_fuzzer()[1], [])
        self.assertEqual(self.run_fuzzer(programs=14)[1], ["13 4", "17 2"])

    def test_another_compiler_begins_anew(self):
        first = self.run_fuzzer()[3]
        (self.root / "build" / "bin" / "epiline-hls").write_text("another program")
        _, done, _, second = self.run_fuzzer()
        self.assertEqual(len(done), 3)
        self.assertNotEqual(first, second)

    def test_a_stopped_run_leaves_no_half_batch_and_goes_on(self):
        original = fuzzer_without_compiler.command

        def slow(fuzzer, work, *what):
            fuzzer.stopping.set()  # as Ctrl-C at this moment
            return original(fuzzer, work, *what)

        fuzzer_without_compiler.command = slow
        self.addCleanup(setattr, fuzzer_without_compiler, "command", original)
        code, _, output, state = self.run_fuzzer(jobs=1)
        self.assertEqual(code, 130)
        self.assertIn("goes on from there", output)
        self.assertEqual(list(state.glob("batch_*")), [])
        fuzzer_without_compiler.command = original
        self.assertEqual(len(self.run_fuzzer()[1]), 3)

    def test_failures_are_counted_by_level_and_kept(self):
        bad = {"6": ["RTL", "no pauses: token 3"], "7": ["compiler", "exit code 1: a.cpp:3: error: 'x' is 5 wide"],
               "8": ["compiler", "crashed (-11): "], "9": ["compiler", "exit code 1: b.cpp:41: error: 'y' is 70 wide"]}
        code, _, output, state = self.run_fuzzer(bad)
        self.assertEqual(code, 1)
        found = json.loads((state / "statistics.json").read_text())
        self.assertEqual({k: v for k, v in found["failures"].items() if v}, {"refused": 2, "crashed": 1, "RTL": 1})
        self.assertEqual(found["failed"]["refused"], ["random_7", "random_9"])
        self.assertEqual(found["messages"]["'...' is N wide"], 2)
        self.assertIn("FAILED random_6: RTL", output)
        self.assertEqual(json.loads((state / "failures" / "random_7" / "failure.json").read_text())["level"], "refused")

    def test_a_failure_becomes_a_regression_test(self):
        state = self.run_fuzzer({"6": ["RTL", "token 3"]})[3]
        tests = self.root / "tests"
        for folder in ("regressions", "drivers"):
            (tests / folder).mkdir(parents=True)
        with contextlib.redirect_stdout(io.StringIO()):
            reduce_program.keep(state / "failures" / "random_6", "wrong_word", tests)
        self.assertEqual((tests / "regressions" / "wrong_word.cpp").read_text(), "void wrong_word() {}\n")
        self.assertEqual((tests / "drivers" / "wrong_word.cpp").read_text(),
                         '#include "../drive.hpp"\nnamespace regression_wrong_word {\n'
                         '#include "../regressions/wrong_word.cpp"\n}\nusing namespace regression_wrong_word;\n'
                         "EPILINE_DRIVER(wrong_word) { wrong_word(); }\n")
        with self.assertRaises(SystemExit):
            reduce_program.keep(state / "failures" / "random_6", "wrong_word", tests)


class groups(unittest.TestCase):
    """A module's signals in the wide ports of a group."""

    def test_every_signal_has_bits_of_its_own_and_every_other_bit_is_said_to_be_free(self):
        words = verilator_group.Words("in_a")
        self.assertEqual(words.take([("valid", 1, 0)], 1), (0, [".valid(in_a[0:0])"]))
        # two fields of a token of 70 bits, with a gap between them
        first, connections = words.take([("data", 33, 0), ("last", 1, 69)], 70)
        self.assertEqual((first, connections), (1, [".data(in_a[64:32])", ".last(in_a[101:101])"]))
        self.assertEqual(words.take([("ready", 1, 0)], 1)[0], 4)
        self.assertEqual(words.bits(), 5 * 32)
        taken = {0, *range(32, 65), 101, 128}
        free = {bit for high, low in words.free() for bit in range(low, high + 1)}
        self.assertEqual(free | taken, set(range(words.bits())))
        self.assertEqual(free & taken, set())

    def test_a_narrow_port_is_wide_enough_for_an_array_of_words(self):
        words = verilator_group.Words("out_a")
        words.take([("ready", 1, 0)], 1)
        self.assertEqual(words.bits(), 96)


class programs(unittest.TestCase):
    def test_the_same_seed_gives_the_same_program(self):
        for seed in (1, 5, 77):
            self.assertEqual(random_program.generate(seed), random_program.generate(seed))

    def test_what_the_subset_has_is_in_them(self):
        met, widths = set(), set()
        for seed in range(600):
            program, _, features = random_program.generate(seed)
            met |= {name for name, _ in features}
            widths |= {where.rstrip("su") for _, where in features if where}
            is_network = "#pragma HLS DATAFLOW" in program or "hls::task " in program
            self.assertEqual(is_network, seed % 6 == 5)
        wanted = {"+", "-", "*", "/", "%", "/ constant", "&", "|", "^", "<<", ">>", "~", "unary -", "?:", "<", "==", "range",
                  "range =", "bit", "bit =", "concat", "table", "RAM", "RAM with initial contents", "RAM read, changed, written",
                  "RAM part of a word", "switch", "struct", "local array", "early exit", "shape while", "shape phases",
                  "call of a function template", "call of a functor", "call of a lambda", "ways that meet", "processes 5",
                  "pragma RESET off", "pragma UNROLL", "pragma ARRAY_PARTITION", "pragma STREAM depth", "pragma INTERFACE",
                  "second write in an iteration", "result by reference", "payload struct", "payload AXI", "tasks",
                  "endless loop", "question empty", "question full", "read_nb", "array in order", "array backwards",
                  "array pairs", "array any"}
        self.assertEqual(wanted - met, set())
        self.assertEqual({"1", "2", "31-33", "63-65", "129-200"} - widths, set())


if __name__ == "__main__":
    unittest.main()
