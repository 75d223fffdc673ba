#!/usr/bin/env python3
"""The reports of all kernels: report.json obeys docs/report.schema.json, report.html is a page of its own, and --explain leads every name
in the slowest chain to its line.

  check_reports.py COMPILER [FOLDER]

FOLDER holds NAME/report.json and all else that COMPILER made of each kernel, as run_batch.py leaves it in its folder
rtl; what is not there is compiled. Besides, the schema must notice when a report changes: every field of a real report is
removed, renamed and given another type in turn.
"""

import copy
import html.parser
import json
import pathlib
import re
import subprocess
import sys
import tempfile

from kernel_options import options_of

HERE = pathlib.Path(__file__).resolve().parent
SCHEMA = HERE.parent.parent / "docs" / "report.schema.json"
COMPILED_AGAIN = "arbiter"  # a small one
VOID = {"meta", "br", "link", "img", "hr"}

try:
    import jsonschema
except ImportError:
    sys.exit("check_reports.py: error: jsonschema is missing: scripts/setup.sh installs python3-jsonschema")


class Page(html.parser.HTMLParser):
    """Collects what must not be in a page that stands alone, and tags that do not match."""

    def __init__(self):
        super().__init__(convert_charrefs=True)
        self.open, self.problems, self.targets, self.links, self.text = [], [], set(), set(), []

    def handle_starttag(self, tag, attrs):
        if tag in ("script", "link", "img", "iframe", "object", "embed"):
            self.problems.append(f"<{tag}> in the page")
        if tag not in VOID:
            self.open.append(tag)
        for name, value in attrs:
            if name.startswith("on") or name == "src":
                self.problems.append(f"attribute {name}")
            if name == "href":
                self.links.add(value)
            if name == "id":
                if value in self.targets:
                    self.problems.append(f"id {value} twice")
                self.targets.add(value)

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.problems.append(f"</{tag}> does not match")

    def handle_data(self, data):
        self.text.append(data)


def pipelines(report):
    return [process["report"] for process in report["processes"]] if "processes" in report else [report]


def check_page(text, report, source):
    page = Page()
    page.feed(text)
    page.close()
    problems = page.problems + [f"<{tag}> not closed" for tag in page.open]
    problems += [f"link {link} leads nowhere" for link in page.links if link[:1] != "#" or link[1:] not in page.targets]
    if re.search(r"https?:|url\(|@import", text):
        problems.append("names something outside")
    if "prefers-color-scheme:dark" not in text:
        problems.append("knows no dark mode")
    shown = "".join(page.text)
    for line in source.read_text(encoding="utf-8").splitlines():
        if line not in shown:
            problems.append(f"does not show the source line {line!r}")
            break
    for number, pipeline in enumerate(pipelines(report)):
        prefix = f"p{number}" if "processes" in report else ""
        for link in pipeline["critical_chain"]["links"]:
            if link["where"] and link["where"]["file"].endswith(source.name):
                if not re.search(rf'<tr id="{prefix}f\d+l{link["where"]["line"]}" class="chain">', text):
                    problems.append(f"line {link['where']['line']} of the slowest chain is not marked")
    return problems


def check_explained(compiler, out, report, top):
    """The register of the slowest recurrence, told by its name in the Verilog, comes from the line that the report names."""
    for part in pipelines(report):
        loop = part["limiting_recurrence"]
        if loop is None:
            continue
        said = subprocess.run([compiler, "--explain", f"dut.{loop['register']}[0]", str(out)], capture_output=True,
                              text=True, check=False)
        where = loop["where"] and f"{pathlib.Path(loop['where']['file']).name}:{loop['where']['line']}: "
        if said.returncode != 0 or f"{loop['register']}: register, " not in said.stdout:
            return [f"does not explain {loop['register']!r}: {said.stdout}{said.stderr}"]
        if where and where not in said.stdout:
            return [f"explains {loop['register']!r} without {where!r}: {said.stdout}"]
    wrong = subprocess.run([compiler, "--explain", f"no_such_{top}", str(out)], capture_output=True, text=True, check=False)
    if wrong.returncode != 1 or not re.fullmatch(rf"error: there is no signal 'no_such_{top}' in .*; the nearest are '.*'\n",
                                                 wrong.stderr):
        return [f"does not refuse an unknown name: {wrong.stderr}"]
    return []


def places(value, path=()):
    """The path of every field in objects."""
    if isinstance(value, dict):
        for key, inner in value.items():
            yield path + (key,)
            yield from places(inner, path + (key,))
    elif isinstance(value, list) and value:
        yield from places(value[0], path + (0,))


def parent_of(report, path):
    for step in path[:-1]:
        report = report[step]
    return report


def check_sharpness(validator, report):
    """Which changes of a good report the schema does not notice."""
    # The operations' names and the ports' are data; the register map has a schema of its own.
    free = re.compile(r"^(?:processes/\d+/report/)?(latency_clocks|stages/\d+/operations|lines/\d+/stages/\d+/operations)/|^(?:processes/\d+/report/)?interface/registers/")
    missed = []
    tried = 0
    for path in places(report):
        name = "/".join(map(str, path))
        if free.match(name):
            continue
        for kind in ("removed", "renamed", "of another type"):
            changed = copy.deepcopy(report)
            owner = parent_of(changed, path)
            value = owner.pop(path[-1])
            if kind == "renamed":
                owner[path[-1] + "_"] = value
            elif kind == "of another type":
                owner[path[-1]] = {"of": "another type"} if not isinstance(value, dict) else 7
            tried += 1
            if validator.is_valid(changed) and name != "interface/registers":
                missed.append(f"{name} {kind}")
    return missed, tried


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__.split("\n\n")[1])
    compiler = sys.argv[1]
    made = pathlib.Path(sys.argv[2]) if len(sys.argv) == 3 else None
    schema = json.loads(SCHEMA.read_text(encoding="utf-8"))
    jsonschema.Draft202012Validator.check_schema(schema)
    validator = jsonschema.Draft202012Validator(schema)
    kernels = sorted((HERE / "kernels").glob("*.cpp"))
    failed = 0
    richest = {}
    with tempfile.TemporaryDirectory() as folder:
        for kernel in kernels:
            def texts_of(name):
                return [(name / f"report.{end}").read_text(encoding="utf-8") for end in ("json", "html", "txt")]

            def compile_into(name, kernel=kernel):
                subprocess.run([compiler, str(kernel), "--top", kernel.stem, "-o", str(name), "-q", *options_of(kernel)],
                               check=True, stderr=subprocess.DEVNULL)
                return texts_of(name)

            if made is not None and (made / kernel.stem / "report.json").is_file():
                out = made / kernel.stem
                texts = texts_of(out)
            else:
                out = pathlib.Path(folder) / kernel.stem
                texts = compile_into(out)
            report = json.loads(texts[0])
            problems = [f"{'/'.join(map(str, e.absolute_path))}: {e.message[:200]}"
                        for e in validator.iter_errors(report)]
            problems += check_page(texts[1], report, kernel)
            problems += check_explained(compiler, out, report, kernel.stem)
            if kernel.stem == COMPILED_AGAIN and compile_into(pathlib.Path(folder) / "again") != texts:
                problems.append("the reports differ from run to run")
            if problems:
                failed += 1
                print(f"FAILED {kernel.stem}: " + "; ".join(problems[:5]))
            if "processes" in report:
                richest["of processes"] = report
            elif report["memories"] and report["limiting_recurrence"]:
                richest["of one pipeline"] = report
    tried = 0
    for kind, report in sorted(richest.items()):
        missed, now = check_sharpness(validator, report)
        tried += now
        if missed or now < 200:
            failed += 1
            print(f"FAILED the schema {kind} does not notice ({now} changes tried): " + "; ".join(missed[:10]))
    if len(richest) != 2:
        failed += 1
        print(f"FAILED no report to try the schema with but {sorted(richest)}")
    print(f"{len(kernels)} kernels, {tried} changes that the schema notices" if not failed else f"{failed} failed")
    sys.exit(1 if failed or not kernels else 0)


if __name__ == "__main__":
    main()
