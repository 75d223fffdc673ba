"""The driver of a random program: what its native run is given (see tests/compiler/drive.hpp)."""

from .values import type_name


def inputs_of(ports):
    return [p for p in ports if p["input"]]


def outputs_of(ports):
    return [p for p in ports if not p["input"]]


def head(name, ports):
    """The program in a namespace of its own, and the ports of the session."""
    # What drive.hpp does not include must not come inside a namespace.
    lines = ['#include "drive.hpp"', '#include "hls_task.h"', f"namespace program_{name} {{", f'#include "{name}.cpp"', "}",
             f"using namespace program_{name};"]
    for port in inputs_of(ports) + outputs_of(ports):
        if port["members"]:
            leaves = ", ".join(f"v.{n}" for n, _, _ in port["members"])
            lines.append(f"EPILINE_LEAVES(program_{name}::{port['struct']}, {leaves});")
    lines.append(f"EPILINE_DRIVER({name}) {{")
    for port in inputs_of(ports):
        lines.append(f'  auto& {port["name"]} = s.input<{port["type"]}>("{port["name"]}");')
    for port in outputs_of(ports):
        lines.append(f'  auto& {port["name"]} = s.output<{port["type"]}>("{port["name"]}");')
    return lines


# What an input gets whose tokens come one by one.
TOKENS = 60


def driver(name, ports, scalars, results, calls, most, packets=None, asked=()):
    """The text of a driver that calls the top `name` `calls` times.

    `most`: tokens that wait at each input before a call, at least as many as a call can read; `packets`: the input that
    gets packets with `last` instead. What is left at the end is taken back. `asked`: inputs that are asked whether they
    have tokens: these get them one by one, so that many calls find nothing, and then it is called until all is done.
    """
    inputs, outputs = inputs_of(ports), outputs_of(ports)
    lines = head(name, ports)
    for port in asked:
        lines.append(f"  int {port['name']}_left = {TOKENS};")
    if asked:  # an output that is full delays a call by one
        calls = 4 * TOKENS
    lines.append(f"  for (int call = 0; call < {calls}; ++call) {{")
    for port in inputs + outputs:
        if "size" in port:
            # What a call does not write stays: the arrays of outputs are the same in every call.
            lines.append(f"    {'static ' if port in outputs else ''}{port['type']} {port['name']}_values[{port['size']}];")
    for port in inputs:
        if "size" in port:
            lines.append(f"    for (auto& value : {port['name']}_values) {{")
            lines.append(f"      {port['name']}.push(value = s.any<{port['type']}>());")
            lines.append(f"      {port['name']}.stream.read();")
            lines.append("    }")
        elif port in asked:
            more = f"{port['name']}_left"
            lines.append(f"    for (int i = call < {TOKENS} ? s.chance(60) : {more}; i > 0 && {more} > 0; --i, --{more})")
            lines.append(f"      {port['name']}.fill_up({port['name']}.stream.size() + 1);")
        elif port is packets:
            lines.append("    const auto beats = s.number(1, 12);")
            lines.append("    for (int i = 0; i < beats; ++i) {")
            lines.append(f'      auto beat = s.any<{port["type"]}>();')
            lines.append("      beat.last = i + 1 == beats;")
            lines.append(f'      {port["name"]}.push(beat);')
            lines.append("    }")
        else:
            lines.append(f'    {port["name"]}.fill_up({most});')
    arguments = []
    for scalar, (text, _, _), bound in scalars:
        if bound:
            lines.append(f"    const auto {scalar} = static_cast<{text}>(s.number({bound[0]}, {bound[1]}));")
        else:
            lines.append(f"    const auto {scalar} = s.any<{text}>();")
        arguments.append(f'{{"{scalar}", {scalar}}}')
    if arguments:
        lines.append(f"    s.call({{{', '.join(arguments)}}});")
    for result, width, signed in results:
        lines.append(f"    {type_name(width, signed)} {result} = 0;")
    call = [f"{p['name']}_values" if "size" in p else f"{p['name']}.stream" for p in inputs + outputs]
    call += [n for n, _, _ in scalars] + [n for n, _, _ in results]
    lines.append(f"    {name}({', '.join(call)});")
    for port in outputs:
        if "size" in port:
            lines.append(f"    for (const auto& value : {port['name']}_values) {port['name']}.stream.write(value);")
    for result, _, _ in results:
        lines.append(f'    s.result("{result}", {result});')
    lines.append("  }")
    for port in inputs:
        lines.append(f"  {port['name']}.take_back();")
    lines.append("}")
    return "\n".join(lines) + "\n"


def driver_of_tasks(name, ports):
    """The text of a driver of a top made of tasks, which keep their streams for good: these outlive the session."""
    lines = head(name, ports)
    for port in ports:
        lines.append(f"  static hls::stream<{port['type']}> held_{port['name']};")
    arguments = ", ".join(f"held_{p['name']}" for p in inputs_of(ports) + outputs_of(ports))
    lines.append(f"  for (int call = 0; call < {TOKENS}; ++call) {{")
    for port in inputs_of(ports):
        lines.append(f"    {port['name']}.fill_up(1);")
        lines.append(f"    held_{port['name']}.write({port['name']}.stream.read());")
    lines += [f"    if (s.chance(50)) {name}({arguments});", "    if (s.chance(20)) hls::run_tasks();", "  }",
              f"  {name}({arguments});", "  hls::run_tasks();"]
    for port in outputs_of(ports):
        lines.append(f"  while (!held_{port['name']}.empty()) {port['name']}.stream.write(held_{port['name']}.read());")
    lines.append("}")
    return "\n".join(lines) + "\n"
