"""scripts/carry_chains.py, join_carry_chains.py: chains of ECP5 carry cells compute what they did, in fewer cells and tiles."""

import copy
import itertools
import json
import pathlib
import random
import subprocess
import sys
import tempfile
import unittest

root = pathlib.Path(__file__).resolve().parents[2]
scripts = root / "scripts"
sys.path.insert(0, str(scripts))
import carry_chains  # noqa: E402
import join_carry_chains  # noqa: E402
from carry_chains import begin_and_end_in_themselves as change  # noqa: E402

SUM = format(0x96AA, "016b")  # the function that Yosys gives a bit of a sum: (C ? B ^ D' : B) + A, as a table


def chain_of(width, carry_in, reads_carry, reads_sums=True):
    """A module with a chain of `width` bits whose inputs are ports; the net of the carry in is `carry_in`. Bits of the last
    cell beyond `width` hand the carry on."""
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
            connections[f"B{half}"] = port(f"b{place}", "input", next(numbers)) if used else ["1"]
            connections[f"C{half}"] = ["0"]
            connections[f"D{half}"] = ["1"]
            total = next(numbers)
            connections[f"S{half}"] = port(f"s{place}", "output", total) if used and reads_sums else [total]
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
            for cell in (module["cells"][name] for name in chain):
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
        for cell in module["cells"].values():
            if cell["type"] == "LUT4":
                a, b, c, d = (nets[cell["connections"][p][0]] for p in "ABCD")
                nets[cell["connections"]["Z"][0]] = int(cell["parameters"]["INIT"], 2) >> (8 * d + 4 * c + 2 * b + a) & 1
        return {n: nets[p["bits"][0]] for n, p in module["ports"].items() if p["direction"] == "output"}

    found = evaluate(0)
    assert found == evaluate(1), "an open carry matters"
    return found


class chains_of_modules(unittest.TestCase):
    def equal(self, before, after):
        numbers = random.Random(1)
        for _ in range(200):
            inputs = {n: numbers.getrandbits(1) for n, p in before["ports"].items() if p["direction"] == "input"}
            self.assertEqual(outputs(before, inputs), outputs(after, inputs))


class carry_chain(chains_of_modules):
    def changed(self, module, change):
        after = copy.deepcopy(module)
        return change(after), after

    def test_chains_begin_and_end_in_themselves(self):
        """Nothing has to come into a chain, nor out of its end, so that nextpnr puts no cell before it or after it."""
        for width, carry_in, reads_carry, reads_sums in itertools.product(
            (1, 2, 3, 4, 7, 8), ("0", "1", 5), (False, True), (True, False)
        ):
            if not reads_carry and not reads_sums:
                continue
            with self.subTest(width=width, carry_in=carry_in, reads_carry=reads_carry, reads_sums=reads_sums):
                before = chain_of(width, carry_in, reads_carry, reads_sums)
                count, after = self.changed(before, change)
                self.assertEqual(count, 1)
                self.equal(before, after)
                (chain,) = carry_chains.find_chains(after)
                self.assertEqual(after["cells"][chain[0]]["connections"]["CIN"], ["x"])
                ends = {bit for port in after["ports"].values() for bit in port["bits"]}
                self.assertNotIn(after["cells"][chain[-1]]["connections"]["COUT"][0], ends)
                bits = width + reads_carry
                folded = carry_in != 5 and (not reads_sums or bits % 2 == 0)
                self.assertEqual(len(chain), (bits + (0 if folded else 1) + 1) // 2)
                luts = [cell for cell in after["cells"].values() if cell["type"] == "LUT4"]
                self.assertEqual(len(luts), 1 if folded and reads_sums else 0)
                self.assertEqual(self.changed(after, change), (0, after), "a second time there is nothing left")

    def test_chains_with_a_carry_that_is_read_on_the_way_stay(self):
        before = chain_of(5, "1", False)
        before["ports"]["carry_of_4"] = {"direction": "output", "bits": before["cells"]["carry1"]["connections"]["COUT"]}
        count, after = self.changed(before, change)
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
        other = renamed(other, "other_", 1000)
        module["ports"].update(other["ports"])
        module["cells"].update(other["cells"])
        count, after = self.changed(module, change)
        self.assertEqual(count, 2)
        self.assertEqual(carry_chains.open_ends(after), 2)
        self.equal(module, after)


def renamed(module, prefix, shift):
    """The module with `prefix` before its names and other nets."""
    def nets(bits):
        return [bit + shift if isinstance(bit, int) else bit for bit in bits]

    return {
        "ports": {prefix + name: {**port, "bits": nets(port["bits"])} for name, port in module["ports"].items()},
        "cells": {
            prefix + name: {**cell, "connections": {p: nets(bits) for p, bits in cell["connections"].items()}}
            for name, cell in copy.deepcopy(module["cells"]).items()
        },
    }


def sums_that_meet(widths):
    """A module with chains that begin in themselves, of `widths` bits each, and one that adds the first bits of all."""
    module = {"ports": {}, "cells": {}}
    for index, width in enumerate(widths):
        chain = chain_of(width, 5, False)
        change(chain)
        one = renamed(chain, f"chain{index}_", 10000 * (index + 1))
        module["ports"].update(one["ports"])
        module["cells"].update(one["cells"])
    total = chain_of(len(widths), "0", False)
    for index in range(len(widths)):
        total["cells"][f"carry{index // 2}"]["connections"][f"A{index % 2}"] = module["ports"][f"chain{index}_s0"]["bits"]
        del total["ports"][f"a{index}"]
    module["ports"].update(total["ports"])
    module["cells"].update({"total_" + name: cell for name, cell in total["cells"].items()})
    change(module)
    carry_chains.open_ends(module)
    return module


def cell_of(kind, **pins):
    """A cell with an output `DO` or `Z` and inputs otherwise."""
    directions = {pin: "output" if pin in ("DO", "Z") else "input" for pin in pins}
    return {"type": kind, "parameters": {}, "port_directions": directions, "connections": pins}


def sizes(module):
    return sorted(len(chain) for chain in carry_chains.find_chains(module))


class joined_chains(chains_of_modules):
    def test_chains_whose_sums_meet_fill_tiles_together(self):
        """Three chains of five cells take four tiles, not six; the chain that adds them, which waits for them, stays."""
        before = sums_that_meet((9, 9, 9))
        self.assertEqual(sizes(before), [2, 5, 5, 5])
        after = copy.deepcopy(before)
        self.assertEqual(join_carry_chains.join(after), 2)
        self.assertEqual(sizes(after), [2, 15])
        self.equal(before, after)
        self.assertEqual(join_carry_chains.join(after), 0, "a second time there is nothing left")

    def test_chains_stay_alone_where_no_tile_is_saved(self):
        for widths in ((7, 7, 7), (15, 15), (31, 9)):
            with self.subTest(widths=widths):
                module = sums_that_meet(widths)
                before = copy.deepcopy(module)
                self.assertEqual(join_carry_chains.join(module), 0)
                self.assertEqual(module, before)

    def test_chains_that_need_their_carry_are_not_joined(self):
        module = sums_that_meet((9, 9, 9))
        first = module["cells"]["chain0_carry0"]
        module["ports"]["carry"] = {"direction": "input", "bits": [9]}
        first["connections"]["CIN"] = [9]
        self.assertEqual(join_carry_chains.join(module), 1, "the other two")
        self.assertEqual(first["connections"]["CIN"], [9])
        module = sums_that_meet((9, 9))
        end = module["cells"]["chain0_carry4"]["connections"]
        end["COUT"] = [8]
        module["ports"]["carry_out"] = {"direction": "output", "bits": [8]}
        self.assertEqual(join_carry_chains.join(module), 0)

    def test_chains_that_wait_for_different_numbers_of_chains_are_not_joined(self):
        """Joined they could close a loop: the one that comes first may wait for the other."""
        module = sums_that_meet((9, 9))
        first, second = module["cells"]["chain0_carry0"], module["cells"]["chain1_carry4"]
        self.assertEqual(join_carry_chains.join(copy.deepcopy(module)), 1)
        first["connections"]["A1"] = second["connections"]["S0"]
        self.assertEqual(join_carry_chains.join(module), 0)


    def test_a_word_that_is_changed_in_a_lut_ram_is_no_loop(self):
        """What is written comes out a clock later: only the address that is read goes on in the same clock."""
        module = sums_that_meet((9, 9))
        module["cells"]["memory"] = cell_of("TRELLIS_DPR16X4", RAD=[1], WAD=[1], DI=[2], WRE=[1], WCK=[1], DO=[3])
        module["cells"]["changed"] = cell_of("LUT4", A=[3], B=["0"], C=["0"], D=["0"], Z=[2])
        self.assertEqual(join_carry_chains.join(module), 1)


class the_program(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.file = pathlib.Path(folder.name) / "netlist.json"

    def run_script(self, *arguments, script="carry_chains.py"):
        return subprocess.run([sys.executable, "-B", scripts / script, *arguments], text=True, capture_output=True, check=False)

    def test_changes_the_file_in_place(self):
        before = chain_of(3, "1", False)
        self.file.write_text(json.dumps({"modules": {"top": before}}), encoding="utf-8")
        self.assertEqual(self.run_script(self.file).stdout, "1 carry chains begin and end in themselves\n")
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
        self.assertIn("join_carry_chains.py: error", self.run_script(self.file, script="join_carry_chains.py").stderr)

    def test_says_how_it_is_called(self):
        for arguments in ((), ("--shorten", "x.json"), ("a.json", "b.json"), ("--open-ends",)):
            ended = self.run_script(*arguments)
            self.assertEqual(ended.returncode, 1)
            self.assertTrue(ended.stderr.startswith("carry_chains.py NETLIST.json"), ended.stderr)
        ended = self.run_script(script="join_carry_chains.py")
        self.assertEqual((ended.returncode, ended.stderr), (1, "join_carry_chains.py NETLIST.json\n"))


if __name__ == "__main__":
    unittest.main()
