#!/usr/bin/env python3
"""Writes the binding of one Verilator model to epiline::cosim::rtl_model.

make_model.py REPORT.json NAME FOLDER

REPORT.json is epiline-hls's report (or any file with the same key "interface"); NAME names the model: Verilator was
run with --prefix VNAME. Writes FOLDER/NAME_model.hpp, which declares make_NAME_model(seed), and FOLDER/NAME_model.cpp.
"""

import json
import pathlib
import sys

HEADER = """#pragma once
// Written by make_model.py from {report}.

#include <cstdint>
#include <memory>

#include "cosim/model.hpp"

namespace epiline::cosim {{

/// `seed`: of the random contents of registers and memories that have no reset.
[[nodiscard]] std::unique_ptr<rtl_model> make_{name}_model(std::uint64_t seed);

}}  // namespace epiline::cosim
"""

SOURCE = """// Written by make_model.py from {report}.

#include "{name}_model.hpp"

#include <cstdlib>

#include "V{name}.h"
#include "cosim/verilated_model.hpp"

namespace epiline::cosim {{
namespace {{

class {name}_model final : public verilated_model<V{name}> {{
 public:
  explicit {name}_model(std::uint64_t seed) : verilated_model(seed) {{
    name_ = "{module}";
    ports_ = {{
{ports}
    }};
    fifos_ = {{{fifos}}};
{reset}
  }}

  void set_token(std::size_t port, const std::uint32_t* token) override {{
    switch (port) {{
{set_token}
      default: std::abort();
    }}
  }}
  void set_valid(std::size_t port, bool value) override {{
    switch (port) {{
{set_valid}
      default: std::abort();
    }}
  }}
  bool ready(std::size_t port) const override {{
    switch (port) {{
{ready}
      default: std::abort();
    }}
  }}
  void get_token(std::size_t port, std::uint32_t* token) const override {{
    switch (port) {{
{get_token}
      default: std::abort();
    }}
  }}
  bool valid(std::size_t port) const override {{
    switch (port) {{
{valid}
      default: std::abort();
    }}
  }}
  void set_ready(std::size_t port, bool value) override {{
    switch (port) {{
{set_ready}
      default: std::abort();
    }}
  }}
}};

}}  // namespace

std::unique_ptr<rtl_model> make_{name}_model(std::uint64_t seed) {{ return std::make_unique<{name}_model>(seed); }}

}}  // namespace epiline::cosim
"""


def verilated_name(signal):
    """Verilator writes a double underscore inside a Verilog name as ___05F_."""
    return signal.replace("__", "___05F")


def switch_lines(cases):
    return "\n".join(f"      case {index}: {text}" for index, text in cases)


def token_statement(port, function, direction):
    words = (port["width"] + 31) // 32
    element = "const std::uint32_t" if direction == "put" else "std::uint32_t"
    lines = [f"{{\n        const std::span<{element}> words(token, {words});"]
    if direction == "get":
        lines.append("        for (std::uint32_t& word : words) word = 0;")
    for field in port["fields"]:
        lines.append(
            f"        {function}(top_->{verilated_name(field['rtl'])}, words, {field['offset']}, {field['width']});"
        )
    lines.append("        break;\n      }")
    return "\n".join(lines)


def fail(message):
    sys.exit(f"make_model.py: {message}")


def write_model(report, name, folder):
    """Writes the binding of the model Vname of the module that the file `report` describes."""
    try:
        with open(report, encoding="utf-8") as file:
            content = json.load(file)
    except (OSError, ValueError) as error:
        fail(f"{report}: {error}")
    try:
        module = content["interface"]["module"]
        ports = content["interface"]["ports"]
        fifos = ", ".join(f'{{"{f["name"]}", "{f["instance"]}", {f["depth"]}}}' for f in content.get("streams", []))
        described, reset = [], []
        cases = {key: [] for key in ("set_token", "set_valid", "ready", "get_token", "valid", "set_ready")}
        for index, port in enumerate(ports):
            is_input = {"input": True, "output": False}[port["direction"]]
            fields = ", ".join(f'{{"{f["signal"]}", {f["width"]}, {f["offset"]}}}' for f in port["fields"])
            described.append(
                f'        {{"{port["name"]}", port_kind::{port["kind"]}, {"true" if is_input else "false"}, '
                f'{port["width"]}, {{{fields}}}}},'
            )
            valid, ready = verilated_name(port["valid"]), verilated_name(port["ready"])
            if is_input:
                cases["set_token"].append((index, token_statement(port, "put_field", "put")))
                cases["set_valid"].append((index, f"top_->{valid} = value; break;"))
                cases["ready"].append((index, f"return top_->{ready} != 0;"))
                reset.append(f"    top_->{valid} = 0;")
            else:
                cases["get_token"].append((index, token_statement(port, "get_field", "get")))
                cases["valid"].append((index, f"return top_->{valid} != 0;"))
                cases["set_ready"].append((index, f"top_->{ready} = value; break;"))
                reset.append(f"    top_->{ready} = 0;")
    except (KeyError, TypeError) as error:
        fail(f"{report}: no interface of a module: {error!r}")

    values = {key: switch_lines(lines) for key, lines in cases.items()}
    values.update(name=name, module=module, report=report, ports="\n".join(described), reset="\n".join(reset), fifos=fifos)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / f"{name}_model.hpp").write_text(HEADER.format(**values), encoding="utf-8")
    (folder / f"{name}_model.cpp").write_text(SOURCE.format(**values), encoding="utf-8")


def main():
    if len(sys.argv) != 4:
        fail(__doc__.split("\n\n")[1])
    write_model(sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3]))


if __name__ == "__main__":
    main()
