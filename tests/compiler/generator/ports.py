"""Streams of random payloads, and one random iteration that reads, computes and writes."""

from .memories import Memories
from .values import C_TYPES, Value, Variable, type_name


class Ports(Memories):
    def make_port(self, name, is_input, axis):
        r = self.r
        port = {"name": name, "members": [], "axis": axis, "input": is_input, "every": None}
        self.hit("input" if is_input else "output")
        if axis:
            width = r.choice([8, 16, 32, 64, self.any_type()[0]])
            self.hit("payload AXI", width)
            signed = r.random() < 0.3
            port["type"] = f"{'ap_axis' if signed else 'ap_axiu'}<{width}, {r.randint(1, 3)}, 1, 1>"
            port["data"] = (width, signed)
        elif r.random() < 0.25:
            port["struct"] = f"{name}_{self.seed}_t"
            port["type"] = port["struct"]
            port["members"] = [(f"m{i}",) + self.any_type() for i in range(r.randint(1, 3))]
            self.hit("payload struct", sum(m[1] for m in port["members"]))
        elif r.random() < 0.15:
            port["type"] = r.choice(["unsigned char", "short", "int", "unsigned", "unsigned long long"])
            self.hit("payload C integer", C_TYPES[port["type"]][0])
            port["data"] = C_TYPES[port["type"]]
        else:
            port["data"] = self.any_type()
            port["type"] = type_name(*port["data"])
            self.hit("payload", *port["data"])
        return port

    def make_array(self, port, passes):
        """Makes an array of a port, for a loop of that many passes with the counter `i`."""
        r = self.r
        order = r.choice(["in order", "in order", "backwards", "pairs", "any"])
        self.hit("array " + order)
        port["passes"] = passes
        port["size"] = {"pairs": 2 * passes, "any": 64}.get(order, passes)
        at = r.choice(["tick.to_uint() & 63", f"(i * {r.choice([3, 5, 7])}) & 63"])
        port["indices"] = {"in order": ["i"], "backwards": [f"{passes - 1} - i"], "pairs": ["2 * i", "2 * i + 1"],
                           "any": [at]}[order]

    def loop_pragma(self):
        if self.r.random() < 0.8:
            self.hit("pragma PIPELINE")
            self.lines.append("#pragma HLS PIPELINE II=1")
        if self.r.random() < 0.2:
            self.lines.append("#pragma HLS LOOP_TRIPCOUNT min=1 max=16")

    def read_port(self, port, name):
        r = self.r
        style = r.random()
        asked, leave = self.leave_unless_read
        if "size" in port:
            tokens = [name] + [self.fresh("t") for _ in port["indices"][1:]]
            for token, index in zip(tokens, port["indices"]):
                self.emit(f"const {port['type']} {token} = {port['name']}[{index}];")
            return [m for token in tokens for m in self.members(port, token)]
        if port is asked:
            self.emit(f"{port['type']} {name};")
            self.emit(f"if (!{port['name']}.read_nb({name})) {leave};")
        elif style < 0.5:
            self.emit(f"const {port['type']} {name} = {port['name']}.read();")
        elif style < 0.75:
            self.emit(f"{port['type']} {name}; {port['name']} >> {name};")
        else:
            self.emit(f"{port['type']} {name}; {port['name']}.read({name});")
        return self.members(port, name)

    def members(self, port, name):
        if port["members"]:
            return [Variable(f"{name}.{n}", w, s, mutable=False) for n, w, s in port["members"]]
        width, signed = port["data"]
        if port["axis"]:
            return [Variable(f"{type_name(width, signed)}({name}.data)", width, signed, mutable=False),
                    Variable(f"{name}.user", 1, False, mutable=False)]
        if not port["type"].startswith("ap_"):
            return [Variable(f"{type_name(width, signed)}({name})", width, signed, mutable=False)]
        return [Variable(name, width, signed, mutable=False)]

    def cheap_condition(self):
        """Decides a read: a cheap function of counters and scalars."""
        r = self.r
        choices = [f"(tick & {r.choice([1, 3, 5])}) == {r.choice([0, 1])}", f"tick[{r.randint(0, 3)}]",
                   f"tick < {r.randint(1, 40)}", f"tick != {r.randint(0, 5)}"]
        for name, (text, width, _), bound in self.scalars:
            if bound is None:
                choices.append(f"({name} & 1) == 1" if text != "bool" else name)
        return r.choice(choices)

    def iteration(self, inputs, outputs, conditional, results, counter=None, counter_type=None, last=False,
                  row_state=None, phase=0):
        r = self.r
        self.indent += 1
        outer = len(self.scope)
        if counter:
            text = counter if counter_type.startswith("ap_") else f"ap_uint<6>({counter})"
            self.scope.append(Variable(text, 6 if counter_type in ("int", "unsigned") else int(counter_type[8:-1]), False,
                                       mutable=False))
        if row_state:
            variable = Variable(*row_state, tainted=True, mutable=False)
            self.scope.append(variable)
        data_dependent = not self.fast and r.random() < 0.3
        for port in inputs:
            token = self.fresh("t")
            if port["every"] or (port in conditional and r.random() < 0.6):
                condition = port["every"] or self.cheap_condition()
                if data_dependent and port is not inputs[0] and not port["every"]:
                    condition = f"{self.compare(1).text} || tick == {r.randint(0, 3)}"
                    self.hit("read on data")
                self.hit("conditional read")
                members = self.members(port, token)
                values = []
                for m in members:
                    values.append(Variable(self.fresh("c"), m.width, m.signed, mutable=False))
                    self.emit(f"{type_name(m.width, m.signed)} {values[-1].name} = {r.randint(0, 1)};")
                self.emit(f"if ({condition}) {{")
                self.indent += 1
                self.read_port(port, token)
                for m, v in zip(members, values):
                    self.emit(f"{v.name} = {m.name};")
                self.indent -= 1
                self.emit("}")
                self.scope += values
            else:
                self.scope += self.read_port(port, token)
                if last and port is inputs[0]:
                    self.emit(f"last = {token}.last;")
                    self.scope.append(Variable(f"ap_uint<1>({token}.last)", 1, False, mutable=False))
        if self.delay:
            name, length, width, signed, _ = self.delay
            self.scope.append(Variable(f"{name}[{r.randrange(length)}]", width, signed, mutable=False))
            self.scope.append(Variable(f"{name}[{length - 1}]", width, signed, mutable=False))

        read_first = r.random() < 0.6
        if self.ram and read_first:
            self.scope.append(self.ram_read())
        statements = min(self.budget, r.randint(2, 12)) if self.shape == "phases" else self.budget
        statements = max(statements, 2)
        target = self.budget - statements
        late = len(self.scope)
        while self.budget > target:
            self.statement()
        if self.ram:
            keep = self.allow_taint
            keep_scope = self.scope
            if self.fast:
                self.scope = [v for v in self.scope if not v.tainted]
                self.allow_taint = False
            self.ram_write()
            self.allow_taint = keep
            self.scope = keep_scope
            if not read_first and not self.fast:
                self.scope.append(self.ram_read())
        for i in range(len(self.states)):
            if phase == 0 or r.random() < 0.5:
                self.update_state(i)
                if r.random() < 0.3:
                    self.declare(1)  # sees the new value
        if row_state:
            name = row_state[0]
            keep_scope = self.scope
            self.scope = [v for v in self.scope if not v.tainted]
            value = self.expression(1)
            if self.fast:
                value = value.cast(row_state[1], row_state[2])
            self.emit(f"{name} += {value.text};")
            self.scope = keep_scope
        if self.delay:
            name, length, width, signed, _ = self.delay
            keep_scope = self.scope
            if self.fast:
                self.scope = [v for v in self.scope if not v.tainted]
            value = self.expression(2)
            self.scope = keep_scope
            if r.random() < 0.5:
                self.emit(f"for (int i = {length} - 1; i > 0; --i) {name}[i] = {name}[i - 1];")
            else:
                for i in range(length - 1, 0, -1):
                    self.emit(f"{name}[{i}] = {name}[{i - 1}];")
            self.emit(f"{name}[0] = {value.text};")
        for port in outputs:
            self.write_port(port)
            if r.random() < 0.06 and not port.get("counted"):
                self.hit("second write in an iteration")
                self.write_port(port)
        if results:
            name, width, signed = results[0]
            value = self.expression(1)
            if self.fast:
                keep_scope = self.scope
                self.scope = [v for v in self.scope if not v.tainted]
                value = self.expression(1).cast(min(width, 12), signed)
                self.scope = keep_scope
                self.emit(f"result = {value.text};")
            else:
                self.emit(f"result {r.choice(['=', '+=', '^='])} {value.text};")
        self.emit("tick++;")
        del self.scope[outer:]
        self.indent -= 1

    def observed(self):
        """An expression that lets much of what was computed be seen."""
        value = self.expression(2).as_ap()
        for v in self.r.sample(self.scope, min(len(self.scope), self.r.randint(1, 3))):
            op = self.r.choice(["+", "-", "^", "^"])
            width = self.join_width(value, v) + 1
            value = self.limit(Value(f"({value.text} {op} {v.name})", width, op == "-" or value.signed or v.signed))
        return value

    def write_port(self, port):
        r = self.r
        condition = port["every"]
        # A stream between processes: the number of its tokens is what the reader counts on.
        pick = r.random() if not port.get("counted") else 1
        if pick < 0.2:
            self.hit("write on data")
            # never always false: a port that is never written is refused
            condition = f"{self.condition(2).text} || tick == {r.randint(0, 3)}"
        elif pick < 0.4:
            self.hit("conditional write")
            condition = self.cheap_condition()
        if condition:
            self.emit(f"if ({condition}) {{")
            self.indent += 1
        for index in port.get("indices", [None]):
            self.write_token(port, index)
        if condition:
            self.indent -= 1
            self.emit("}")

    def write_token(self, port, index):
        """Writes a token to a stream, or an element of an array."""
        r = self.r
        name = port["name"]
        put = f"{name}.write({{}});" if index is None else f"{name}[{index}] = {{}};"
        if port["members"]:
            token = self.fresh("t")
            self.emit(f"{port['type']} {token};")
            for member, _, _ in port["members"]:
                self.emit(f"{token}.{member} = {self.observed().text};")
            self.emit(put.format(token))
        elif port["axis"]:
            token = self.fresh("t")
            self.emit(f"{port['type']} {token};")
            self.emit(f"{token}.data = {self.observed().text};")
            for member in ("keep", "strb", "user", "id", "dest"):
                self.emit(f"{token}.{member} = {r.choice(['0', '-1', '1', self.expression(1).text])};")
            self.emit(f"{token}.last = {self.condition(1).text};")
            self.emit(put.format(token))
        else:
            value = self.observed()
            width, signed = port["data"]
            if not port["type"].startswith("ap_"):
                value = Value(f"static_cast<{port['type']}>({value.as_ap().text})", width, signed)
            text = value.text if value.c_int or not port["type"].startswith("ap_") else value.text
            if index is not None or r.random() < 0.5:
                self.emit(put.format(text))
            else:
                self.emit(f"{name} << {port['type']}({text});" if port["type"].startswith("ap_") else
                          f"{name} << {text};")
