#!/usr/bin/env python3
"""scripts/delay_fit.py: delays out of pieces of nextpnr's reports, the fit, and the page made of it."""

import contextlib
import copy
import io
import json
import pathlib
import sys
import tempfile
import unittest

root = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(root / "scripts"), str(root / "scripts" / "fpga")]
import delay_fit  # noqa: E402
import delay_fitting  # noqa: E402
import timing_samples  # noqa: E402
from flow_error import flow_error  # noqa: E402

clock = "posedge $glbnet$clk$TRELLIS_IO_IN"


def part(kind, delay, source, target=None, cell="a", near=False):
    """A part of a critical path as nextpnr 0.11 writes it."""
    start = {"cell": cell, "loc": [1, 2], "port": source}
    end = {"cell": cell, "loc": [1, 2] if near or kind != "routing" else [4, 2], "port": target or source}
    return {"delay": delay, "from": start, "to": end, "type": kind}


# Recorded from a FIFO's count of places (fir, seed 1) and from a multiplier's and a block RAM's paths, names shortened.
recorded_path = [
    part("clk-to-q", 0.395, "Q"),
    part("routing", 0.844, "Q", "A"),
    part("logic", 0.355, "A", "FCO", "c$CCU2_COMB0"),
    part("routing", 0.0, "FCO", "FCI", near=True),
    part("logic", 0.0, "FCI", "FCO", "c$CCU2_COMB1"),
    part("routing", 0.0, "FCO", "FCI", near=True),
    part("logic", 0.056, "FCI", "FCO", "d$CCU2_COMB0"),
    part("routing", 0.0, "FCO", "FCI", near=True),
    part("logic", 0.328, "FCI", "F", "d$CCU2_COMB1"),
    part("routing", 0.665, "F", "D"),
    part("logic", 0.18, "D", "F"),
    part("routing", 0.118, "F", "DI", near=True),
    part("setup", 0.0, "DI"),
]
block_ram_path = [
    part("clk-to-q", 0.718, "DOB1"),
    part("routing", 2.718, "DOB1", "B"),
    part("logic", 0.306, "B", "OFX"),
    part("routing", 1.2, "OFX", "CE"),
    part("setup", 0.287, "CE"),
]


def net(port, ends, event=clock):
    """A net whose ends are (port, arrival)."""
    endpoints = [{"cell": "e", "delay": [at - 0.1, at], "event": clock, "port": end} for end, at in ends]
    return {"driver": "d", "endpoints": endpoints, "event": event, "net": "n", "port": port, "sources": []}


def routed_report(period=2.941):
    return {
        "critical_paths": [
            {"from": "<async>", "to": clock, "path": block_ram_path},
            {"from": clock, "to": clock, "path": recorded_path},
        ],
        "detailed_net_timings": [
            net("Q", [("M", 1.395)]),
            net("Q", [("CE", 0.895), ("CE", 0.995), ("M", 1.095)]),
            net("Q", [("ADA5", 2.395), ("ADB4", 2.395)]),
            net("F", [("DI", 1.558)]),  # behind logic: not one wire
            net("Q", [("M", 0.817)], "<async>"),  # from a pin
        ],
        "fmax": {clock: {"achieved": 1000 / period, "constraint": 150}},
    }


def prediction(*chains):
    keys = ("cells_ns", "wires", "reader_doublings")
    return {"side": 20.0, "chains": [dict(zip(keys, chain)) for chain in chains]}


class run_folder:
    """What scripts/fpga.sh leaves, as far as it is read."""

    def __init__(self, folder, top="design", seeds=(2.9, 3.0, 3.3)):
        self.folder = folder
        (folder / "hls").mkdir(parents=True)
        self.write_report({"clock": {"estimated_period_ns": 2.5}, "prediction": prediction((1.3, 2.0, 1.0))})
        for seed, period in enumerate(seeds, 1):
            (folder / f"seed_{seed}").mkdir()
            (folder / f"seed_{seed}" / "report.json").write_text(json.dumps(routed_report(period)))
        run = {
            "schema": "epiline-fpga/1",
            "top": top,
            "command": "scripts/fpga.sh design",
            "device": "LFE5U-85F",
            "speed_grade": 8,
            "clock": {"scheduled_ns": 6.0},
            "resources": {"lut4": 100, "flip_flops": 400, "block_rams": 1},
            "seeds": [{"seed": seed, "fmax_mhz": 1000 / period} for seed, period in enumerate(seeds, 1)],
        }
        (folder / f"{top}.json").write_text(json.dumps(run))

    def write_report(self, report):
        (self.folder / "hls" / "report.json").write_text(json.dumps(report))


cells = {kind: 0.2 for kind in delay_fitting.cell_delays}
true_wires = {
    "wire": 0.6,
    "reader_doubling": 0.05,
    "block_wire": 1.0,
    "side_doubling": 0.5,
}
old_file = {"schema": "epiline-device-delays/1", "target": "ecp5", "cells_ns": cells, "wires_ns": true_wires}


def made_up_samples():
    """Designs whose routed periods are exactly what `true_wires` predict."""
    samples = []
    for number, (side, chains) in enumerate(
        [
            (15, [(1.0, 2.0, 1.0), (2.0, 1.0, 0.0)]),
            (25, [(1.5, 4.0, 3.0), (2.5, 1.0, 1.0)]),
            (40, [(2.0, 3.0, 2.0)]),
            (80, [(1.0, 5.0, 1.0), (2.8, 2.0, 4.0)]),
            (190, [(1.9, 3.0, 4.0)]),
            (230, [(1.2, 2.0, 6.0), (2.0, 3.5, 0.0)]),
        ]
    ):
        sample = {"name": f"design_{number}", "side": side, "lut4": side * side, "flip_flops": 10, "estimated_ns": 4.0}
        sample["chains"] = prediction(*chains)["chains"]
        sample["cells_ps"] = {"lut": {"100": 1, "200": 3}}
        sample["wires"] = [
            {"to": "flip-flop", "readers": readers, "count": 10, "mean_ns": 1 + 0.05 * doubling, "longest_ns": 2.0}
            for doubling, readers in enumerate((1, 2, 4, 8))
        ]
        sample["wires"].append({"to": "block RAM", "readers": 1, "count": 5, "mean_ns": 2.15, "longest_ns": 3.0})
        period = delay_fitting.predicted_ns(sample, true_wires)
        sample["mhz"] = {"1": 1000 / period, "2": 900 / period, "3": 1100 / period}
        samples.append(sample)
    return samples


class reading_reports(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.addCleanup(self.temporary.cleanup)
        self.folder = pathlib.Path(self.temporary.name) / "run"
        self.run = run_folder(self.folder)

    def test_tells_the_cells_of_a_path_apart(self):
        self.assertEqual(
            {kind: dict(found) for kind, found in timing_samples.cells_of(routed_report()).items()},
            {
                "clock_to_out": {395: 1},
                "carry_entry": {355: 1},
                "carry_bit": {0: 1, 56: 1},
                "carry_exit": {328: 1},
                "lut": {180: 1, 306: 1},
                "slice": {118: 1},
                "setup": {0: 1},
                "block_clock_to_out": {718: 1},
                "enable_setup": {287: 1},
            },
        )

    def test_takes_wires_from_flip_flops_by_their_readers(self):
        rows = {
            (row["to"], row["readers"]): (row["count"], row["mean_ns"], row["longest_ns"])
            for row in timing_samples.summary_of_wires(timing_samples.wires_of(routed_report(), 0.395))
        }
        expected = {("flip-flop", 1): (1, 1.0, 1.0), ("flip-flop", 2): (3, 0.6, 0.7), ("block RAM", 2): (2, 2.0, 2.0)}
        self.assertEqual(rows, expected)

    def test_classes_of_readers_double(self):
        classes = [timing_samples.readers_class(readers) for readers in (1, 2, 3, 4, 7, 8, 48)]
        self.assertEqual(classes, [1, 2, 2, 4, 4, 8, 32])

    def test_makes_a_sample_of_a_run(self):
        sample = timing_samples.sample_of(self.folder)
        self.assertEqual(sample["mhz"], {"1": 1000 / 2.9, "2": 1000 / 3.0, "3": 1000 / 3.3})
        self.assertAlmostEqual(delay_fitting.routed_ns({**sample, "name": "design"}), 3.0)
        self.assertEqual(sample["cells_ps"]["lut"], {"180": 3, "306": 3})
        self.assertEqual(sample["critical_paths"]["1"], {"cells_ns": 1.314, "wires": 2, "longest_wire_ns": 0.844})
        self.assertEqual(sample["chains"], prediction((1.3, 2.0, 1.0))["chains"])

    def test_refuses_what_is_no_run_or_too_old(self):
        with self.assertRaisesRegex(flow_error, "no figures of a finished run"):
            timing_samples.sample_of(self.folder / "hls")
        self.run.write_report({"clock": {"estimated_period_ns": 2.5}})
        with self.assertRaisesRegex(flow_error, "no prediction of the clock.*older epiline-hls"):
            timing_samples.sample_of(self.folder)
        (self.folder / "hls" / "report.json").write_text("{")
        with self.assertRaisesRegex(flow_error, "report.json: the compiler's report cannot be read"):
            timing_samples.sample_of(self.folder)

    def test_refuses_a_design_without_a_clocked_path(self):
        report = dict(routed_report(), critical_paths=[])
        with self.assertRaisesRegex(flow_error, "no path leads from a register"):
            timing_samples.on_critical_paths(report)


class fitting(unittest.TestCase):
    def test_finds_the_delays_that_periods_were_made_of(self):
        samples = made_up_samples()
        found = delay_fitting.fit(samples, old_file)
        self.assertAlmostEqual(found["wires_ns"]["block_wire"], 1.0, 2)
        for sample in samples:
            predicted = delay_fitting.predicted_ns(sample, found["wires_ns"])
            self.assertAlmostEqual(predicted / delay_fitting.routed_ns(sample), 1, 2)

    def test_keeps_what_no_design_shows(self):
        found = delay_fitting.fit(made_up_samples(), old_file)["cells_ns"]
        self.assertEqual(found["lut"], 0.175)
        self.assertEqual(found["multiplier"], 0.2)

    def test_gives_a_flip_flop_the_wire_inside_its_slice(self):
        samples = made_up_samples()
        samples[0]["cells_ps"].update({"setup": {"0": 2}, "slice": {"118": 2}})
        self.assertEqual(delay_fitting.fit(samples, old_file)["cells_ns"]["setup"], 0.118)

    # Held out means that a design's own period has no part in its prediction.
    def test_holds_the_design_out(self):
        samples = made_up_samples()
        before = delay_fitting.held_out(samples, old_file)
        samples[2]["mhz"] = {"1": samples[2]["mhz"]["1"] / 2}
        after = delay_fitting.held_out(samples, old_file)
        self.assertEqual(before["design_2"], after["design_2"])
        self.assertNotEqual(before["design_0"], after["design_0"])

    def test_refuses_too_few_designs(self):
        with self.assertRaisesRegex(flow_error, "2 designs are too few"):
            delay_fitting.fit(made_up_samples()[:2], old_file)


class the_command(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.addCleanup(self.temporary.cleanup)
        self.folder = pathlib.Path(self.temporary.name)
        self.samples = self.folder / "timing"
        self.samples.mkdir()
        self.delays, self.page = self.folder / "delays.json", self.folder / "timing.md"
        self.delays.write_text(json.dumps(old_file))

    def call(self, *arguments):
        """(exit code, standard error)"""
        said = io.StringIO()
        words = ["--samples", self.samples, "--delays", self.delays, "-o", self.page, *arguments]
        with contextlib.redirect_stderr(said), contextlib.redirect_stdout(io.StringIO()):
            status = delay_fit.main([str(word) for word in words])
        return status, said.getvalue()

    def write_samples(self, samples):
        for sample in samples:
            whole = {**sample, "schema": "epiline-timing/1"}
            (self.samples / f"{sample['name']}.json").write_text(json.dumps(whole))

    def test_writes_both_files_and_then_agrees_with_them(self):
        samples = made_up_samples()
        samples[1]["before"] = {"lut4": 500, "flip_flops": 7, "mhz": {"1": samples[1]["mhz"]["1"] / 2}}
        samples[3]["before"] = {"text": "not routed", "lut4": 501}
        samples[4]["left_out"] = "limited by pins"
        self.write_samples(samples)
        self.assertEqual(self.call("--check")[0], 1)
        self.assertFalse(self.page.exists())
        self.assertEqual(self.call(), (0, ""))
        self.assertEqual(self.call("--check"), (0, ""))
        text = self.page.read_text(encoding="utf-8")
        self.assertIn("Left out of the fit: `design_4`: limited by pins.", text)
        self.assertRegex(text, r"\| `design_1` \| 500 \| 625 \| 7 \| 10 \| [\d.]+ \| [\d.]+ \| \+100 % \|")
        self.assertRegex(text, r"\| `design_3` \| 501 \| 6400 \| - \| 10 \| not routed \| [\d.]+ \|  \|")
        self.assertIn("| held out |", text)
        self.assertNotIn("design_4", json.loads(self.delays.read_text(encoding="utf-8"))["fitted_to"])
        self.page.write_text(text + "\n")
        status, said = self.call("--check")
        self.assertEqual(status, 1)
        self.assertRegex(said, "timing.md is not what .* gives: run scripts/delay_fit.py")

    def test_the_published_files_are_what_the_samples_give(self):
        with contextlib.redirect_stderr(io.StringIO()) as said:
            self.assertEqual(delay_fit.main(["--check"]), 0, said.getvalue())

    def test_collects_a_run_and_one_before_it(self):
        run_folder(self.folder / "now")
        run_folder(self.folder / "then", seeds=(4.0,))
        self.assertEqual(self.call("--collect", self.folder / "now", "--before", self.folder / "then"), (0, ""))
        sample = json.loads((self.samples / "design.json").read_text(encoding="utf-8"))
        self.assertEqual(sample["before"], {"lut4": 100, "flip_flops": 400, "block_rams": 1, "mhz": {"1": 250.0}})
        words = ("--collect", self.folder / "now", "--before-text", "not routed", "--before-size", "lut4=7")
        self.assertEqual(self.call(*words, "--left-out", "why"), (0, ""))
        sample = json.loads((self.samples / "design.json").read_text(encoding="utf-8"))
        self.assertEqual((sample["before"], sample["left_out"]), ({"text": "not routed", "lut4": 7}, "why"))
        status, said = self.call(*words[:-1], "lut4=many")
        self.assertEqual((status, "--before-size lut4=many" in said), (1, True))

    def test_takes_the_report_of_a_newer_compiler(self):
        run = run_folder(self.folder / "now")
        run.write_report({"clock": {"estimated_period_ns": 2.5}})
        newer = self.folder / "newer.json"
        newer.write_text(json.dumps({"clock": {"estimated_period_ns": 2.6}, "prediction": prediction((1.0, 1.0, 1.0))}))
        self.assertEqual(self.call("--collect", self.folder / "now")[0], 1)
        self.assertFalse(list(self.samples.iterdir()))
        self.assertEqual(self.call("--collect", self.folder / "now", "--report", newer), (0, ""))

    def test_says_what_is_wrong(self):
        self.assertRegex(self.call()[1], "has no samples")
        self.write_samples(made_up_samples())
        spoiled = dict(copy.deepcopy(made_up_samples()[0]), schema="epiline-timing/1")
        del spoiled["chains"]
        (self.samples / "design_0.json").write_text(json.dumps(spoiled))
        self.assertRegex(self.call()[1], "a sample has no key 'chains'")
        (self.samples / "design_0.json").write_text("{}")
        self.assertRegex(self.call()[1], "design_0.json: not a sample")
        (self.samples / "design_0.json").write_text("{")
        self.assertRegex(self.call()[1], "design_0.json: the sample cannot be read")
        self.delays.unlink()
        self.assertRegex(self.call()[1], "delays.json: the file of delays cannot be read")
        self.assertFalse(self.page.exists())

    def test_finds_the_schedulers_constants(self):
        found = delay_fit.constants_of(root / "rtl_gen" / "schedule" / "delay_model.cpp")
        self.assertTrue({"launch", "lut_level", "carry_bit", "block_wire"} <= set(found))
        with self.assertRaisesRegex(flow_error, "constants of the ECP5"):
            delay_fit.constants_of(root / "rtl_gen" / "schedule" / "delay_model.hpp")


if __name__ == "__main__":
    unittest.main()
