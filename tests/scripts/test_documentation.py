"""The documentation says nothing that is not there: links, paths, and the worked example of the RTL interface."""

import os
import pathlib
import re
import subprocess
import tempfile
import unittest

root = pathlib.Path(__file__).resolve().parents[2]
pages = [*root.glob("*.md"), *(root / "docs").glob("**/*.md")]


def text_of(page):
    return page.read_text(encoding="utf-8")


class documentation(unittest.TestCase):
    def test_relative_links_lead_somewhere(self):
        checked = 0
        for page in pages:
            text = re.sub(r"`[^`\n]+`(?!\])", "", text_of(page))  # code; what a link is named by stays
            for target in re.findall(r"\]\(([^)#]+)(?:#[^)]*)?\)", text):
                if "://" in target:
                    continue
                checked += 1
                with self.subTest(page=page.name, link=target):
                    self.assertTrue((page.parent / target).exists())
        self.assertGreater(checked, 5)

    def test_paths_of_the_project_exist(self):
        # Anything that looks like a path below one of the project's folders. What is made later is not looked for.
        pattern = r"(?<![\w/.-])((?:scripts|hls|rtl_gen|tb|tests|docs|data|cmake)/[\w./-]*\w)"
        checked = 0
        for page in pages:
            for path in set(re.findall(pattern, text_of(page))):
                if path.startswith("data/downloads"):
                    continue
                checked += 1
                with self.subTest(page=page.name, path=path):
                    self.assertTrue((root / path).exists() or (page.parent / path).exists())
        self.assertGreater(checked, 20)

    def test_the_worked_example_is_the_file_and_has_the_ports_shown(self):
        compiler = os.environ.get("EPILINE_HLS")
        page = text_of(root / "docs" / "rtl_interface.md")
        example = root / "docs" / "examples" / "scale.cpp"
        shown = re.search(r"```cpp\n(.*?)```", page, re.DOTALL)[1]
        self.assertIn(shown, text_of(example))
        if not compiler:
            self.skipTest("EPILINE_HLS does not name the compiler")
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run(
                [compiler, str(example), "--top", "scale", "--target", "ecp5", "--clock", "6ns", "-o", folder], check=True
            )
            verilog = (pathlib.Path(folder) / "scale.v").read_text(encoding="utf-8")
        self.assertEqual(ports_of(verilog), ports_of(re.search(r"```verilog\n(.*?)```", page, re.DOTALL)[1]))


    def test_the_software_of_the_worked_example_compiles(self):
        compiler = os.environ.get("EPILINE_HLS")
        page = text_of(root / "docs" / "rtl_interface.md")
        software = root / "docs" / "examples" / "scale_software.c"
        self.assertIn(re.search(r"```c\n(.*?)```", page, re.DOTALL)[1], text_of(software))
        if not compiler:
            self.skipTest("EPILINE_HLS does not name the compiler")
        with tempfile.TemporaryDirectory() as folder:
            example = root / "docs" / "examples" / "scale.cpp"
            subprocess.run([compiler, str(example), "--top", "scale", "--axi-lite", "-q", "-o", folder], check=True)
            subprocess.run(["clang++-19", "-x", "c", "-std=c99", "-Wall", "-Wextra", "-Werror", "-fsyntax-only", "-I",
                            folder, str(software)], check=True)


def ports_of(verilog):
    """{(direction, width, name)} of the module `scale`."""
    header = re.search(r"module scale\s*\((.*?)\);", verilog, re.DOTALL)[1]
    header = re.sub(r"//[^\n]*", "", header)
    ports = re.findall(r"(input|output)\s+(?:wire|reg)?\s*(?:\[(\d+):0\])?\s*(\w+)", header)
    return {(direction, int(high or 0) + 1, name) for direction, high, name in ports}


if __name__ == "__main__":
    unittest.main()
