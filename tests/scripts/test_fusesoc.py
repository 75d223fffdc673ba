"""epiline.core: FuseSoC generates the Verilog, lints it and simulates a frame. The environment names the build folder
(EPILINE_BUILD) and the folder of the pinned tools (EPILINE_FPGA_TOOLS), which FuseSoC is one of.
"""

import os
import pathlib
import subprocess
import tempfile
import unittest

root = pathlib.Path(__file__).resolve().parents[2]
programs = pathlib.Path(os.environ["EPILINE_FPGA_TOOLS"]) / "bin"


class fusesoc(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.folder = pathlib.Path(place.name)
        # The core file and what it names, without the rest of the project to search through.
        for name in ("epiline.core", "hls", "scripts", "tests"):
            (self.folder / "project").mkdir(exist_ok=True)
            (self.folder / "project" / name).symlink_to(root / name)

    def run_target(self, target, **environment):
        path = f"{programs}:{os.environ['PATH']}"
        return subprocess.run(
            [
                programs / "fusesoc",
                "--cores-root",
                self.folder / "project",
                "run",
                "--target",
                target,
                "epiline:stereo:epiline",
            ],
            cwd=self.folder,
            text=True,
            capture_output=True,
            check=False,
            env={**os.environ, "PATH": path, **environment},
        )

    def test_the_generated_verilog_is_clean(self):
        ended = self.run_target("lint")
        self.assertEqual(ended.returncode, 0, ended.stdout + ended.stderr)
        self.assertIn("verilator", ended.stdout)

    def test_a_simulated_frame_is_right(self):
        ended = self.run_target("sim")
        self.assertEqual(ended.returncode, 0, ended.stdout + ended.stderr)
        self.assertIn("PASSED: 2400 pixels", ended.stdout)

    def test_says_when_the_compiler_is_not_built(self):
        ended = self.run_target("lint", EPILINE_BUILD=str(self.folder))
        self.assertNotEqual(ended.returncode, 0)
        self.assertIn("bin/epiline-hls is not built", ended.stdout + ended.stderr)


if __name__ == "__main__":
    unittest.main()
