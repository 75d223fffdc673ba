"""FuseSoC's generator for epiline.core: compiles a C++ top to Verilog with epiline-hls.

Parameters: `source` (relative to the core file), `top`, and, where the compiler's defaults do not do, `clock` and
`target`. The build folder is the core's build/, or the one named by EPILINE_BUILD.
"""

import os
import pathlib
import subprocess
import sys

from fusesoc.capi2.generator import Generator


class epiline_hls(Generator):
    def run(self):
        root = pathlib.Path(self.files_root)
        compiler = pathlib.Path(os.environ.get("EPILINE_BUILD") or root / "build") / "bin" / "epiline-hls"
        if not compiler.exists():
            sys.exit(
                f"fusesoc_generator.py: error: {compiler} is not built (cmake --preset release, then "
                "cmake --build build --target epiline-hls; EPILINE_BUILD names another build folder)"
            )
        top = self.config["top"]
        options = [
            word for name in ("clock", "target") if name in self.config for word in (f"--{name}", self.config[name])
        ]
        ended = subprocess.run(
            [
                compiler,
                root / self.config["source"],
                "--top",
                top,
                "--quiet",
                "-I",
                root / "hls",
                *options,
                "-o",
                "hls",
            ],
            check=False,
        )
        if ended.returncode != 0:
            sys.exit(f"fusesoc_generator.py: error: epiline-hls could not compile {top} (its message is above)")
        self.add_files([f"hls/{top}.v"], file_type="verilogSource")


if __name__ == "__main__":
    generator = epiline_hls()
    generator.run()
    generator.write()
