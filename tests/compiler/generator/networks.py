"""Random tops of two to five processes (DATAFLOW, or tasks) joined by streams, in which ways part and meet again."""

import random

from .drivers import driver, driver_of_tasks
from .programs import INCLUDES, Body, struct_texts
from .values import palette_of, type_name

# Every process makes 4 iterations a row. A stream carries a token in each of them, or in some that are fixed: so its
# writer and its reader agree on their number, whichever iterations of four each of them takes.
RATES = {4: [None], 2: ["(i & 1) == 0", "(i & 1) == 1", "i % 2 != 0"], 1: ["(i & 3) == 0", "(i & 3) == 3", "i % 4 == 1"]}
# Tokens that may have to wait where two ways meet again, when writers and readers take other iterations of four.
SKEW = 4


class Network:
    def __init__(self, seed):
        self.seed = seed
        self.name = f"random_{seed}"
        self.r = random.Random(seed * 2654435761 % (1 << 31) + 17)
        self.fast = self.r.random() < 0.5
        self.features = {}

    def hit(self, feature):
        self.features[feature, ""] = self.features.get((feature, ""), 0) + 1

    def process(self, name, ports, scalars, shape):
        """Text of one process: a function of `ports` and `scalars`."""
        r = self.r
        body = Body(self.seed, r, self.fast, self.palette, self.features)
        body.budget = r.choice([0, 1, 2, 3, r.randint(3, 10)])
        head = [line.replace("table", f"{name}_table").replace("helper", f"{name}_helper")
                for line in body.make_tables() + body.make_helpers()]
        body.tables = [(f"{name}_{t[0]}", *t[1:]) for t in body.tables]
        body.helpers = [(f"{name}_{h[0]}", *h[1:]) for h in body.helpers]
        body.add_scalars(scalars)
        body.scalars = [s for s in scalars if s[2] is None]
        if shape == "call":
            body.lines.append("#pragma HLS PIPELINE II=1")
        body.declare_state(shape, 0.15)
        inputs = [p for p in ports if p["input"]]
        outputs = [p for p in ports if not p["input"]]
        if shape == "endless":
            self.hit("endless loop")
            body.emit(r.choice(["while (true) {", "for (;;) {", "while (1) {"]))
            body.loop_pragma()
            body.indent += 1
        if shape in ("call", "endless"):
            # Tasks wait natively, too; others are called in turn, and must not read what is not there.
            asks = self.asks and (not self.tasks or r.random() < 0.5)
            closing = body.ask(inputs, outputs, "return" if shape == "call" else "continue") if asks else []
            body.iteration(inputs, outputs, [], [])
            for line in closing:
                body.emit(line)
            if shape == "endless":
                body.indent -= 1
                body.emit("}")
        else:
            body.emit("for (int i = 0; i < 4 * rows; ++i) {")
            body.loop_pragma()
            body.iteration(inputs, outputs, [], [], counter="i", counter_type="int")
            body.emit("}")
        parameters = [f"hls::stream<{p['type']}>& {p['name']}" for p in ports] + [f"{t[0]} {n}" for n, t, _ in scalars]
        return [*head, f"static void {name}({', '.join(parameters)}) {{", *body.lines, "}", ""]

    def generate(self):
        r = self.r
        shape = r.choices(["counted", "call"], [60, 40])[0]
        self.tasks = shape == "call" and r.random() < 0.5
        self.asks = shape == "call" and r.random() < 0.6
        maker = Body(self.seed, r, self.fast, None, self.features)
        self.palette = maker.palette = palette_of(self.seed, r, 4)
        count = r.choices([2, 3, 4, 5], [45, 30, 15, 10])[0]
        self.hit(f"processes {count}")
        self.hit("network of loops" if shape == "counted" else "network without scalars")
        scalars = []
        if shape == "counted":
            scalars = [("rows", r.choice([("ap_uint<5>", 5, False), ("int", 32, True), ("unsigned char", 8, False)]),
                        (0, 8))] + maker.more_scalars(r.choice([0, 0, 1]))

        def rate():
            return 4 if shape == "call" else r.choices([4, 2, 1], [70, 20, 10])[0]

        def end(port, is_input, tokens):
            """One end of a stream: its reader's or its writer's view."""
            return dict(port, input=is_input, every=r.choice(RATES[tokens]), counted=not is_input)

        ports, structs = [[] for _ in range(count)], []
        top, streams = [], []

        def outside(process, is_input):
            port = maker.make_port(f"{'in' if is_input else 'out'}{len(top)}", is_input, r.random() < 0.15)
            top.append(port)
            outer = dict(port)
            if is_input and shape == "counted":
                outer["every"] = r.choice(RATES[rate()])
            ports[process].append(outer)

        def between(writer, reader):
            axis = r.random() < 0.1
            port = maker.make_port(f"way{len(streams)}", True, axis)
            tokens = rate()
            streams.append((port, tokens))
            self.hit(f"stream between processes, {tokens} tokens in 4 iterations")
            ports[writer].append(end(port, False, tokens))
            ports[reader].append(end(port, True, tokens))

        outside(0, True)
        for reader in range(1, count):
            writers = {reader - 1 if r.random() < 0.7 else r.randrange(reader)}
            if r.random() < 0.4:
                writers.add(r.randrange(reader))
                self.hit("ways that meet" if len(writers) == 2 else "one way")
            elif r.random() < 0.2:
                between(next(iter(writers)), reader)  # two streams between the same two
                self.hit("two streams between two processes")
            for writer in sorted(writers):
                between(writer, reader)
        for process in range(count):
            if all(p["input"] for p in ports[process]):
                outside(process, False)
            if r.random() < 0.15:
                outside(process, False)
            if process and r.random() < 0.15:
                outside(process, True)
        # The first read of an iteration must not wait for what is decided later: streams that are read always first.
        structs = struct_texts(top + [s for s, _ in streams])
        text, calls = [], []
        uneven = any(tokens != 4 for _, tokens in streams)
        for process in range(count):
            name = f"process{process}"
            taken = scalars if process == 0 else scalars[:1] + [s for s in scalars[1:] if r.random() < 0.5]
            form = "endless" if self.tasks and r.random() < 0.4 else shape
            text += self.process(name, ports[process], taken, form)
            arguments = ", ".join([p["name"] for p in ports[process]] + [s[0] for s in taken])
            calls.append(f"  hls_thread_local hls::task task{process}({name}, {arguments});" if self.tasks else
                         f"  {name}({arguments});")
        # What a call leaves in a stream is there in the next one.
        keyword = "hls_thread_local " if self.tasks else "static " if self.asks else ""
        if self.tasks:
            self.hit("tasks")
        declarations = []
        for port, _ in streams:
            least = SKEW * count if uneven else 0
            depth = r.choice([None, None, 1, 2, 3, 8, 17, 64]) if not uneven else r.choice([least, least + 7, 64])
            if depth is None:
                declarations.append(f"  {keyword}hls::stream<{port['type']}> {port['name']}(\"{port['name']}\");")
            elif r.random() < 0.5:
                self.hit("depth in the type")
                declarations.append(f"  {keyword}hls::stream<{port['type']}, {depth}> {port['name']};")
            else:
                self.hit("pragma STREAM depth")
                declarations.append(f"  {keyword}hls::stream<{port['type']}> {port['name']};")
                declarations.append(f"#pragma HLS STREAM variable={port['name']} depth={depth}")
        parameters = [f"hls::stream<{p['type']}>& {p['name']}" for p in top if p["input"]]
        parameters += [f"hls::stream<{p['type']}>& {p['name']}" for p in top if not p["input"]]
        parameters += [f"{t[0]} {n}" for n, t, _ in scalars]
        program = [f"// Written by random_program.py, seed {self.seed}.",
                   f"// epiline-hls: {'' if self.fast else '--clock 200ns'}", *INCLUDES[:-1], '#include "hls_task.h"', "",
                   *structs, *text,
                   f"void {self.name}({', '.join(parameters)}) {{", *([] if self.tasks else ["#pragma HLS DATAFLOW"]),
                   *declarations, *calls, "}"]
        if self.tasks:
            drive = driver_of_tasks(self.name, top)
        else:
            drive = driver(self.name, top, scalars, [], 60 if shape == "call" else 8, 2 if shape == "call" else 33,
                           asked=[p for p in top if p["input"]] if self.asks else ())
        return "\n".join(program) + "\n", drive
