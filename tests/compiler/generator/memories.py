"""What lives from one iteration to the next: states, shift registers, RAMs; tables and helper functions."""

from .statements import Statements
from .values import C_TYPES, Variable, type_name


class Memories(Statements):
    # ---- loop-carried state -------------------------------------------------------------------------------------
    def make_states(self, static_allowed):
        r = self.r
        for _ in range(r.randint(1, 2 if self.small else 4)):
            width, signed = self.any_type()
            recurrent = r.random() < 0.6
            if self.fast and recurrent:
                width = min(width, r.randint(1, 14))
            state = Variable(self.fresh("s"), width, signed, tainted=recurrent or not self.fast, mutable=False)
            state.recurrent = recurrent
            state.static = static_allowed and r.random() < 0.6
            state.initial = self.literal_text(min(width, 31), signed)
            self.hit("state static" if state.static else "state", width, signed)
            self.states.append(state)
        if r.random() < 0.35:  # a shift register
            width, signed = self.any_type()
            self.hit("shift register", width, signed)
            self.delay = (self.fresh("delay"), r.randint(2, 6), width, signed, static_allowed and r.random() < 0.6)
        else:
            self.delay = None

    def update_state(self, index):
        """In a fast program, a state depends on those before it and, by one small operation, on itself."""
        r = self.r
        s = self.states[index]
        own = s.name
        keep_scope = self.scope
        if self.fast:
            # Only what does not hang on this state or a later one.
            banned = {t.name for t in self.states[index:]}
            self.scope = [v for v in self.scope if v.name not in banned and not v.tainted]
            self.scope += [t for t in self.states[:index]]
        value = self.expression(2)
        value = value.cast(s.width, s.signed) if r.random() < 0.7 else value.as_ap()
        if self.fast and value.width > s.width:
            value = value.cast(s.width, s.signed)
        c = self.condition(1) if r.random() < 0.4 else None
        self.scope = keep_scope
        name = type_name(s.width, s.signed)
        if not s.recurrent:
            text = f"{own} = {value.text};"
        elif not self.fast:
            self.allow_taint = True
            text = f"{own} = {self.expression(3).text};" if r.random() < 0.6 else f"{own} += {value.text};"
        else:
            text = r.choice([f"{own} += {value.text};", f"{own} -= {value.text};", f"{own} ^= {value.text};",
                             f"{own}++;", f"{own} = ({own} << 1) | {value.cast(1, False).text};",
                             f"{own} = {value.text} < {own} ? {value.cast(s.width, s.signed).text} : {own};",
                             f"{own} = {name}({value.text} - {own});"])
        if c is not None:
            self.emit(f"if ({c.text}) {text}")
        else:
            self.emit(text)

    def make_tables(self):
        r = self.r
        out = []
        for _ in range(r.choice([0, 0, 0, 0, 1] if self.small else [0, 0, 1, 1, 2])):
            name = self.fresh("table")
            bits = r.randint(2, 6)
            if r.random() < 0.7:
                width, signed = min(self.any_type()[0], 40), r.random() < 0.5
                type_text = type_name(width, signed)
            else:
                type_text = r.choice(["short", "unsigned char", "int", "unsigned"])
                width, signed = C_TYPES[type_text]
            # one word more than the index reaches at times: a length that is no power of two
            words = (1 << bits) + (r.randint(1, 3) if r.random() < 0.3 else 0)
            values = []
            for _ in range(words):
                value = self.literal_text(min(width, 32), signed)
                values.append(str(value) + ("u" if value > 0x7fffffff else ""))
            if width == 32 and signed:
                values = [str(r.randint(-(1 << 30), 1 << 30)) for _ in values]
            qualifier = r.choice(["static const", "const", "constexpr", "static constexpr"])
            self.hit(f"table {'of C integers' if type_text in C_TYPES else qualifier}", width, signed)
            out.append(f"{qualifier} {type_text} {name}[{words}] = {{{', '.join(values)}}};")
            self.tables.append((name, bits, width, signed))
        return out

    def helper_body(self, parameters, result):
        """Statements of a function of parameters a0, a1, ...: into self.lines, with what was there before returned."""
        keep_lines, keep_scope, self.lines = self.lines, self.scope, []
        self.scope = [Variable(f"a{i}", w, s, mutable=False) for i, (w, s) in enumerate(parameters)]
        for _ in range(self.r.randint(0, 2)):
            self.declare(2)
        if self.r.random() < 0.4:
            self.hit("early return")
            c = self.condition(1)
            self.emit(f"if ({c.text}) return {self.expression(1).cast(*result).text};")
        self.emit(f"return {self.expression(2).cast(*result).text};")
        body, self.lines, self.scope = self.lines, keep_lines, keep_scope
        return body

    def make_helpers(self):
        """Functions, function templates and functors beside the top."""
        out = []
        for _ in range(self.r.choice([0, 0, 0, 0, 1] if self.small else [0, 0, 1, 2])):
            name = self.fresh("helper")
            parameters = [self.any_type() for _ in range(self.r.randint(1, 3))]
            result = self.any_type()
            kind = self.r.choice(["function", "function", "function template", "functor"])
            body = self.helper_body(parameters, result)
            texts = ", ".join(f"{type_name(w, s)} a{i}" for i, (w, s) in enumerate(parameters))
            called = name
            if kind == "function template":
                out.append("template <int W, class T>")
                out.append(f"static {type_name(*result)} {name}(T a0{''.join(',' + t for t in texts.split(',')[1:])}) {{")
                out += body
                # the template's own width takes part, too
                out[-1] = out[-1].replace("return ", f"return {type_name(*result)}(ap_int<W>(a0) ^ ", 1)[:-1] + ");"
                out.append("}")
                called = f"{name}<{self.any_type()[0]}>"
            elif kind == "functor":
                width, signed = self.any_type()
                out.append(f"struct {name}_t {{")
                out.append(f"  {type_name(width, signed)} k;")
                out.append(f"  {type_name(*result)} operator()({texts}) const {{")
                out += ["  " + line for line in body]
                out[-1] = out[-1].replace("return ", f"return {type_name(*result)}(k + ", 1)[:-1] + ");"
                out += ["  }", "};"]
                called = f"{name}_t{{{self.ap_literal(width, signed).text}}}"
            else:
                out.append(f"static {type_name(*result)} {name}({texts}) {{")
                out += body
                out.append("}")
            self.helpers.append((called, parameters, result, "call of a " + kind))
        return out

    def make_lambda(self):
        """A lambda in the top, which may capture what is known before the loop."""
        name = self.fresh("helper")
        parameters = [self.any_type() for _ in range(self.r.randint(1, 2))]
        result = self.any_type()
        body = self.helper_body(parameters, result)
        texts = ", ".join(f"{type_name(w, s)} a{i}" for i, (w, s) in enumerate(parameters))
        capture = self.r.choice(["", "&", "="])
        self.emit(f"const auto {name} = [{capture}]({texts}) -> {type_name(*result)} {{")
        self.lines += ["  " + line for line in body]
        self.emit("};")
        self.helpers.append((name, parameters, result, "call of a lambda"))

    def make_ram(self, shape):
        r = self.r
        bits = r.randint(5, 7)
        width, signed = self.any_type()
        words = (1 << bits) + (r.randint(1, 9) if r.random() < 0.3 else 0)
        static = shape == "call" or r.random() < 0.5
        if static and r.random() < 0.4:  # initial contents
            self.hit("RAM with initial contents", width, signed)
            values = [str(self.literal_text(min(width, 31), signed)) for _ in range(r.randint(1, words))]
            self.emit(f"static {type_name(width, signed)} ram[{words}] = {{{', '.join(values)}}};")
            self.ram = (bits, width, signed, False)
            return
        self.emit(f"{'static ' if static else ''}{type_name(width, signed)} ram[{words}];")
        guarded = shape == "call" or r.random() < 0.5
        self.hit("RAM", width, signed)
        if guarded:
            self.emit(f"{'static ' if static else ''}ap_uint<{bits}> fill = 0;")
            self.emit(f"{'static ' if static else ''}bool full = false;")
        else:
            self.emit(f"for (int i = 0; i < {1 << bits}; ++i) {{")
            self.lines.append("#pragma HLS PIPELINE II=1")
            self.emit(f"  ram[i] = i * {r.randint(0, 300)};")
            self.emit("}")
        self.ram = (bits, width, signed, guarded)

    def ram_read(self):
        bits, width, signed, guarded = self.ram
        r = self.r
        index = self.ap_operand(1).cast(bits, False)
        name = self.fresh("v")
        word = type_name(width, signed)
        self.hit("RAM read", width, signed)
        if guarded:
            at = self.fresh("at")
            self.emit(f"const ap_uint<{bits}> {at} = {index.text};")
            self.emit(f"{word} {name} = full || {at} < fill ? {word}(ram[{at}]) : {word}({r.randint(0, 1)});")
        else:
            self.emit(f"{word} {name} = ram[{index.text}];")
        tainted = index.tainted or not self.fast or guarded
        return Variable(name, width, signed, tainted=tainted)

    def ram_write(self):
        bits, width, signed, guarded = self.ram
        r = self.r
        value = self.expression(2)
        c = self.condition(1) if r.random() < 0.4 else None
        if c is not None:
            self.emit(f"if ({c.text}) {{")
            self.indent += 1
        if guarded:
            self.emit(f"ram[fill] = {value.text};")
            self.emit("fill++;")
            self.emit("if (fill == 0) full = true;")
            self.hit("RAM write", width, signed)
        else:
            index = self.ap_operand(1).cast(bits, False)
            if r.random() < 0.25 and (not self.fast or width <= 12):
                self.hit("RAM read, changed, written", width, signed)
                small = value.cast(min(width, 12), value.signed)
                self.emit(f"ram[{index.text}] {r.choice(['+=', '^=', '|='])} {small.text};")
            elif r.random() < 0.1 and width > 1:
                self.hit("RAM part of a word", width, signed)
                high = r.randrange(width)
                self.emit(f"ram[{index.text}].range({high}, {r.randint(0, high)}) = {value.as_ap().text};")
            else:
                self.hit("RAM write", width, signed)
                self.emit(f"ram[{index.text}] = {value.text};")
        if c is not None:
            self.indent -= 1
            self.emit("}")
