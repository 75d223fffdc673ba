"""The driver of a random program: what its native run is given (see tests/compiler/drive.hpp)."""

from .values import type_name


def driver(name, ports, scalars, results, calls, most, packets=None):
    """The text of a driver that calls the top `name` `calls` times.

    `most`: tokens that wait at each input before a call, at least as many as a call can read; `packets`: the input that
    gets packets with `last` instead. What is left at the end is taken back.
    """
    inputs = [p for p in ports if p["input"]]
    outputs = [p for p in ports if not p["input"]]
    lines = ["#include \"drive.hpp\"", f"namespace program_{name} {{", f'#include "{name}.cpp"', "}",
             f"using namespace program_{name};"]
    for port in inputs + outputs:
        if port["members"]:
            leaves = ", ".join(f"v.{n}" for n, _, _ in port["members"])
            lines.append(f"EPILINE_LEAVES(program_{name}::{port['struct']}, {leaves});")
    lines.append(f"EPILINE_DRIVER({name}) {{")
    for port in inputs:
        lines.append(f'  auto& {port["name"]} = s.input<{port["type"]}>("{port["name"]}");')
    for port in outputs:
        lines.append(f'  auto& {port["name"]} = s.output<{port["type"]}>("{port["name"]}");')
    lines.append(f"  for (int call = 0; call < {calls}; ++call) {{")
    for port in inputs:
        if port is packets:
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
    call = [f"{p['name']}.stream" for p in inputs + outputs]
    call += [n for n, _, _ in scalars] + [n for n, _, _ in results]
    lines.append(f"    {name}({', '.join(call)});")
    for result, _, _ in results:
        lines.append(f'    s.result("{result}", {result});')
    lines.append("  }")
    for port in inputs:
        lines.append(f"  {port['name']}.take_back();")
    lines.append("}")
    return "\n".join(lines) + "\n"
