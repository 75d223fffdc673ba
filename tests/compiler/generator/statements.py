"""Random statements: declarations, changes of variables, conditions, loops that are unrolled."""

from .expressions import Expressions
from .values import Value, Variable, type_name


class Statements(Expressions):
    # ---- statements ---------------------------------------------------------------------------------------------
    def declare(self, depth=3):
        """A new local value."""
        value = self.expression(depth)
        name = self.fresh("v")
        mutable = self.r.random() < 0.5
        if self.r.random() < 0.25 and not value.proxy and not value.c_int:
            self.emit(f"{'' if mutable else 'const '}auto {name} = {value.text};")
            variable = Variable(name, value.width, value.signed, value.tainted, mutable=False)
        else:
            width, signed = (value.width, value.signed) if self.r.random() < 0.4 else self.any_type()
            self.emit(f"{'' if mutable else 'const '}{type_name(width, signed)} {name} = {value.text};")
            variable = Variable(name, width, signed, value.tainted, mutable)
        self.scope.append(variable)
        return variable

    def assignable(self):
        return [v for v in self.scope if v.mutable and v.name.startswith("v")]

    def modify(self, condition_tainted=False):
        """A change of a local variable."""
        r = self.r
        targets = self.assignable()
        if not targets:
            return
        v = r.choice(targets)
        pick = r.random()
        tainted = condition_tainted
        if pick < 0.3:
            value = self.expression(2)
            self.emit(f"{v.name} = {value.text};")
            tainted |= value.tainted
        elif pick < 0.55:
            value = self.expression(1)
            op = r.choice(["+=", "-=", "&=", "|=", "^=", "*="])
            self.hit(op, v.width, v.signed)
            if op == "*=" and v.width > 40:
                op = "+="
            if op == "*=":
                value = value.cast(r.randint(2, 12), value.signed)
            self.emit(f"{v.name} {op} {value.text};")
            tainted |= value.tainted
        elif pick < 0.63:
            amount = self.expression(0).cast(r.randint(1, 6), False) if r.random() < 0.5 else Value(
                str(r.randint(0, v.width)), 32, True)
            op = r.choice(["<<=", ">>="])
            self.hit(op, v.width, v.signed)
            self.emit(f"{v.name} {op} {amount.text};")
            tainted |= amount.tainted
        elif pick < 0.7:
            self.hit("++ --", v.width, v.signed)
            self.emit(r.choice([f"++{v.name};", f"{v.name}++;", f"--{v.name};", f"{v.name}--;"]))
        elif pick < 0.8:
            value = self.expression(1)
            high = r.randrange(v.width)
            low = r.randint(0, high)
            self.hit("range =", v.width, v.signed)
            self.emit(f"{v.name}.range({high}, {low}) = {value.as_ap().text};")
            tainted |= value.tainted
        elif pick < 0.88:
            value = self.expression(1)
            if r.random() < 0.6 or v.width < 2:
                index = Value(str(r.randrange(v.width)), 32, True)
            else:
                index = self.expression(0).cast(r.randint(1, v.width.bit_length() - 1), False)
            self.hit("bit =", v.width, v.signed)
            self.emit(f"{v.name}[{index.text}] = {value.cast(1, False).text};")
            tainted |= value.tainted or index.tainted
        elif pick < 0.93:
            self.hit("reverse, rotate, set", v.width, v.signed)
            self.emit(r.choice([f"{v.name}.reverse();", f"{v.name}.lrotate({r.randrange(v.width)});",
                                f"{v.name}.rrotate({r.randrange(v.width)});",
                                f"{v.name}.invert({r.randrange(v.width)});", f"{v.name}.set({r.randrange(v.width)});",
                                f"{v.name}.clear({r.randrange(v.width)});"]))
        else:
            others = [o for o in targets if o is not v]
            if not others:
                return
            other = r.choice(others)
            value = self.expression(2)
            self.hit("concat =", v.width + other.width)
            self.emit(f"({v.name}, {other.name}) = {value.as_ap().text};")
            other.tainted |= value.tainted or condition_tainted
            tainted |= value.tainted
        v.tainted |= tainted

    def block(self, statements, condition_tainted):
        visible = len(self.scope)
        self.indent += 1
        for _ in range(statements):
            self.statement(condition_tainted)
        self.indent -= 1
        del self.scope[visible:]

    def statement(self, condition_tainted=False):
        r = self.r
        self.budget -= 1
        pick = r.random()
        deep = self.indent > 4
        if pick < 0.48 or not self.assignable():
            self.declare(r.randint(1, 3))
        elif pick < 0.7 or deep:
            self.modify(condition_tainted)
        elif pick < 0.82:
            self.hit("if")
            c = self.condition(2)
            self.emit(f"if ({c.text}) {{")
            self.block(r.randint(1, 3), condition_tainted or c.tainted)
            if r.random() < 0.5:
                self.emit("} else {")
                self.block(r.randint(1, 3), condition_tainted or c.tainted)
            self.emit("}")
        elif pick < 0.87:
            self.switch(condition_tainted)
        elif pick < 0.93:
            self.unrolled_loop(condition_tainted)
        elif pick < 0.97:
            self.local_array(condition_tainted)
        else:
            self.local_struct(condition_tainted)

    def local_array(self, condition_tainted):
        """A small array that lives for an iteration and is indexed at run time: registers with multiplexers."""
        r = self.r
        bits = r.randint(1, 3)
        width, signed = self.any_type()
        words = (1 << bits) + r.choice([0, 0, 1])
        name = self.fresh("array")
        self.hit("local array", width, signed)
        if r.random() < 0.5:
            self.emit(f"{type_name(width, signed)} {name}[{words}] = {{}};")
        else:
            self.emit(f"{type_name(width, signed)} {name}[{words}];")
            self.emit(f"for (int i = 0; i < {words}; ++i) {name}[i] = {self.expression(1).as_ap().text} + i;")
        if r.random() < 0.4:
            self.lines.append(f"#pragma HLS ARRAY_PARTITION variable={name} {r.choice(['complete', 'complete dim=1'])}")
        tainted = condition_tainted or not self.fast
        for _ in range(r.randint(1, 2)):
            index, value = self.ap_operand(1).cast(bits, False), self.expression(1)
            tainted |= index.tainted or value.tainted
            if r.random() < 0.3:
                c = self.condition(1)
                tainted |= c.tainted
                self.emit(f"if ({c.text}) {name}[{index.text}] = {value.text};")
            else:
                self.emit(f"{name}[{index.text}] {r.choice(['=', '=', '+=', '^='])} {value.text};")
        index = self.ap_operand(1).cast(bits, False)
        result = self.fresh("v")
        self.emit(f"{type_name(width, signed)} {result} = {name}[{index.text}];")
        # Its first contents may hang on anything: taken as tainted where that matters.
        self.scope.append(Variable(result, width, signed, tainted or index.tainted or self.fast, mutable=True))

    def local_struct(self, condition_tainted):
        """A struct with a nested one and an array, copied and passed by reference."""
        r = self.r
        kind = self.fresh("record")
        width, signed = self.any_type()
        other = self.any_type()
        name, copy = self.fresh("r"), self.fresh("r")
        self.hit("struct", width, signed)
        self.emit(f"struct {kind} {{")
        self.emit(f"  {type_name(width, signed)} a;")
        self.emit(f"  struct {{ {type_name(*other)} b[2]; bool c; }} inner;")
        self.emit(f"  {type_name(width, signed)} sum() const {{ return a + inner.b[0] - inner.b[1]; }}")
        self.emit("};")
        values = [self.expression(1) for _ in range(3)]
        texts = [f"{type_name(width, signed)}({values[0].text})", f"{type_name(*other)}({values[1].text})",
                 f"{type_name(*other)}({values[2].text})"]
        c = self.condition(1)
        self.emit(f"const {kind} {name} = {{{texts[0]}, {{{{{texts[1]}, {texts[2]}}}, {c.text}}}}};")
        self.emit(f"{kind} {copy} = {name};")
        self.emit(f"if ({copy}.inner.c) {copy}.inner.b[{r.randint(0, 1)}] {r.choice(['+=', '=', '^='])} "
                  f"{name}.inner.b[{r.randint(0, 1)}];")
        result = self.fresh("v")
        self.emit(f"{type_name(width, signed)} {result} = {copy}.sum();")
        tainted = condition_tainted or c.tainted or any(v.tainted for v in values)
        self.scope.append(Variable(result, width, signed, tainted, mutable=True))

    def switch(self, condition_tainted):
        r = self.r
        bits = r.randint(1, 3)
        self.hit("switch")
        selector = self.ap_operand(1).cast(bits, False)
        self.emit(f"switch (({selector.text}).to_uint()) {{")
        self.indent += 1
        cases = r.sample(range(1 << bits), r.randint(1, 1 << bits))
        for case in cases:
            self.emit(f"case {case}: {{")
            self.block(r.randint(1, 2), condition_tainted or selector.tainted)
            self.emit("}")
            if r.random() < 0.8:
                self.emit("  break;")
            else:
                self.emit("  [[fallthrough]];" if case != cases[-1] else "  break;")
        if r.random() < 0.6:
            self.emit("default: {")
            self.block(1, condition_tainted or selector.tainted)
            self.emit("} break;")
        self.indent -= 1
        self.emit("}")

    def unrolled_loop(self, condition_tainted):
        """A loop of constant trip count without stream accesses: becomes plain logic."""
        r = self.r
        targets = self.assignable()
        v = r.choice(targets)
        trips = r.randint(2, 5)
        self.hit("unrolled loop")
        k = self.fresh("k")
        source = self.expression(1).as_ap()
        self.emit(f"for (int {k} = 0; {k} < {trips}; {k}++) {{")
        if r.random() < 0.3:
            self.hit("pragma UNROLL")
            self.lines.append("#pragma HLS UNROLL")
        if source.width >= trips:
            term = f"{source.text}[{k}]" if r.random() < 0.5 else f"({source.text} >> {k})"
        else:  # no parentheses of its own: g++ takes "(ap_uint<4>(table[i])) + k" for a cast of + k
            term = f"({source.text} + {k})"
        if r.random() < 0.25:
            c = self.compare(1)
            self.hit("break, continue in a loop that is unrolled")
            self.emit(f"  if ({c.text}) {r.choice(['break', 'continue'])};")
            v.tainted |= c.tainted
        self.emit(f"  {v.name} {r.choice(['+=', '^=', '-='])} {term};")
        self.emit("}")
        v.tainted |= source.tainted or condition_tainted
