"""Random tops: one loop nest, or several in sequence."""

import random

from .drivers import driver
from .questions import Questions
from .values import C_TYPES, Variable, palette_of, type_name

INCLUDES = ['#include "ap_axi_sdata.h"', '#include "ap_int.h"', '#include "hls_stream.h"', ""]
# Share of programs with one input, one output, at most two states and shallow expressions.
SMALL = 0.75


class Body(Questions):
    """The body of one function: state, loops, iterations."""

    def __init__(self, seed, stream_of_numbers, fast, palette, features):
        self.seed = seed
        self.r = stream_of_numbers
        self.fast = fast
        self.palette = palette  # few widths a program: every one costs compile time
        self.features = features  # (feature, width class and sign) -> how often
        self.lines = []
        self.indent = 1
        self.scope = []  # variables readable here
        self.states = []  # loop-carried variables, in the order in which they may depend on each other
        self.tables = []  # (name, index bits, width, signed)
        self.helpers = []  # (name, parameter types, result type, what it is)
        self.scalars = []  # (name, (type, width, signed), bounds)
        self.counter = 0
        # Small programs find most bugs, and several of them are as fast as a large one.
        self.small = self.r.random() < SMALL
        self.budget = self.r.choices([self.r.randint(1, 5), self.r.randint(4, 12), self.r.randint(12, 32)],
                                     [70, 24, 6] if not self.small else [1, 0, 0])[0]
        self.allow_taint = True
        self.used_wide_multiply = 0
        self.variable_divisions = 0
        self.ram = None
        self.delay = None
        self.leave_unless_read = (None, "")  # the input that an iteration begins with by read_nb, and how it ends without

    def add_scalars(self, scalars):
        self.scalars = scalars
        for name, (text, width, signed), _ in scalars:
            self.hit("scalar", width, signed)
            self.scope.append(Variable(name if text.startswith("ap_") else f"{type_name(width, signed)}({name})",
                                       width, signed, mutable=False))

    def more_scalars(self, count):
        r = self.r
        result = []
        for i in range(count):
            width, signed = self.any_type()
            if r.random() < 0.3:
                text = r.choice(["bool", "int", "unsigned char", "short", "unsigned long long"])
                width, signed = C_TYPES[text]
            else:
                text = type_name(width, signed)
            result.append((f"arg{i}", (text, width, signed), None))
        return result

    def declare_state(self, shape, ram_share=0.45):
        """Declares states, counters, shift registers, RAMs and lambdas at the top of the function."""
        r = self.r
        self.shape = shape
        self.make_states(True)
        # the iteration counter: read conditions are cheap functions of it
        self.tick_static = shape == "call" or r.random() < 0.5
        self.scope.append(Variable("tick", 8, False, tainted=not self.fast, mutable=False))
        for state in self.states:
            if shape == "call":
                state.static = True
            keyword = "static " if state.static else ""
            self.emit(f"{keyword}{type_name(state.width, state.signed)} {state.name} = {state.initial};")
            if state.static and r.random() < 0.15:
                self.hit("pragma RESET off")
                self.lines.append(f"#pragma HLS RESET variable={state.name} off")
        self.emit(f"{'static ' if self.tick_static else ''}ap_uint<8> tick = 0;")
        if self.delay:
            name, length, width, signed, static = self.delay
            if shape == "call":
                static = True
            if static:
                self.emit(f"static {type_name(width, signed)} {name}[{length}] = {{}};")
            else:
                self.emit(f"{type_name(width, signed)} {name}[{length}];")
                self.emit(f"for (int i = 0; i < {length}; ++i) {name}[i] = 0;")
            if r.random() < 0.5:
                self.hit("pragma ARRAY_PARTITION")
                self.lines.append(f"#pragma HLS ARRAY_PARTITION variable={name} complete")
        if r.random() < 0.15:
            self.make_lambda()
        self.scope += self.states
        if r.random() < ram_share:
            self.make_ram(shape)


def parameter_of(port):
    """A port as a parameter of the top."""
    if "size" in port:
        return f"{'const ' if port['input'] else ''}{port['type']} {port['name']}[{port['size']}]"
    return f"hls::stream<{port['type']}>& {port['name']}"


class Program(Body):
    """A top with one loop nest, or some in sequence."""

    def __init__(self, seed):
        numbers = random.Random(seed * 2654435761 % (1 << 31) + 17)
        super().__init__(seed, numbers, numbers.random() < 0.5, None, {})
        self.name = f"random_{seed}"
        self.palette = palette_of(seed, numbers, 5)

    def generate(self):
        r = self.r
        shape = r.choices(["call", "counted", "nested", "until_last", "phases", "packets", "while", "arrays"],
                          [22, 20, 15, 13, 10, 10, 10, 10])[0]
        self.hit("shape " + shape)
        head = self.make_tables()
        head += self.make_helpers()

        inputs = [self.make_port(f"in{i}", True, axis=shape == "until_last" and i == 0)
                  for i in range(1 if self.small else r.choice([1, 1, 1, 2, 2, 3]))]
        outputs = [self.make_port(f"out{i}", False, axis=r.random() < 0.2) for i in range(1 if self.small else r.choice([1, 1, 1, 2, 3]))]
        if shape == "arrays":
            passes = r.randint(20, 40)
            for port in inputs + outputs:
                self.make_array(port, passes)
        # Natively a call that finds nothing is made again: one with scalars would have taken them.
        asked = [p for p in inputs if p is inputs[0] or r.random() < 0.5] if shape == "call" and r.random() < 0.4 else []
        scalars = []
        if shape in ("counted", "nested", "while"):
            scalars.append(("rows", r.choice([("ap_uint<5>", 5, False), ("int", 32, True), ("unsigned char", 8, False),
                                              ("ap_int<7>", 7, True)]), (0, 12)))
        if shape == "nested":
            scalars.append(("cols", r.choice([("ap_uint<4>", 4, False), ("unsigned", 32, False), ("short", 16, True)]),
                            (0, 9)))
        if scalars or (not asked and r.random() < 0.3):
            scalars += self.more_scalars(r.randint(0, 2))
        results = []
        if shape != "call" and r.random() < 0.3:
            results.append(("total",) + self.any_type())
            self.hit("result by reference", *results[0][1:])

        self.add_scalars(scalars)
        if shape == "call":
            self.lines.append("#pragma HLS PIPELINE II=1")
        self.declare_state(shape)
        if results:
            self.emit(f"{type_name(*results[0][1:])} result = 0;")
        self.asked = asked
        getattr(self, "loops_" + shape)(inputs, outputs, results)
        if results:
            self.emit("total = result;")

        parameters = [parameter_of(p) for p in inputs + outputs]
        parameters += [f"{t[0]} {n}" for n, t, _ in scalars]
        parameters += [f"{type_name(w, s)}& {n}" for n, w, s in results]
        text = [f"// Written by random_program.py, seed {self.seed}.",
                f"// epiline-hls: {'' if self.fast else '--clock 200ns'}", *INCLUDES]
        text += struct_texts(inputs + outputs) + head
        text.append("")
        text.append(f"void {self.name}({', '.join(parameters)}) {{")
        for port in inputs + outputs:
            if "size" in port or r.random() < 0.3:  # a short array would be one value
                self.hit("pragma INTERFACE")
                text.append(f"#pragma HLS INTERFACE axis port={port['name']}")
        text += self.lines
        text.append("}")
        calls = {"call": 120, "counted": 16, "nested": 8, "until_last": 12, "phases": 5, "packets": 16, "while": 16,
                 "arrays": 5}
        most = {"call": 2, "counted": 16, "nested": 128, "until_last": 16, "phases": 64, "packets": 20, "while": 16,
                "arrays": 0}
        return "\n".join(text) + "\n", driver(self.name, inputs + outputs, scalars, results, calls[shape], most[shape],
                                              inputs[0] if shape == "until_last" else None, asked)

    # ---- shapes: the loops around the iterations ----------------------------------------------------------------
    def loops_call(self, inputs, outputs, results):
        closing = self.ask(self.asked, outputs, "return") if self.asked else []
        self.iteration(inputs, outputs, [p for p in inputs[1:] if p not in self.asked], results)
        for line in closing:
            self.emit(line)

    def loops_counted(self, inputs, outputs, results):
        counter_type = self.r.choice(["ap_uint<8>", "int", "unsigned"])
        limit = {"ap_uint<8>": "ap_uint<8>(rows)", "int": "int(rows)", "unsigned": "static_cast<unsigned>(rows)"}
        self.emit(f"for ({counter_type} i = 0; i < {limit[counter_type]}; ++i) {{")
        self.loop_pragma()
        self.iteration(inputs, outputs, inputs[1:], results, counter="i", counter_type=counter_type)
        self.emit("}")

    def loops_arrays(self, inputs, outputs, results):
        """As many passes as the arrays are made for."""
        self.emit(f"for (int i = 0; i < {inputs[0]['passes']}; ++i) {{")
        self.loop_pragma()
        self.iteration(inputs, outputs, inputs[1:], results, counter="i", counter_type="int")
        self.emit("}")

    def loops_while(self, inputs, outputs, results):
        """A run-time bound that counts down, and at times an early exit on data or on the counter."""
        self.emit("ap_uint<5> left = rows;")
        self.emit("while (left != 0) {" if self.r.random() < 0.6 else "for (; left > 0;) {")
        self.loop_pragma()
        self.scope.append(Variable("left", 5, False, mutable=False))
        before = len(self.lines)
        self.iteration(inputs, outputs, inputs[1:], results)
        step = self.r.choice(["--left;", "left--;", "left -= 1;"])
        if self.r.random() < 0.3:  # counts down at the head
            self.lines.insert(before, "    " + step)
        else:
            self.emit("  " + step)
        if self.r.random() < 0.5:
            self.hit("early exit")
            leave = self.r.choice(["tick[3] && left < 4", "(tick & 7) == 5", "tick == 9"])
            if not self.fast and self.states:
                leave = f"{self.states[0].name} == {self.r.randint(0, 3)} && {leave}"
            self.emit(f"  if ({leave}) break;")
        self.emit("}")

    def loops_nested(self, inputs, outputs, results):
        r = self.r
        self.emit("for (ap_uint<6> i = 0; i < ap_uint<6>(rows); ++i) {")
        self.indent += 1
        row_state = None
        if r.random() < 0.3:
            local = self.fresh("w")
            width, signed = self.any_type()
            if self.fast:
                width = min(width, 12)
            value = self.expression(1) if not self.fast else self.ap_literal(width, signed)
            self.emit(f"{type_name(width, signed)} {local} = {value.text};")
            row_state = (local, width, signed)
        self.emit("for (ap_uint<5> j = 0; j < ap_uint<5>(cols); ++j) {")
        self.loop_pragma()
        self.scope.append(Variable("j", 5, False, mutable=False))
        self.iteration(inputs, outputs, inputs[1:], results, counter="i", counter_type="ap_uint<6>",
                       row_state=row_state)
        self.emit("}")
        self.indent -= 1
        self.emit("}")

    def loops_until_last(self, inputs, outputs, results):
        form = self.r.choice(["do", "while"])
        self.emit("bool last = false;")
        self.emit("do {" if form == "do" else "while (!last) {")
        self.loop_pragma()
        self.iteration(inputs, outputs, inputs[1:], results, last=True)
        self.emit("} while (!last);" if form == "do" else "}")

    def loops_phases(self, inputs, outputs, results):
        r = self.r
        phases = r.randint(2, 3)
        unwritten = list(outputs)
        for phase in range(phases):
            visible = len(self.scope)
            self.emit(f"for (int i = 0; i < {r.choice([2, 3, 5, 8, 17, 20])}; ++i) {{")
            self.loop_pragma()
            # Each phase reads its own part of the inputs and writes its own part of the outputs.
            here = inputs if phase == 0 else [p for p in inputs if r.random() < 0.6]
            there = [p for p in outputs if r.random() < 0.6] or [r.choice(outputs)]
            unwritten = [p for p in unwritten if p not in there]
            if phase + 1 == phases:
                there += unwritten
            self.iteration(here, there, here[1:], results, counter="i", counter_type="int", phase=phase)
            self.emit("}")
            del self.scope[visible:]

    def loops_packets(self, inputs, outputs, results):
        """The first token says how many follow."""
        first = inputs[0]
        self.emit(f"const {first['type']} header = in0.read();")
        source = "header" if not first["members"] else f"header.{first['members'][0][0]}"
        if first["axis"]:
            source = "header.data"
        self.emit(f"const ap_uint<4> count = {source};")
        self.emit("for (ap_uint<5> i = 0; i < count; ++i) {")
        self.loop_pragma()
        self.iteration(inputs, outputs, inputs[1:], results, counter="i", counter_type="ap_uint<5>")
        self.emit("}")


def struct_texts(ports):
    result = []
    for port in ports:
        if port["members"]:
            fields = " ".join(f"{type_name(w, s)} {n};" for n, w, s in port["members"])
            result.append(f"struct {port['struct']} {{ {fields} }};")
    return result
