"""scripts/fpga.sh: what it runs, keeps, counts and refuses, with stand-ins for the slow tools (fpga_bench.py)."""

import json
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from unittest import mock

from fpga_bench import fpga_bench, root

sys.path.insert(0, str(root / "scripts" / "fpga"))
import critical_path  # noqa: E402
import devices  # noqa: E402
import figures  # noqa: E402
import steps  # noqa: E402
import tools  # noqa: E402
from flow_error import flow_error  # noqa: E402


class a_run(fpga_bench):
    def setUp(self):
        super().setUp()
        self.synthesized()

    def test_writes_bitstream_and_figures_of_the_median_and_the_best_seed(self):
        ended = self.run_flow("--clock", "8", "--seed-list", "3,1,9", "-o", "out")
        self.assertEqual(ended.returncode, 0, ended.stderr)
        run = self.result()
        self.assertEqual(run["status"], "ok")
        self.assertEqual([seed["fmax_mhz"] for seed in run["seeds"]], [130, 110, 190])
        self.assertEqual(run["fmax_mhz"], {"median": 130, "best": 190, "worst": 110, "best_seed": 9})
        self.assertEqual((self.folder / "out" / "counter.bit").read_bytes(), b"\xff\x00.device 9\n")
        self.assertEqual(run["bitstream"]["bytes"], 12)
        self.assertEqual(
            run["clock"], {"wanted_ns": 8, "wanted_mhz": 125, "scheduled_ns": 8, "estimated_ns": 7.75, "stages": 4}
        )
        cells = run["resources"]["cells"]
        self.assertGreater(cells["CCU2C"], 0)
        self.assertEqual(run["resources"]["lut4"], cells["LUT4"] + 2 * cells["CCU2C"] + 6 * cells["TRELLIS_DPR16X4"])
        self.assertEqual(run["resources"]["flip_flops"], 16)
        self.assertEqual(run["tools"]["pyosys"], self.versions["pyosys"])
        self.assertEqual(
            run["command"], "scripts/fpga.sh counter.cpp:counter --target ecp5-25k --clock 8 --seed-list 3,1,9"
        )
        self.assertIn("130.0 MHz median", ended.stdout)

    def test_traces_the_critical_path_to_lines_of_the_source(self):
        ended = self.run_flow("--seeds", "1", "--clock", "20", "-o", "out")
        self.assertEqual(ended.returncode, 0, ended.stderr)
        path = self.result()["seeds"][0]["critical_path"]
        self.assertEqual((path["period_ns"], path["logic_ns"], path["routing_ns"]), (4.0, 1.25, 2.75))
        self.assertEqual(
            [(hop["name"], hop["source"]) for hop in path["hops"]],
            [("step_s1", "counter.cpp:3"), ("sum", "counter.cpp:5"), ("total", "counter.cpp:3")],
        )
        self.assertEqual([hop["logic_ns"] + hop["routing_ns"] for hop in path["hops"]], [0.5, 2.0, 1.5])
        self.assertIn("counter.cpp:5", ended.stdout)

    def test_traces_copies_of_registers_to_the_line_of_what_they_copy(self):
        verilog = self.folder / "top.v"
        verilog.write_text(
            "  wire [8:0] sum = a + b;  // counter.cpp:5\n  reg [8:0] sum_s4;\n  wire [8:0] sum_s4_copy12;\n"
            "  epiline_copy #(.WIDTH(9)) sum_s4_copy12_register (.clk(clk), .d(sum), .q(sum_s4_copy12));\n"
            "  reg more_enable_4;  // counter.cpp:6\n  wire more_enable_4_copy1;\n",
            encoding="utf-8",
        )
        lines = critical_path.source_lines([verilog])
        for cell in ("sum_s4_TRELLIS_FF_Q_1", "sum_s4_copy12_register.bits_TRELLIS_FF_Q_1", "sum_s4_copy12[3]"):
            self.assertEqual(lines.of_cell(cell)[1], "counter.cpp:5", cell)
        self.assertEqual(lines.of_cell("more_enable_4_copy1_register.bits_TRELLIS_FF_Q")[1], "counter.cpp:6")

    def test_a_clock_that_is_not_reached_is_a_failure_with_the_path(self):
        ended = self.run_flow("--clock", "6", "--seeds", "2", "-o", "out")
        self.expect_error(ended, "no seed reached 166.7 MHz", "seed 2", "120.0 MHz")
        self.assertIn("counter.cpp:5", ended.stdout)
        run = self.result()
        self.assertEqual(run["status"], "failed")
        self.assertIn("166.7", run["failure"])

    def test_results_of_an_earlier_run_do_not_outlive_a_failure(self):
        arguments = ("--clock", "9.5", "--seeds", "1", "-o", "out")
        self.assertEqual(self.run_flow(*arguments).returncode, 0)
        (self.folder / "compiler_fails").write_text("")
        self.expect_error(self.run_flow(*arguments), "epiline-hls failed")
        self.assertFalse((self.folder / "out" / "counter.bit").exists())
        self.assertFalse((self.folder / "out" / "counter.json").exists())

    def test_schedules_for_another_period_than_it_places_for(self):
        self.assertEqual(
            self.run_flow("--clock", "9.5", "--hls-clock", "7.5ns", "--seeds", "1", "-o", "out").returncode, 0
        )
        self.assertEqual(self.calls()[0], "hls 7.5ns ecp5")
        self.assertEqual(self.result()["clock"]["scheduled_ns"], 7.5)
        self.assertEqual(self.result()["seeds"][0]["clocks"]["$glbnet$clk$TRELLIS_IO_IN"]["wanted_mhz"], 105.26)

    def test_says_why_there_are_no_frames_a_second(self):
        self.assertEqual(self.run_flow("--clock", "9.5", "--seeds", "1", "-o", "out").returncode, 0)
        run = self.result()
        self.assertIsNone(run["frames_per_second"])
        self.assertIn("not built", run["frame"]["reason"])


class finished_steps(fpga_bench):
    arguments = ("--clock", "9.5", "--seeds", "2", "-o", "out")

    def setUp(self):
        super().setUp()
        self.synthesized()

    def test_are_kept(self):
        self.assertEqual(self.run_flow(*self.arguments).returncode, 0)
        first = self.result()
        self.calls()
        again = self.run_flow(*self.arguments)
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertEqual(self.calls(), ["hls 9.5ns ecp5"])
        self.assertIn("synthesis: kept", again.stdout)
        self.assertEqual(self.result(), first)

    def test_only_what_is_new_is_run(self):
        self.run_flow(*self.arguments)
        self.calls()
        self.run_flow("--clock", "9.5", "--seeds", "3", "-o", "out")
        self.assertEqual(self.calls(), ["hls 9.5ns ecp5", "nextpnr 3"])

    def test_are_made_again_when_the_source_changes(self):
        self.run_flow(*self.arguments)
        self.calls()
        (self.folder / "width").write_text("9")
        ended = self.run_flow(*self.arguments)
        self.assertNotIn("kept", ended.stdout)
        self.assertEqual(len(self.calls()), 3)
        self.assertEqual(self.result()["resources"]["flip_flops"], 18)

    def test_are_made_again_for_another_clock_or_speed_grade(self):
        self.run_flow(*self.arguments)
        for clock, speed in (("9.4", "8"), ("9.4", "6")):
            self.calls()
            self.run_flow("--clock", clock, "--speed", speed, "--seeds", "2", "-o", "out")
            with self.subTest(clock=clock, speed=speed):
                self.assertEqual(len(self.calls()), 3)

    def test_are_made_again_when_a_file_was_cut_short(self):
        self.run_flow(*self.arguments)
        self.calls()
        config = self.folder / "out" / "seed_2" / "counter.config"
        config.write_text(".dev")
        self.run_flow(*self.arguments)
        self.assertEqual(self.calls(), ["hls 9.5ns ecp5", "nextpnr 2"])
        self.assertEqual(config.read_text(), ".device 2\n")

    def kill_while_placing(self, how):
        (self.folder / "nextpnr_sleeps").write_text("")
        process = subprocess.Popen(
            self.command(*self.arguments),
            cwd=self.folder,
            env=self.environment(),
            text=True,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
        )
        deadline = time.monotonic() + 60
        while (
            not (self.folder / "nextpnr_is_there").exists() and process.poll() is None and time.monotonic() < deadline
        ):
            time.sleep(0.05)
        process.send_signal(how)
        output, errors = process.communicate(timeout=60)
        self.assertTrue((self.folder / "nextpnr_is_there").exists(), output + errors)
        (self.folder / "nextpnr_sleeps").unlink()
        self.assertFalse((self.folder / "out" / "seed_1").exists())
        self.assertFalse((self.folder / "out" / "counter.json").exists())
        self.calls()
        return process.returncode, errors

    def go_on(self):
        ended = self.run_flow(*self.arguments)
        self.assertEqual(ended.returncode, 0, ended.stderr)
        self.assertIn("synthesis: kept", ended.stdout)
        self.assertEqual(sorted(self.calls()), ["hls 9.5ns ecp5", "nextpnr 1", "nextpnr 2"])
        self.assertEqual([path.name for path in (self.folder / "out").glob(".partial*")], [])

    def test_outlive_an_interrupt(self):
        for how in (signal.SIGINT, signal.SIGTERM):
            with self.subTest(how=how):
                status, errors = self.kill_while_placing(how)
                self.assertEqual(status, 130)
                self.assertIn("the same command goes on from there", errors)
                self.go_on()
                for name in ("seed_1", "seed_2", "counter.json"):
                    subprocess.run(["rm", "-r", self.folder / "out" / name], check=True)
                (self.folder / "nextpnr_is_there").unlink()

    def test_outlive_a_kill(self):
        status, _ = self.kill_while_placing(signal.SIGKILL)
        self.assertEqual(status, -signal.SIGKILL)
        self.go_on()


class bad_input(fpga_bench):
    def test_unknown_names(self):
        self.expect_error(self.run_plain("pong"), "unknown top 'pong'", "color_fuzzy")
        self.expect_error(self.run_plain("none.cpp:counter"), "none.cpp' is not a file")
        self.expect_error(self.run_plain("counter.cpp:a b"), "'a b' is not the name of a function")
        self.expect_error(
            self.run_plain("color_fuzzy", "--target", "abacus"), "unknown target 'abacus'", "ecp5-85k", "hx8k"
        )
        self.expect_error(self.run_plain("color_fuzzy", "--board", "breadboard"), "unknown board 'breadboard'")
        self.expect_error(self.run_flow("--speed", "9"), "unknown speed grade 9", "6, 7, 8")

    def test_numbers_that_make_no_sense(self):
        self.expect_error(self.run_flow("--seeds", "0"), "--seeds")
        self.expect_error(self.run_flow("--seed-list", "1,1"), "--seed-list", "'1,1'")
        self.expect_error(self.run_flow("--seed-list", "one"), "--seed-list")
        self.expect_error(self.run_flow("--seeds", "2", "--seed-list", "1"), "cannot both")
        self.expect_error(self.run_flow("--clock", "fast"), "--clock", "'fast'")
        self.expect_error(self.run_flow("--clock", "0.1"), "--clock", "1 to 1000")
        self.expect_error(self.run_flow("--at-once", "8"), "--at-once")
        self.expect_error(self.run_flow("--levels", "0"), "--levels")
        self.assertEqual(self.run_flow("--seeds", "many").returncode, 2)
        self.assertEqual(self.run_flow("--faster").returncode, 2)
        self.assertFalse((self.folder / "out").exists())

    def test_design_too_large_says_by_how_much_and_what_helps(self):
        (self.folder / "width").write_text("100")
        ended = self.run_flow("--seeds", "1", "-o", "out")
        self.expect_error(ended, "too large for LFE5U-25F", "202 of 197 pins, 5 too many", "`pixels_per_beat`")
        self.assertNotIn("nextpnr 1", self.calls())

    def test_a_device_too_full_to_place(self):
        (self.folder / "nextpnr_says").write_text(
            "ERROR: Unable to find legal placement for all cells, design is probably at " "utilisation limit."
        )
        self.synthesized()
        ended = self.run_flow("--seeds", "1", "-o", "out")
        self.expect_error(ended, "seed 1 failed", "too full", "`levels`")
        self.assertFalse((self.folder / "out" / "seed_1").exists())
        self.assertTrue((self.folder / "out" / "failed_seed_1" / "nextpnr.log").exists())

    def test_a_failing_compiler_synthesis_or_packer_is_quoted(self):
        (self.folder / "compiler_fails").write_text("")
        self.expect_error(self.run_flow("-o", "out"), "counter.cpp:5", "`goto` cannot become hardware")
        (self.folder / "compiler_fails").unlink()
        (self.folder / "width").write_text("0")
        self.expect_error(self.run_flow("-o", "out"), "synthesis failed")
        (self.folder / "width").write_text("8")
        self.synthesized("fitting")
        (self.folder / "packer_says").write_text("Error: no such bit")
        self.expect_error(self.run_flow("--clock", "9.5", "--seeds", "1", "-o", "fitting"), "no such bit")
        self.assertFalse((self.folder / "fitting" / "counter.bit").exists())
        self.assertFalse((self.folder / "fitting" / "counter.json").exists())

    def test_a_full_disk(self):
        self.synthesized()
        (self.folder / "nextpnr_says").write_text("terminate called\nwrite: No space left on device")
        self.expect_error(self.run_flow("--seeds", "1", "-o", "out"), "the disk is full")

    def test_too_little_space_is_seen_before(self):
        usage = mock.Mock(free=3 * 2**20)
        with mock.patch("shutil.disk_usage", return_value=usage), self.assertRaises(flow_error) as caught:
            steps.check_space(self.folder, 200 * 2**20)
        self.assertIn("3 MB are free, the run needs up to 200 MB", str(caught.exception))

    def test_tools_of_another_version(self):
        self.install({**self.versions, "pyosys": "0.1"})
        self.expect_error(
            self.run_flow("-o", "out"), "pyosys 0.1 instead of " + self.versions["pyosys"], "Remove that folder"
        )
        self.assertEqual(self.calls(), [])

    def test_a_missing_tool(self):
        rest = {name: version for name, version in self.versions.items() if name != "wasmtime"}
        self.install(rest)
        self.expect_error(self.run_flow("-o", "out"), "wasmtime", "is missing")

    def test_a_folder_that_is_no_environment_is_left_alone(self):
        (self.folder / "tools" / "pyvenv.cfg").unlink()
        (self.folder / "tools" / "installed.json").unlink()
        self.expect_error(self.run_flow("-o", "out"), "is not a Python environment")
        self.assertTrue((self.folder / "tools" / "bin" / "ecppack").exists())

    def test_a_compiler_that_is_not_built(self):
        (self.folder / "build" / "bin" / "epiline-hls").unlink()
        self.expect_error(self.run_flow("-o", "out"), "epiline-hls is not built")

    def test_a_second_run_in_the_same_folder(self):
        keep = steps.step_store(self.folder / "out", steps.progress())
        self.addCleanup(keep.close)
        self.expect_error(self.run_flow("-o", "out"), "another run is at work")

    def test_an_output_folder_that_cannot_be(self):
        self.expect_error(self.run_flow("-o", "counter.cpp"), "counter.cpp")


class published_runs(fpga_bench):
    def test_are_command_lines_of_the_flow(self):
        lines = (root / "scripts" / "fpga" / "published.txt").read_text().splitlines()
        runs = [line.split() for line in lines if not line.startswith("#")]
        self.assertGreater(len(runs), 1)
        for run in runs:
            ended = self.run_plain(*run, "--check-arguments")
            self.assertEqual(ended.returncode, 0, ended.stderr)


class boards(unittest.TestCase):
    def test_every_board_can_be_read(self):
        for name in devices.boards():
            board = devices.read_board(name)
            self.assertIn(board.target, devices.targets)
            self.assertGreater(board.core_clock_mhz, 1)


class rates(unittest.TestCase):
    def test_follow_from_clocks_and_megahertz(self):
        frame = {"width": 640, "height": 480, "levels": 80, "cycles": 307200}
        self.assertEqual(
            figures.rates(frame, 153.6, 24576),
            {"frames_per_second": 500, "mde_per_second": 12288, "mde_per_second_per_lut4": 0.5},
        )


class too_large(unittest.TestCase):
    def test_names_each_thing_that_runs_out(self):
        said = devices.too_large(
            {"lut4": 90000, "block_rams": 300, "flip_flops": 5}, devices.targets["ecp5-85k"].capacity
        )
        self.assertEqual(len(said), 2)
        self.assertIn("90000 of 83640 LUT4, 6360 too many", said[0])
        self.assertIn("max_width", said[1])

    def test_is_silent_about_what_fits(self):
        self.assertEqual(devices.too_large({"lut4": 83640}, devices.targets["ecp5-85k"].capacity), [])


class published_table(fpga_bench):
    script = root / "scripts" / "results_table.py"

    def run_table(self, *arguments):
        return subprocess.run(
            [sys.executable, "-B", str(self.script), *arguments], capture_output=True, text=True, check=False
        )

    def test_the_committed_page_is_what_the_script_makes(self):
        ended = self.run_table("--check")
        self.assertEqual(ended.returncode, 0, ended.stderr)

    def folder_with(self, run):
        results = self.folder / "results"
        results.mkdir()
        (results / "published.json").write_text((root / "docs" / "results" / "published.json").read_text())
        (results / "counter.json").write_text(json.dumps(run))
        return "--results", str(results), "-o", str(self.folder / "results.md")

    def test_shows_a_run_beside_the_others(self):
        self.synthesized()
        self.assertEqual(self.run_flow("--clock", "9.5", "--seeds", "3", "-o", "out").returncode, 0)
        run = self.result()
        run["frame"]["cycles"] = 307200
        run.update(figures.rates(run["frame"], run["fmax_mhz"]["median"], run["resources"]["lut4"]))
        arguments = self.folder_with(run)
        self.assertNotEqual(self.run_table("--check", *arguments).returncode, 0)
        ended = self.run_table(*arguments)
        self.assertEqual(ended.returncode, 0, ended.stderr)
        lines = (self.folder / "results.md").read_text().splitlines()
        compared = next(line for line in lines if line.startswith("| **Epiline `counter`**"))
        self.assertIn(" | 391 | 9,600 | ", compared)  # 120 MHz / 307200, and that times 640 * 480 * 80
        order = [line.split(" | ")[0] for line in lines if line.startswith("| ")]
        self.assertLess(order.index("| Vitis StereoBM 11x11, 32 parallel"), order.index("| **Epiline `counter`**"))
        self.assertLess(order.index("| **Epiline `counter`**"), order.index("| FP-Stereo"))
        self.assertTrue(any("110.0 (1), 120.0 (2), 130.0 (3)" in line for line in lines))
        self.assertTrue(any("9.25 | 8.33 | +11.0 %" in line for line in lines))
        self.assertEqual(self.run_table("--check", *arguments).returncode, 0)

    def test_refuses_what_is_no_result(self):
        ended = self.run_table(*self.folder_with({"schema": "something"}))
        self.assertEqual(ended.returncode, 1)
        self.assertIn("counter.json is not a result of scripts/fpga.sh", ended.stderr)
        self.assertFalse((self.folder / "results.md").exists())


class the_tools_environment(unittest.TestCase):
    def test_hangs_on_no_checkout_so_that_several_can_share_it(self):
        with tempfile.TemporaryDirectory() as place:
            folder, moved = pathlib.Path(place, "tools"), pathlib.Path(place, "checkout", "scripts", "fpga")
            (folder / "bin").mkdir(parents=True)
            shutil.copytree(root / "scripts" / "fpga", moved)
            shutil.copy(root / "scripts" / "requirements-fpga.txt", moved.parent)
            tools.write_wrappers(folder)
            for name in tools.wrappers:
                text = (folder / "bin" / name).read_text(encoding="utf-8")
                self.assertNotIn(str(root), text)
                program = re.search(r'-B "([^"]+)"', text)[1]
                self.assertTrue(pathlib.Path(program).is_relative_to(folder), program)
                self.assertTrue(pathlib.Path(program).exists(), program)
            other = subprocess.run(
                [sys.executable, "-B", "-c", "import tools; print(tools.fingerprint())"],
                cwd=moved, capture_output=True, text=True, check=True,
            )
            self.assertEqual(other.stdout.strip(), tools.fingerprint())

    def test_is_made_anew_when_what_it_runs_changes(self):
        before = tools.fingerprint()
        with tempfile.TemporaryDirectory() as place:
            for file in tools.programs():
                shutil.copy(file, place)
            with mock.patch.object(tools, "here", pathlib.Path(place)):
                self.assertEqual(tools.fingerprint(), before)
                changed = pathlib.Path(place, tools.programs()[0].name)
                changed.write_bytes(changed.read_bytes() + b"\n")
                self.assertNotEqual(tools.fingerprint(), before)


if __name__ == "__main__":
    unittest.main()
