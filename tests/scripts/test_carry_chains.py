"""scripts/carry_chains.py: chains of ECP5 carry cells compute what they did, with fewer cells around them."""

import copy
import json
import pathlib
import random
import subprocess
import sys
import tempfile
import unittest

root = pathlib.Path(__file__).resolve().parents[2]
script = root / "scripts" / "carry_chains.py"
sys.path.insert(0, str(root / "scripts"))
import carry_chains  # noqa: E402

SUM = format(0x96AA, "016b")  # the function that Yosys gives a bit of a sum: (C ? B ^ D' : B) + A, as a table


def chain_of(width, carry_in, reads_carry):
    """A module with a chain of `width` bits whose inputs are ports; the net of the carry in is `carry_in`."""
    numbers = iter(range(10, 10000))
    module = {"ports": {}, "cells": {}}

    def port(name, direction, bit):
        module["ports"][name] = {"direction": direction, "bits": [bit]}
        return [bit]

    carry = [carry_in] if isinstance(carry_in, str) else port("carry_in", "input", carry_in)
    for cell in range((width + 1) // 2):
        connections = {"CIN": carry}
        for half in (0, 1):
            place = 2 * cell + half
            used = place < width
            connections[f"A{half}"] = port(f"a{place}", "input", next(numbers)) if used else ["0"]
            connections[f"B{half}"] = port(f"b{place}", "input", next(numbers)) if used else ["0"]
            connections[f"C{half}"] = ["0"]
            connections[f"D{half}"] = ["1"]
            total = next(numbers)
            connections[f"S{half}"] = port(f"s{place}", "output", total) if used else [total]
        carry = connections["COUT"] = [next(numbers)]
        module["cells"][f"carry{cell}"] = {
            "type": "CCU2C",
            "parameters": {"INIT0": SUM, "INIT1": SUM, "INJECT1_0": "NO", "INJECT1_1": "NO"},
            "port_directions": {p: "output" if p[0] == "S" or p == "COUT" else "input" for p in connections},
            "connections": connections,
        }
    if reads_carry:
        port("carry_out", "output", carry[0])
    return module


def outputs(module, inputs):
    """What the module's ports give; an open carry in is anything: both values are tried and must not matter."""

    def evaluate(open_value):
        nets = {"0": 0, "1": 1, "x": open_value}
        for name, port in module["ports"].items():
            if port["direction"] == "input":
                nets[port["bits"][0]] = inputs[name]
        for chain in carry_chains.find_chains(module):
            for cell in chain:
                value = {port: nets.get(bits[0]) for port, bits in cell["connections"].items()}
                carry = value["CIN"]
                for half in "01":
                    table = int(cell["parameters"]["INIT" + half], 2)
                    a, b, c, d = (value[p + half] for p in "ABCD")
                    propagate, generate = table >> (8 * d + 4 * c + 2 * b + a) & 1, table >> (2 * b + a) & 1
                    nets[cell["connections"]["S" + half][0]] = propagate ^ carry
                    carry = carry if propagate else generate
                if cell["connections"]["COUT"] != ["x"]:
                    nets[cell["connections"]["COUT"][0]] = carry
        return {n: nets[p["bits"][0]] for n, p in module["ports"].items() if p["direction"] == "output"}

    found = evaluate(0)
    assert found == evaluate(1), "an open carry matters"
    return found


class carry_chain(unittest.TestCase):
    def equal(self, before, after):
        numbers = random.Random(1)
        for _ in range(200):
            inputs = {n: numbers.getrandbits(1) for n, p in before["ports"].items() if p["direction"] == "input"}
            self.assertEqual(outputs(before, inputs), outputs(after, inputs))

    def changed(self, module, change):
        after = copy.deepcopy(module)
        return change(after), after

    def test_chains_with_an_unused_last_bit_begin_in_themselves(self):
        for width in (1, 3, 7):
            for carry_in in ("0", "1", 5):
                with self.subTest(width=width, carry_in=carry_in):
                    before = chain_of(width, carry_in, False)
                    count, after = self.changed(before, carry_chains.begin_in_themselves)
                    self.assertEqual(count, 1)
                    self.assertEqual(after["cells"]["carry0"]["connections"]["CIN"], ["x"])
                    self.assertEqual(len(after["cells"]), len(before["cells"]))
                    self.equal(before, after)
                    self.assertEqual(carry_chains.begin_in_themselves(after), 0, "a second time there is nothing left")

    def test_chains_that_are_full_or_whose_carry_is_read_stay(self):
        for width, reads_carry in ((4, False), (4, True), (3, True)):
            with self.subTest(width=width, reads_carry=reads_carry):
                before = chain_of(width, "1", reads_carry)
                count, after = self.changed(before, carry_chains.begin_in_themselves)
                self.assertEqual((count, after), (0, before))

    def test_chains_with_a_carry_that_is_read_on_the_way_stay(self):
        before = chain_of(5, "1", False)
        before["ports"]["carry_of_4"] = {"direction": "output", "bits": before["cells"]["carry1"]["connections"]["COUT"]}
        count, after = self.changed(before, carry_chains.begin_in_themselves)
        self.assertEqual((count, after), (0, before))

    def test_ends_that_nothing_reads_are_left_open(self):
        for width in (3, 4):
            before = chain_of(width, 5, False)
            count, after = self.changed(before, carry_chains.open_ends)
            self.assertEqual(count, 1)
            self.assertEqual(after["cells"]["carry1"]["connections"]["COUT"], ["x"])
            self.equal(before, after)
            self.assertEqual(carry_chains.open_ends(after), 0)
        before = chain_of(4, 5, True)
        count, after = self.changed(before, carry_chains.open_ends)
        self.assertEqual((count, after), (0, before))

    def test_two_chains_stay_apart(self):
        one, other = chain_of(3, "0", False), chain_of(4, "1", False)
        module = {"ports": dict(one["ports"]), "cells": dict(one["cells"])}
        shifted = json.loads(json.dumps(other))
        for cell in shifted["cells"].values():
            cell["connections"] = {p: [b + 1000 if isinstance(b, int) else b for b in bits]
                                   for p, bits in cell["connections"].items()}
        for name, port in shifted["ports"].items():
            module["ports"]["other_" + name] = {**port, "bits": [port["bits"][0] + 1000]}
        module["cells"].update({"other_" + n: c for n, c in shifted["cells"].items()})
        count, after = self.changed(module, carry_chains.begin_in_themselves)
        self.assertEqual(count, 1)
        self.assertEqual(carry_chains.open_ends(after), 2)
        self.equal(module, after)


class the_program(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.file = pathlib.Path(folder.name) / "netlist.json"

    def run_script(self, *arguments):
        return subprocess.run([sys.executable, "-B", script, *arguments], text=True, capture_output=True, check=False)

    def test_changes_the_file_in_place(self):
        before = chain_of(3, "1", False)
        self.file.write_text(json.dumps({"modules": {"top": before}}), encoding="utf-8")
        self.assertEqual(self.run_script(self.file).stdout, "1 carry chains begin in themselves\n")
        self.assertEqual(self.run_script("--open-ends", self.file).stdout, "1 ends left open\n")
        after = json.loads(self.file.read_text(encoding="utf-8"))["modules"]["top"]
        self.assertEqual(after["cells"]["carry1"]["connections"]["COUT"], ["x"])
        self.assertEqual(after["cells"]["carry0"]["connections"]["CIN"], ["x"])

    def test_refuses_what_is_no_netlist_and_leaves_it_as_it_is(self):
        for text in ("{", "[]", '{"modules": {"top": {"cells": {"a": {"type": "CCU2C"}}, "ports": {}}}}'):
            self.file.write_text(text, encoding="utf-8")
            ended = self.run_script(self.file)
            self.assertEqual(ended.returncode, 1)
            self.assertIn(f"carry_chains.py: error: {self.file} is not a netlist that Yosys wrote", ended.stderr)
            self.assertEqual(self.file.read_text(encoding="utf-8"), text)
        self.assertIn("error", self.run_script(self.file.with_name("none.json")).stderr)

    def test_says_how_it_is_called(self):
        for arguments in ((), ("--shorten", "x.json"), ("a.json", "b.json"), ("--open-ends",)):
            ended = self.run_script(*arguments)
            self.assertEqual(ended.returncode, 1)
            self.assertTrue(ended.stderr.startswith("carry_chains.py NETLIST.json"), ended.stderr)


if __name__ == "__main__":
    unittest.main()
