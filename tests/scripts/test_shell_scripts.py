"""The shell scripts: what they refuse, and the parts that decide something. Nothing is installed or built here."""

import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

root = pathlib.Path(__file__).resolve().parents[2]
scripts = root / "scripts"


def run(*command, cwd=None, environment=None):
    return subprocess.run(
        [str(part) for part in command],
        cwd=cwd,
        env=dict(os.environ, **(environment or {})),
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        check=False,
    )


class every_script(unittest.TestCase):
    def test_syntax_and_mode(self):
        for script in [*scripts.glob("*.sh"), root / ".ci" / "run"]:
            with self.subTest(script.name):
                self.assertEqual(run("bash", "-n", script).stderr, "")
                self.assertEqual(os.access(script, os.X_OK), script.name != "common.sh")

    def test_unknown_arguments_are_refused(self):
        for name in ("setup.sh", "test.sh", "demo.sh", "format.sh", "fpga_nightly.sh", "fuzz.sh", "coverage.sh"):
            with self.subTest(name):
                result = run(scripts / name, "--nonsense")
                self.assertEqual(result.returncode, 1)
                self.assertIn(f"{name}: error: unknown argument '--nonsense'", result.stderr)

    def test_help_says_how_to_call(self):
        for name in ("setup.sh", "test.sh", "demo.sh", "fpga_nightly.sh", "fuzz.sh", "coverage.sh"):
            with self.subTest(name):
                result = run(scripts / name, "--help")
                self.assertEqual(result.returncode, 0)
                self.assertIn(f"scripts/{name}", result.stdout)
                self.assertNotIn("shellcheck", result.stdout)


class in_a_copy(unittest.TestCase):
    """Runs a script in a folder of its own, with stand-ins for the programs it calls."""

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.root = pathlib.Path(os.path.realpath(temporary.name)) / "project"
        shutil.copytree(scripts, self.root / "scripts", ignore=shutil.ignore_patterns("__pycache__"))
        self.tools = self.root.parent / "tools"
        self.tools.mkdir()
        self.environment = {"PATH": f"{self.tools}:{os.environ['PATH']}", "EPILINE_DATA": ""}

    def stand_in(self, name, text):
        program = self.tools / name
        program.write_text(f"#!/bin/sh\n{text}\n")
        program.chmod(0o755)

    def call(self, text):
        """Runs shell text as a script of the project that has sourced common.sh."""
        script = self.root / "scripts" / "caller.sh"
        script.write_text(f'source "$(dirname "$0")/common.sh"\n{text}\n')
        return run("bash", script, environment=self.environment)


class setup(in_a_copy):
    all_installed = 'for word; do case $word in --*) ;; *) echo "ii  $word" ;; esac; done'

    def test_nothing_is_done_when_all_is_installed(self):
        self.stand_in("dpkg-query", self.all_installed)
        self.stand_in("apt-get", "echo apt-get was called; exit 1")
        result = run(self.root / "scripts/setup.sh", environment=self.environment)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("packages are installed", result.stdout)
        self.assertNotIn("apt-get was called", result.stdout)

    def test_what_is_missing_is_named_and_installed(self):
        # yosys counts as installed once apt-get install has been called; "rc" (removed, settings left) does not count.
        installed = self.root / "installed"
        self.stand_in(
            "dpkg-query",
            f'{self.all_installed} | if test -e {installed}; then cat; else sed "s/^ii  yosys$/rc  yosys/"; fi',
        )
        self.stand_in(
            "apt-get", f'echo "apt-get $*" >> {self.root}/log; case "$*" in *install*yosys) touch {installed} ;; esac'
        )
        self.stand_in("id", "echo 0")
        check = run(self.root / "scripts/setup.sh", "--check", environment=self.environment)
        self.assertEqual(check.returncode, 1)
        self.assertIn("are missing: yosys", check.stdout)
        self.assertFalse((self.root / "log").exists())
        result = run(self.root / "scripts/setup.sh", environment=self.environment)
        self.assertEqual(result.returncode, 0, result.stderr)
        calls = (self.root / "log").read_text().splitlines()
        self.assertEqual(len(calls), 2)
        self.assertTrue(calls[0].endswith(" update"))
        self.assertTrue(calls[1].endswith(" install --no-install-recommends yosys"))

    def test_a_failing_installation_is_told(self):
        self.stand_in("dpkg-query", "exit 1")
        self.stand_in("id", "echo 0")
        self.stand_in("apt-get", 'case "$*" in *install*) exit 100 ;; esac')
        result = run(self.root / "scripts/setup.sh", environment=self.environment)
        self.assertEqual(result.returncode, 1)
        self.assertIn("setup.sh: error: apt-get could not install the packages", result.stderr)
        self.stand_in("apt-get", "exit 100")
        result = run(self.root / "scripts/setup.sh", environment=self.environment)
        self.assertIn("setup.sh: error: 'apt-get update' failed", result.stderr)


class coverage(in_a_copy):
    def setUp(self):
        super().setUp()
        (self.root / "tests/emit").mkdir(parents=True)
        (self.root / "tests/emit/CMakeLists.txt").touch()
        (self.root / "build-coverage/bin").mkdir(parents=True)
        for program in ("epiline-hls", "emit_test", "epiline"):
            (self.root / "build-coverage/bin" / program).touch()
        self.stand_in("cmake", f'echo "cmake $*" >> {self.root}/log')
        self.stand_in("ctest", 'file=$(echo "$LLVM_PROFILE_FILE" | sed s/%4m/1/); touch "$file"')
        self.stand_in("llvm-profdata-19", ":")
        summary = '{"data": [{"totals": {"lines": {"count": 200, "percent": 95.5}}}]}'
        self.stand_in("llvm-cov-19", f"echo \"llvm-cov $*\" >> {self.root}/log; echo '{summary}'")

    def coverage(self, *arguments):
        return run(self.root / "scripts/coverage.sh", *arguments, environment=self.environment)

    def test_one_line_tells_the_share_of_lines(self):
        result = self.coverage("emit")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("coverage of rtl_gen: 95.5 % of 200 lines (build-coverage/coverage/index.html)", result.stdout)
        log = (self.root / "log").read_text()
        self.assertIn("--target epiline-hls tests/emit/all", log)
        # Programs without a part of the compiler have no counters: llvm-cov refuses them.
        bin_folder = "build-coverage/bin"
        self.assertIn(f"llvm-cov show {bin_folder}/emit_test -object {bin_folder}/epiline-hls -instr-profile", log)

    def test_too_few_lines_are_an_error(self):
        self.assertEqual(self.coverage("--least", "95", "emit").returncode, 0)
        result = self.coverage("--least", "96", "--report")
        self.assertEqual(result.returncode, 1)
        self.assertIn("coverage.sh: error: less than 96 % of the lines of rtl_gen run", result.stderr)

    def test_a_failing_test_leaves_no_figure(self):
        self.stand_in("ctest", "exit 8")
        result = self.coverage("emit")
        self.assertEqual(result.returncode, 1)
        self.assertIn("coverage.sh: error: tests of tests/emit fail", result.stderr)
        self.assertNotIn("coverage of rtl_gen", result.stdout)

    def test_a_report_needs_a_run(self):
        result = self.coverage("--report")
        self.assertEqual(result.returncode, 1)
        self.assertIn("no test has run yet", result.stderr)

    def test_an_unknown_folder_is_refused(self):
        result = self.coverage("emitt")
        self.assertEqual(result.returncode, 1)
        self.assertIn("tests/emitt is no folder of tests", result.stderr)


class configure(in_a_copy):
    def arguments_with(self, **changes):
        """The arguments of cmake when build/ holds a cache with these values."""
        self.stand_in("cmake", 'echo "$@"')
        values = {
            "CMAKE_GENERATOR:INTERNAL": "Ninja",
            "CMAKE_CXX_COMPILER:STRING": "/usr/bin/clang++-19",
            "CMAKE_HOME_DIRECTORY:INTERNAL": str(self.root),
        } | changes
        (self.root / "build").mkdir(exist_ok=True)
        (self.root / "build/CMakeCache.txt").write_text("".join(f"{key}={value}\n" for key, value in values.items()))
        result = self.call("configure release")
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stdout.strip()

    def test_a_folder_that_fits_is_kept(self):
        self.assertEqual(self.arguments_with(), "--preset release")

    def test_a_folder_that_does_not_fit_is_configured_afresh(self):
        for changes in (
            {"CMAKE_GENERATOR:INTERNAL": "Unix Makefiles"},
            {"CMAKE_CXX_COMPILER:STRING": "/usr/bin/c++"},
            {"CMAKE_HOME_DIRECTORY:INTERNAL": "/another/place"},
        ):
            with self.subTest(changes):
                self.assertEqual(self.arguments_with(**changes), "--fresh --preset release")

    def test_a_failure_ends_the_script(self):
        self.stand_in("cmake", "exit 1")
        result = self.call("configure release; echo went on")
        self.assertEqual(result.returncode, 1)
        self.assertIn("could not configure", result.stderr)
        self.assertNotIn("went on", result.stdout)


class real_pairs(in_a_copy):
    def chosen(self):
        result = self.call('use_real_pairs; echo "${EPILINE_DATA-none}"')
        return result.stdout.strip() or result.stderr

    def make_pairs(self, folder, scene="venus"):
        folder.mkdir(parents=True)
        (folder / "pairs.json").write_text(
            json.dumps([{"scene": scene, "levels": 20, "truth_scale": 8, "files": {
                "left.ppm": "", "right.ppm": "", "disp_left.pgm": "", "disp_right.pgm": "", "mask_nonocc.pgm": ""}}])
        )

    def test_the_first_folder_that_exists_is_taken(self):
        self.assertEqual(self.chosen(), "none")
        self.make_pairs(self.root / "data/downloads")
        self.assertEqual(self.chosen(), str(self.root / "data/downloads"))
        self.make_pairs(self.root.parent / "shared/data")
        self.assertEqual(self.chosen(), str(self.root.parent / "shared/data"))
        self.make_pairs(self.root.parent / "own")
        self.environment["EPILINE_DATA"] = str(self.root.parent / "own")
        self.assertEqual(self.chosen(), str(self.root.parent / "own"))

    def test_a_named_folder_that_is_missing_is_an_error(self):
        self.environment["EPILINE_DATA"] = "/nowhere/at/all"
        self.assertIn("EPILINE_DATA names '/nowhere/at/all'", self.chosen())

    def pair_arguments(self, *arguments):
        return run(sys.executable, "-B", self.root / "scripts/pair_arguments.py", *arguments)

    def test_pair_arguments(self):
        folder = self.root / "pairs"
        self.make_pairs(folder)
        self.assertEqual(self.pair_arguments(folder).stdout.split(), ["venus"])
        scene = folder / "venus"
        self.assertEqual(
            self.pair_arguments(folder, "venus").stdout.splitlines(),
            [str(scene / "left.ppm"), str(scene / "right.ppm"), "--levels", "20", "--truth", str(scene / "disp_left.pgm"),
             "--truth-scale", "8", "--mask-nonocc", str(scene / "mask_nonocc.pgm")],
        )
        result = self.pair_arguments(folder, "mars")
        self.assertEqual((result.returncode, result.stdout), (1, ""))
        self.assertIn("has no scene 'mars' (it has venus)", result.stderr)
        self.assertIn("cannot read", self.pair_arguments(self.root / "none").stderr)


class format_check(in_a_copy):
    def test_a_badly_laid_out_file_is_named(self):
        if shutil.which("clang-format-19") is None:
            self.skipTest("clang-format-19 is not installed")
        shutil.copy(root / ".clang-format", self.root)
        for folder in ("hls", "rtl_gen", "tb", "tests"):
            (self.root / folder).mkdir()
        (self.root / "hls/good.hpp").write_text("int good();\n")
        check = (self.root / "scripts/format.sh", "--check")
        self.assertEqual(run(*check).returncode, 0)
        (self.root / "tb/bad.cpp").write_text("int   bad( ) ;\n")
        result = run(*check)
        self.assertEqual(result.returncode, 1)
        self.assertIn("tb/bad.cpp", result.stderr)
        self.assertNotIn("hls/good.hpp", result.stderr)
        self.assertEqual(run(self.root / "scripts/format.sh").returncode, 0)
        self.assertEqual((self.root / "tb/bad.cpp").read_text(), "int bad();\n")
        self.assertEqual(run(*check).returncode, 0)


if __name__ == "__main__":
    unittest.main()
