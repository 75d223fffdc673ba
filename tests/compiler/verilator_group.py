"""Many modules in one Verilator model, at the price of one run of Verilator and one run of the C++ compiler.

All modules of a group stand in one Verilog wrapper, each with a clock of its own, so that a module that is not being looked at
costs nothing. Two wide ports carry all signals of a module, every valid, ready and token from a 32-bit word of its own, so that
tables say where they are (group_model.hpp) and no module needs C++ of its own: compiling is what a group costs, not running.
The model is compiled as one file over a precompiled header of Verilator's and the binding's declarations, for the same reason.
"""

import json
import os
import pathlib
import re
import subprocess

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent

# Verilator keeps a port of this many words as an array of words.
SMALLEST_WORDS = 3


class Words:
    """Lays out one direction: 32-bit words, with a Verilog slice for each signal."""

    def __init__(self, port):
        self.port, self.words, self.taken = port, 0, []

    def take(self, signals, width):
        """A place for `width` bits; signals: (name, width, offset). Returns its first word and the connections."""
        first = self.words
        self.words += (width + 31) // 32
        connections = []
        for name, bits, offset in signals:
            low = 32 * first + offset
            self.taken.append((low, low + bits))
            connections.append(f".{name}({self.port}[{low + bits - 1}:{low}])")
        return first, connections

    def bits(self):
        return 32 * max(self.words, SMALLEST_WORDS)

    def free(self):
        """What no signal takes: (high, low)."""
        at, result = 0, []
        for low, end in sorted(self.taken) + [(self.bits(), self.bits())]:
            if low > at:
                result.append((low - 1, at))
            at = end
        return result


def quoted(text):
    return json.dumps(text)


def member(name, report, index):
    """(ports of the wrapper, its lines, C++ tables, the table's entry) of the module that report.json describes."""
    into, out = Words(f"in_{name}"), Words(f"out_{name}")
    connections = [f".clk(clk_{name})", f".rst(rst_{name})"]
    ports, fields = [], []
    for number, port in enumerate(report["interface"]["ports"]):
        is_input = {"input": True, "output": False}[port["direction"]]
        ahead, back = (into, out) if is_input else (out, into)
        valid, text = ahead.take([(port["valid"], 1, 0)], 1)
        connections += text
        token, text = ahead.take([(f["rtl"], f["width"], f["offset"]) for f in port["fields"]], port["width"])
        connections += text
        ready, text = back.take([(port["ready"], 1, 0)], 1)
        connections += text
        ports.append(f"{{{quoted(port['name'])}, port_kind::{port['kind']}, {'true' if is_input else 'false'}, "
                     f"{port['width']}, {valid}, {ready}, {token}}}")
        fields += [f"{{{number}, {quoted(f['signal'])}, {f['width']}, {f['offset']}}}" for f in port["fields"]]
    fifos = [f"{{{quoted(f['name'])}, {quoted(f['instance'])}, {f['depth']}}}" for f in report.get("streams", [])]
    tables, entry = [], [quoted(report["interface"]["module"]), str(index)]
    for kind, rows in (("port", ports), ("field", fields), ("fifo", fifos)):
        if rows:
            tables.append(f"const member_{kind} {kind}s_of_{index}[] = {{{', '.join(rows)}}};")
        entry += [f"{kind}s_of_{index}" if rows else "nullptr", str(len(rows))]
    wrapper = [f"input wire clk_{name}", f"input wire rst_{name}", f"input wire [{into.bits() - 1}:0] in_{name}",
               f"output wire [{out.bits() - 1}:0] out_{name}"]
    lines = [f"  {name} {name}_instance ({', '.join(connections)});"]
    lines += [f"  assign out_{name}[{high}:{low}] = {high - low + 1}'d0;" for high, low in out.free()]
    return wrapper, lines, tables, f"{{{', '.join(entry)}}}"


def write(folder, rtl, names):
    """Writes group.v and models.cpp for rtl/NAME/report.json."""
    folder.mkdir(parents=True)
    wrapper, lines, tables, entries, cases = [], [], [], [], []
    for index, name in enumerate(names):
        report = json.loads((rtl / name / "report.json").read_text(encoding="utf-8"))
        ports, body, table, entry = member(name, report, index)
        wrapper += ports
        lines += body
        tables += table
        entries.append(entry)
        verilated = name.replace("__", "___05F")  # as Verilator writes it
        cases.append(f"      case {index}: return {{&top_.clk_{verilated}, &top_.rst_{verilated}, "
                     f"top_.in_{verilated}.data(), top_.out_{verilated}.data()}};")
    (folder / "group.v").write_text(
        "module group (\n  " + ",\n  ".join(wrapper) + "\n);\n" + "\n".join(lines) + "\nendmodule\n", encoding="utf-8")
    (folder / "models.cpp").write_text("\n".join([
        "namespace epiline::compiler_test {", "namespace {", "using cosim::port_kind;", *tables,
        f"const member_table tables[] = {{{', '.join(entries)}}};",
        "class the_group final : public verilated_group {", " public:",
        "  explicit the_group(VerilatedContext* context) : top_(context) {}",
        "  void eval() override { top_.eval(); }", "  void final() override { top_.final(); }",
        "  member_signals signals(unsigned index) override {", "    switch (index) {", *cases,
        "      default: std::abort();", "    }", "  }", " private:", "  Vgroup top_;", "};",
        "std::unique_ptr<verilated_group> make(VerilatedContext* context) { return std::make_unique<the_group>(context); }",
        "}", "}",
        'extern "C" epiline::cosim::rtl_model* epiline_make_model(const char* name, std::uint64_t seed) {',
        "  using namespace epiline::compiler_test;",
        "  for (const member_table& table : tables)",
        "    if (std::strcmp(name, table.module) == 0) return new group_model(seed, make, table);",
        "  return nullptr;", "}", ""]), encoding="utf-8")


def problem_of(run, what):
    return f"{what}: " + ("; ".join(l for l in run.stderr.splitlines() if "rror" in l)[:600] or f"exit code {run.returncode}")


def as_header(cxx):
    """What a C++ compiler has to be told to make a precompiled header that holds as long as the contents of its sources do:
    clang would ask for their times, too, which a checkout changes."""
    return ["-x", "c++-header", *(["-Xclang", "-fno-pch-timestamp"] if "clang" in pathlib.Path(cxx).name else [])]


class Builder:
    """Builds groups into shared libraries with the C function epiline_make_model(name, seed).

    precompiled: folder of the precompiled header; verilated: archive of Verilator's run-time library.
    """

    def __init__(self, cxx, flags, verilated, precompiled):
        self.cxx, self.flags, self.verilated, self.precompiled = cxx, flags, verilated, pathlib.Path(precompiled)
        root = subprocess.run(["verilator", "--getenv", "VERILATOR_ROOT"], capture_output=True, text=True, check=True)
        include = f"{root.stdout.strip()}/include"
        self.options = ["-std=c++20", flags, "-w", "-fPIC", "-pthread", f"-I{HERE}", f"-I{ROOT / 'tb'}", f"-I{include}",
                        f"-I{include}/vltstd"]

    def header(self):
        """The options that take the precompiled header, made where it is missing."""
        is_clang = "clang" in pathlib.Path(self.cxx).name
        name = "group_" + re.sub(r"\W", "_", f"{self.cxx} {self.flags}") + ".hpp"
        header = self.precompiled / name
        made = header.with_name(name + (".pch" if is_clang else ".gch"))
        if not made.exists():
            self.precompiled.mkdir(parents=True, exist_ok=True)
            header.write_text('#include "group_model.hpp"\n#include <verilated_dpi.h>\n#include <verilated_syms.h>\n',
                              encoding="utf-8")
            part = made.with_suffix(f".{os.getpid()}")
            subprocess.run([self.cxx, *self.options, *as_header(self.cxx), str(header), "-o", str(part)], check=True)
            part.rename(made)
        return ["-include-pch", str(made)] if is_clang else ["-include", str(header)]

    def build(self, folder, verilog):
        """Makes folder/models.so of folder/group.v and the modules' Verilog; what went wrong, or None."""
        model = folder / "model"
        run = subprocess.run(
            ["verilator", "--cc", "--quiet-exit", "--no-timing", "-O3", "--x-assign", "unique", "--x-initial", "unique",
             "--noassert", "-Wall", "-Wno-fatal", "-Wno-lint", "-Wno-style", "-Wno-MODDUP", "--top-module", "group",
             "--prefix", "Vgroup", "--Mdir", str(model), str(folder / "group.v"), *verilog],
            capture_output=True, text=True, check=False)
        if run.returncode != 0:
            return problem_of(run, "Verilator")
        sources = sorted(model.glob("*.cpp"))
        (folder / "all.cpp").write_text("".join(f'#include "{f}"\n' for f in [*sources, folder / "models.cpp"]),
                                        encoding="utf-8")
        run = subprocess.run([self.cxx, *self.header(), *self.options, f"-I{model}", "-shared", str(folder / "all.cpp"),
                              self.verilated, "-o", str(folder / "models.so")],
                             capture_output=True, text=True, check=False)
        return problem_of(run, "C++ of the model") if run.returncode != 0 else None
