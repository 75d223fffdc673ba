"""scripts/gallery_table.py: the page holds every kernel with its figures, and the check notices what is old or missing."""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

script = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "gallery_table.py"


def report(depth, **changed):
    return {"clock": {"period_ns": 6.0}, "estimate": {"lut4": 1234.4, "block_rams": 2}, "registers": {"total_bits": 56},
            "initiation_interval": 1, "depth": depth, **changed}


class gallery(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)
        (self.folder / "kernels").mkdir()
        self.words = {"video": {"scale": {"shows": "a product", "look_at": "the multiplier."}},
                      "audio": {"filter": {"shows": "two processes", "look_at": "both."}}}
        self.source("scale", "// Doubles every\n// pixel. one iteration a token of in\n// epiline-hls: --clock 5ns\nint x;\n")
        self.source("filter", "// Smooths.\n")
        self.reports = {"scale": report(7),
                        "filter": report(0, processes=[{"report": report(3, initiation_interval=4)}, {"report": report(5)}])}

    def source(self, name, text):
        (self.folder / "kernels" / f"{name}.cpp").write_text(text)

    def run_table(self, *arguments):
        (self.folder / "words.json").write_text(json.dumps(self.words))
        for name, made in self.reports.items():
            folder = self.folder / "reports" / name
            folder.mkdir(parents=True, exist_ok=True)
            (folder / "report.json").write_text(json.dumps(made))
        return subprocess.run([sys.executable, "-B", script, "--kernels", self.folder / "kernels", "--words",
                               self.folder / "words.json", "--reports", self.folder / "reports", "-o",
                               self.folder / "page.md", *arguments], capture_output=True, text=True, check=False)

    def assert_refused(self, said, *arguments):
        ended = self.run_table(*arguments)
        self.assertEqual(ended.returncode, 1, ended.stdout)
        self.assertRegex(ended.stderr, f"^gallery_table.py: error: .*{said}")

    def test_shows_every_kernel_with_its_figures(self):
        ended = self.run_table()
        self.assertEqual(ended.returncode, 0, ended.stderr)
        page = (self.folder / "page.md").read_text()
        self.assertIn("2 kernels", page)
        self.assertIn("| [scale](#scale) | video | a product | 1 | 7 | 6.00 | 1,234 | 56 | 2 |", page)
        self.assertIn("| [filter](#filter) | audio | two processes | 1 / 4 | 3 + 5 | 6.00 |", page)
        self.assertRegex(page, r"with `--clock 5ns`: Doubles every pixel\.\n\nLook at the multiplier\.")
        self.assertEqual(self.run_table("--check").returncode, 0)

    def test_the_check_notices_an_old_page(self):
        self.assert_refused("is not what the kernels' reports give", "--check")  # there is none
        self.assertEqual(self.run_table().returncode, 0)
        self.reports["scale"]["depth"] = 8
        before = (self.folder / "page.md").read_text()
        self.assert_refused("is not what the kernels' reports give", "--check")
        self.assertEqual((self.folder / "page.md").read_text(), before)

    def test_notices_a_kernel_without_words_and_words_without_a_kernel(self):
        self.source("new", "// New.\n")
        self.assert_refused("no entry for new")
        (self.folder / "kernels" / "new.cpp").unlink()
        (self.folder / "kernels" / "scale.cpp").unlink()
        self.assert_refused("there is no kernel scale")
        self.assertFalse((self.folder / "page.md").exists())

    def test_notices_what_is_missing(self):
        self.words["audio"]["scale"] = self.words["video"]["scale"]
        self.assert_refused("scale stands there twice")
        del self.words["audio"]["scale"], self.words["video"]["scale"]["shows"]
        self.assert_refused("no key 'shows'")
        self.words["video"]["scale"]["shows"] = "a product"
        self.source("scale", "int x;\n")
        self.assert_refused("no comment at its head")
        self.source("scale", "// Doubles.\n")
        self.reports.pop("scale")
        (self.folder / "reports" / "scale" / "report.json").unlink()
        self.assert_refused("report.json is missing")


if __name__ == "__main__":
    unittest.main()
