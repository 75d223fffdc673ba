#!/usr/bin/env python3
"""Writes random, well-defined streaming programs in the style of HLS kernels, with drivers for their native run.

random_program.py SEED FOLDER        writes FOLDER/random_SEED.cpp (the program) and FOLDER/random_SEED.drive.cpp

The same seed gives the same text. A program never does what C++ leaves undefined: every object is initialised, indices are
masked into range, C integers stay within their type, divisors are constants other than 0, and RAM words are written before their
content matters.

Programs come in two classes. In a "fast" one (6 ns) no loop-carried value feeds back through more than one small operation, as
people write kernels for a real clock; everything else may be as deep as it likes. In a "slow" one anything may feed back into
anything, and the clock is slow enough to allow it.
"""

import pathlib
import random
import sys

MAX_WIDTH = 132
C_TYPES = {"bool": (1, False), "signed char": (8, True), "unsigned char": (8, False), "short": (16, True),
           "unsigned short": (16, False), "int": (32, True), "unsigned": (32, False), "long long": (64, True),
           "unsigned long long": (64, False)}


def type_name(width, signed):
    return f"{'ap_int' if signed else 'ap_uint'}<{width}>"


class Value:
    """An expression: its text, an upper bound of its width, its sign and how it may be used."""

    def __init__(self, text, width, signed, proxy=False, tainted=False, c_int=False):
        self.text, self.width, self.signed = text, width, signed
        self.proxy = proxy  # a range or bit of another object: no `auto`, no member calls
        self.tainted = tainted  # depends on loop-carried values that feed back
        self.c_int = c_int  # a plain C++ integer: needs a cast before member calls and ap-only operators

    def cast(self, width, signed):
        return Value(f"{type_name(width, signed)}({self.text})", width, signed, tainted=self.tainted)

    def as_ap(self):
        return self.cast(self.width, self.signed) if self.c_int or self.proxy else self


class Variable:
    def __init__(self, name, width, signed, tainted=False, mutable=True):
        self.name, self.width, self.signed, self.tainted, self.mutable = name, width, signed, tainted, mutable

    def value(self):
        return Value(self.name, self.width, self.signed, tainted=self.tainted)


class Generator:
    def __init__(self, seed):
        self.seed = seed
        self.r = random.Random(seed * 2654435761 % (1 << 31) + 17)
        self.name = f"random_{seed}"
        self.fast = self.r.random() < 0.5
        self.lines = []
        self.indent = 1
        self.scope = []  # variables readable here
        self.states = []  # loop-carried variables, in the order in which they may depend on each other
        self.tables = []  # (name, index bits, width, signed)
        self.helpers = []  # (name, parameter types, result type)
        self.counter = 0
        self.budget = self.r.randint(8, 32)  # statements
        self.palette = [self.width() for _ in range(6)]  # few widths a program: every one costs compile time
        self.allow_taint = True
        self.used_wide_multiply = 0

    # ---- small helpers ------------------------------------------------------------------------------------------
    def fresh(self, stem):
        self.counter += 1
        return f"{stem}{self.counter}"

    def emit(self, text):
        self.lines.append("  " * self.indent + text)

    def width(self):
        r = self.r
        pick = r.random()
        if pick < 0.12:
            return 1
        if pick < 0.2:
            return 2
        if pick < 0.75:
            return r.randint(3, 16)
        if pick < 0.85:
            return r.randint(31, 33)
        if pick < 0.92:
            return r.randint(63, 65)
        if pick < 0.96:
            return r.randint(17, 48)
        return r.randint(66, 130)

    def any_type(self):
        return self.r.choice(self.palette), self.r.random() < 0.5

    def literal_text(self, width, signed):
        """A constant that fits the type, often an extreme one."""
        low = -(1 << (width - 1)) if signed else 0
        high = (1 << (width - 1)) - 1 if signed else (1 << width) - 1
        pick = self.r.random()
        if pick < 0.2:
            value = low
        elif pick < 0.4:
            value = high
        elif pick < 0.6:
            value = max(low, min(high, self.r.randint(-3, 3)))
        else:
            value = self.r.randint(low, high)
        return value

    def c_literal(self):
        r = self.r
        pick = r.random()
        if pick < 0.55:
            value = r.choice([0, 1, 2, 3, 5, 7, 8, 10, 15, 16, 100, 127, 128, 255, 256, 1000, 65535, 2147483647])
            if r.random() < 0.3 and value:
                return Value(f"(-{value})", 32, True, c_int=True)
            return Value(str(value), 32, True, c_int=True)
        if pick < 0.75:
            return Value(f"{r.randint(0, 0xffffffff)}u", 32, False, c_int=True)
        if pick < 0.88:
            value = r.randint(-(1 << 62), 1 << 62)
            return Value(f"({value}LL)", 64, True, c_int=True)
        return Value(f"{r.randint(0, (1 << 64) - 1)}ULL", 64, False, c_int=True)

    def ap_literal(self, width=None, signed=None):
        if width is None:
            width, signed = self.any_type()
        value = self.literal_text(width, signed)
        if -(1 << 31) <= value < (1 << 31):
            text = f"{type_name(width, signed)}({value})"
        elif 0 <= value < (1 << 64):
            text = f"{type_name(width, signed)}({value}ULL)"
        elif -(1 << 63) < value < 0:
            text = f"{type_name(width, signed)}({value}LL)"
        else:
            bits = value & ((1 << width) - 1)
            pieces, rest = [], width
            while rest > 0:
                size = rest % 60 or 60
                rest -= size
                pieces.append(f"ap_uint<{size}>({(bits >> rest) & ((1 << size) - 1)}ULL)")
            text = pieces[0]
            for piece in pieces[1:]:
                text = f"({text}, {piece})"
            text = f"{type_name(width, signed)}(ap_uint<{width}>({text}))"
        return Value(text, width, signed)

    # ---- expressions --------------------------------------------------------------------------------------------
    def usable(self):
        return [v for v in self.scope if self.allow_taint or not v.tainted]

    def leaf(self):
        r = self.r
        variables = self.usable()
        pick = r.random()
        if variables and pick < 0.88:
            # recent variables more often, so that programs are deep rather than wide
            index = max(r.randrange(len(variables)), r.randrange(len(variables)))
            return variables[index].value()
        if pick < 0.95:
            return self.c_literal()
        return self.ap_literal()

    def limit(self, value):
        if value.width > MAX_WIDTH:
            width = self.r.choice([self.width(), self.r.randint(33, MAX_WIDTH)])
            return value.cast(width, value.signed)
        return value

    def expression(self, depth):
        r = self.r
        if depth <= 0:
            return self.leaf()
        kinds = [("arithmetic", 26), ("multiply", 6), ("bitwise", 12), ("shift", 10), ("divide", 4), ("ternary", 8),
                 ("cast", 8), ("range", 7), ("bit", 5), ("concat", 5), ("unary", 8), ("reduce", 2), ("c_int", 5),
                 ("table", 5 if self.tables else 0), ("helper", 5 if self.helpers else 0), ("compare", 4), ("leaf", 6)]
        kind = r.choices([k for k, _ in kinds], [w for _, w in kinds])[0]
        return self.limit(getattr(self, "make_" + kind)(depth - 1))

    def ap_operand(self, depth, widest=MAX_WIDTH):
        value = self.expression(depth).as_ap()
        if value.width > widest:
            value = value.cast(r_width(self.r, widest), value.signed)
        return value

    def pair(self, depth):
        """Two operands, at least one of them an ap type."""
        a, b = self.expression(depth), self.expression(self.r.randint(0, depth))
        if a.c_int and b.c_int:
            a = a.as_ap()
        if a.proxy and b.c_int:
            a = a.as_ap()
        if b.proxy and a.c_int:
            b = b.as_ap()
        return (a, b) if self.r.random() < 0.7 else (b, a)

    def join_width(self, a, b):
        return max(a.width + (b.signed and not a.signed), b.width + (a.signed and not b.signed))

    def make_leaf(self, depth):
        return self.leaf()

    def make_arithmetic(self, depth):
        a, b = self.pair(depth)
        op = self.r.choice("+-")
        return Value(f"({a.text} {op} {b.text})", self.join_width(a, b) + 1, op == "-" or a.signed or b.signed,
                     tainted=a.tainted or b.tainted)

    def make_multiply(self, depth):
        a, b = self.pair(depth)
        limit = 34
        if self.used_wide_multiply < 1 and self.r.random() < 0.1:
            limit = 65
            self.used_wide_multiply += 1
        if a.width > limit:
            a = a.cast(self.r.randint(2, 20), a.signed)
        if b.width > limit:
            b = b.cast(self.r.randint(2, 20), b.signed)
        return Value(f"({a.text} * {b.text})", a.width + b.width, a.signed or b.signed, tainted=a.tainted or b.tainted)

    def make_bitwise(self, depth):
        a, b = self.pair(depth)
        return Value(f"({a.text} {self.r.choice('&|^')} {b.text})", self.join_width(a, b), a.signed or b.signed,
                     tainted=a.tainted or b.tainted)

    def make_shift(self, depth):
        r = self.r
        a = self.ap_operand(depth)
        op = r.choice(["<<", ">>"])
        pick = r.random()
        if pick < 0.45:
            amount = Value(str(r.choice([0, 1, 2, 3, 7, r.randint(0, a.width + 3)])), 32, True)
        elif pick < 0.85:
            amount = self.ap_operand(min(depth, 1)).cast(r.randint(1, 7), False)
        else:
            amount = self.ap_operand(min(depth, 1)).cast(r.randint(2, 5), True)
        return Value(f"({a.text} {op} {amount.text})", a.width, a.signed, tainted=a.tainted or amount.tainted)

    def make_divide(self, depth):
        r = self.r
        a = self.ap_operand(depth, 40)
        op = r.choice("/%")
        if r.random() < 0.5:
            number = r.choice([1, 2, 3, 5, 7, 10, 16, 60, 255, 1000, r.randint(1, 70000)])
            text, width, signed = str(number), 32, True
            if r.random() < 0.3:
                text = f"(-{number})"
            elif r.random() < 0.3:
                text, signed = f"{number}u", False
        else:
            width, signed = r.randint(2, 20), r.random() < 0.5
            number = r.randint(1, (1 << (width - signed)) - 1)
            if signed and r.random() < 0.5:
                number = -number
            text = f"{type_name(width, signed)}({number})"
        if op == "/":
            return Value(f"({a.text} / {text})", a.width + signed, a.signed or signed, tainted=a.tainted)
        return Value(f"({a.text} % {text})", min(a.width, width + (not signed and a.signed)), a.signed,
                     tainted=a.tainted)

    def make_ternary(self, depth):
        c = self.condition(depth)
        width, signed = self.any_type()
        a, b = self.expression(depth), self.expression(self.r.randint(0, depth))
        name = type_name(width, signed)
        return Value(f"({c.text} ? {name}({a.text}) : {name}({b.text}))", width, signed,
                     tainted=a.tainted or b.tainted or c.tainted)

    def make_cast(self, depth):
        a = self.expression(depth)
        if self.r.random() < 0.75:
            return a.cast(*self.any_type())
        name = self.r.choice(list(C_TYPES))
        width, signed = C_TYPES[name]
        a = a.as_ap()
        if name == "bool":
            return Value(f"({a.text} != 0)", 1, False, tainted=a.tainted, c_int=True)
        if name in ("int", "unsigned", "long long", "unsigned long long") and self.r.random() < 0.5:
            method = {"int": "to_int", "unsigned": "to_uint", "long long": "to_int64",
                      "unsigned long long": "to_uint64"}[name]
            return Value(f"{a.text}.{method}()", width, signed, tainted=a.tainted, c_int=True)
        return Value(f"static_cast<{name}>({a.text})", width, signed, tainted=a.tainted, c_int=True)

    def make_range(self, depth):
        r = self.r
        a = self.ap_operand(depth)
        high = r.randrange(a.width)
        low = r.randint(0, high)
        pick = r.random()
        if pick < 0.12 and a.width >= 8:
            size = r.randint(1, a.width // 2)
            room = a.width - size
            bits = max(1, (room + 1).bit_length() - 1)
            at = self.ap_operand(0).cast(bits, False)
            if (1 << bits) - 1 <= room:
                where = Value(f"{a.text}.range({at.text} + {size - 1}, {at.text})", a.width, False, proxy=True,
                              tainted=a.tainted or at.tainted)
                return where.cast(size, False)
        spelled = "range" if r.random() < 0.6 else ""
        if pick < 0.3:  # high and low swapped: reversed bits
            text = f"{a.text}.range({low}, {high})"
        else:
            text = f"{a.text}.range({high}, {low})" if spelled else f"{a.text}({high}, {low})"
        value = Value(text, a.width, False, proxy=True, tainted=a.tainted)
        return value if r.random() < 0.2 else value.cast(high - low + 1, False)

    def make_bit(self, depth):
        r = self.r
        a = self.ap_operand(depth)
        if r.random() < 0.6 or a.width < 2:
            index = Value(str(r.randrange(a.width)), 32, True)
        else:
            index = self.ap_operand(0).cast(r.randint(1, a.width.bit_length() - 1), False)
        text = f"{a.text}[{index.text}]" if r.random() < 0.7 else f"{a.text}.test({index.text})"
        return Value(text, 1, False, proxy=True, tainted=a.tainted or index.tainted).cast(1, False)

    def make_concat(self, depth):
        a = self.ap_operand(depth, 70)
        b = self.ap_operand(self.r.randint(0, depth), 60)
        text = f"({a.text}, {b.text})" if self.r.random() < 0.7 else f"{a.text}.concat({b.text})"
        value = Value(text, a.width + b.width, False, proxy=True, tainted=a.tainted or b.tainted)
        return value.cast(a.width + b.width, False)

    def make_unary(self, depth):
        a = self.ap_operand(depth)
        if self.r.random() < 0.5:
            return Value(f"(-{a.text})", a.width + 1, True, tainted=a.tainted)
        return Value(f"(~{a.text})", a.width, a.signed, tainted=a.tainted)

    def make_reduce(self, depth):
        a = self.ap_operand(depth)
        method = self.r.choice(["and_reduce", "or_reduce", "xor_reduce"])
        return Value(f"{a.text}.{method}()", 1, False, tainted=a.tainted, c_int=True)

    def make_compare(self, depth):
        return self.compare(depth)

    def compare(self, depth):
        a, b = self.pair(depth)
        op = self.r.choice(["<", "<=", ">", ">=", "==", "!="])
        return Value(f"({a.text} {op} {b.text})", 1, False, tainted=a.tainted or b.tainted, c_int=True)

    def condition(self, depth):
        r = self.r
        pick = r.random()
        if pick < 0.6 or depth <= 0:
            return self.compare(max(0, depth))
        if pick < 0.75:
            a = self.ap_operand(depth - 1)
            return Value(f"bool({a.text})", 1, False, tainted=a.tainted, c_int=True)
        if pick < 0.85:
            a = self.condition(depth - 1)
            return Value(f"!{a.text}", 1, False, tainted=a.tainted, c_int=True)
        a, b = self.condition(depth - 1), self.condition(depth - 1)
        return Value(f"({a.text} {r.choice(['&&', '||'])} {b.text})", 1, False, tainted=a.tainted or b.tainted,
                     c_int=True)

    def make_table(self, depth):
        name, bits, width, signed = self.r.choice(self.tables)
        index = self.ap_operand(depth).cast(bits, False)
        return Value(f"{name}[{index.text}]", width, signed, tainted=index.tainted).cast(width, signed)

    def make_helper(self, depth):
        name, parameters, (width, signed) = self.r.choice(self.helpers)
        arguments = [self.expression(self.r.randint(0, min(depth, 1))) for _ in parameters]
        texts = [f"{type_name(*p)}({a.text})" for p, a in zip(parameters, arguments)]
        return Value(f"{name}({', '.join(texts)})", width, signed, tainted=any(a.tainted for a in arguments))

    def make_c_int(self, depth):
        text, low, high, tainted = self.c_expression(min(depth, 2))
        return Value(text, 32, True, tainted=tainted, c_int=True)

    def c_expression(self, depth):
        """A C `int` expression with the interval of its values, kept within 31 bits."""
        r = self.r
        if depth <= 0 or r.random() < 0.2:
            variables = self.usable()
            if variables and r.random() < 0.75:
                v = r.choice(variables)
                width, signed = r.randint(1, 14), r.random() < 0.5
                low = -(1 << (width - 1)) if signed else 0
                return f"static_cast<int>({type_name(width, signed)}({v.name}))", low, low + (1 << width) - 1, v.tainted
            number = r.choice([0, 1, 2, 3, 5, 8, 13, 64, 255, 4095])
            return str(number), number, number, False
        a, alow, ahigh, at = self.c_expression(depth - 1)
        pick = r.random()
        if pick < 0.12:
            divisor = r.choice([1, 2, 3, 7, 10, 16, 255])
            if r.random() < 0.5:
                return f"({a} / {divisor})", min(alow, 0), max(ahigh, 0), at
            return f"({a} % {divisor})", -(divisor - 1) if alow < 0 else 0, divisor - 1 if ahigh > 0 else 0, at
        if pick < 0.2:
            amount = r.randint(0, 9)
            return f"({a} >> {amount})", alow >> amount, ahigh >> amount, at
        b, blow, bhigh, bt = self.c_expression(r.randint(0, depth - 1))
        tainted = at or bt
        op = r.choice("+-*&|^<?")
        if op == "+":
            result = f"({a} + {b})", alow + blow, ahigh + bhigh, tainted
        elif op == "-":
            result = f"({a} - {b})", alow - bhigh, ahigh - blow, tainted
        elif op == "*":
            corners = [x * y for x in (alow, ahigh) for y in (blow, bhigh)]
            result = f"({a} * {b})", min(corners), max(corners), tainted
        elif op == "<":
            result = f"({a} {r.choice(['<', '>=', '=='])} {b})", 0, 1, tainted
        elif op == "?":
            result = f"({a} > {b} ? {a} : {b})", max(alow, blow), max(ahigh, bhigh), tainted
        else:
            bits = max(abs(alow), abs(ahigh), abs(blow), abs(bhigh)).bit_length()
            result = f"({a} {op} {b})", -(1 << bits), (1 << bits) - 1, tainted
        if result[1] < -(1 << 31) + 1 or result[2] > (1 << 31) - 1:
            return a, alow, ahigh, at
        return result

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
            if op == "*=" and v.width > 40:
                op = "+="
            if op == "*=":
                value = value.cast(r.randint(2, 12), value.signed)
            self.emit(f"{v.name} {op} {value.text};")
            tainted |= value.tainted
        elif pick < 0.63:
            amount = self.expression(0).cast(r.randint(1, 6), False) if r.random() < 0.5 else Value(
                str(r.randint(0, v.width)), 32, True)
            self.emit(f"{v.name} {r.choice(['<<=', '>>='])} {amount.text};")
            tainted |= amount.tainted
        elif pick < 0.7:
            self.emit(r.choice([f"++{v.name};", f"{v.name}++;", f"--{v.name};", f"{v.name}--;"]))
        elif pick < 0.8:
            value = self.expression(1)
            high = r.randrange(v.width)
            low = r.randint(0, high)
            self.emit(f"{v.name}.range({high}, {low}) = {value.as_ap().text};")
            tainted |= value.tainted
        elif pick < 0.88:
            value = self.expression(1)
            if r.random() < 0.6 or v.width < 2:
                index = Value(str(r.randrange(v.width)), 32, True)
            else:
                index = self.expression(0).cast(r.randint(1, v.width.bit_length() - 1), False)
            self.emit(f"{v.name}[{index.text}] = {value.cast(1, False).text};")
            tainted |= value.tainted or index.tainted
        elif pick < 0.93:
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

    def statement(self, condition_tainted=False, nested=True):
        r = self.r
        self.budget -= 1
        pick = r.random()
        deep = self.indent > 4
        if pick < 0.5 or not self.assignable():
            self.declare(r.randint(1, 3))
        elif pick < 0.75 or deep:
            self.modify(condition_tainted)
        elif pick < 0.87:
            c = self.condition(2)
            self.emit(f"if ({c.text}) {{")
            self.block(r.randint(1, 3), condition_tainted or c.tainted)
            if r.random() < 0.5:
                self.emit("} else {")
                self.block(r.randint(1, 3), condition_tainted or c.tainted)
            self.emit("}")
        elif pick < 0.93:
            self.switch(condition_tainted)
        else:
            self.unrolled_loop(condition_tainted)

    def switch(self, condition_tainted):
        r = self.r
        bits = r.randint(1, 3)
        selector = self.ap_operand(1).cast(bits, False)
        self.emit(f"switch ({selector.text}.to_uint()) {{")
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
        k = self.fresh("k")
        source = self.expression(1).as_ap()
        self.emit(f"for (int {k} = 0; {k} < {trips}; {k}++) {{")
        if r.random() < 0.3:
            self.lines.append("#pragma HLS UNROLL")
        if source.width >= trips:
            term = f"{source.text}[{k}]" if r.random() < 0.5 else f"(({source.text}) >> {k})"
        else:
            term = f"(({source.text}) + {k})"
        if r.random() < 0.25:
            c = self.compare(1)
            self.emit(f"  if ({c.text}) break;")
            v.tainted |= c.tainted
        self.emit(f"  {v.name} {r.choice(['+=', '^=', '-='])} {term};")
        self.emit("}")
        v.tainted |= source.tainted or condition_tainted

    # ---- loop-carried state -------------------------------------------------------------------------------------
    def make_states(self, static_allowed):
        r = self.r
        for _ in range(r.randint(1, 4)):
            width, signed = self.any_type()
            recurrent = r.random() < 0.6
            if self.fast and recurrent:
                width = min(width, r.randint(1, 14))
            state = Variable(self.fresh("s"), width, signed, tainted=recurrent or not self.fast, mutable=False)
            state.recurrent = recurrent
            state.static = static_allowed and r.random() < 0.6
            state.initial = self.literal_text(min(width, 31), signed)
            self.states.append(state)
        if r.random() < 0.35:  # a shift register
            width, signed = self.any_type()
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

    # ---- whole programs -----------------------------------------------------------------------------------------
    def make_tables(self):
        r = self.r
        out = []
        for _ in range(r.choice([0, 0, 1, 1, 2])):
            name = self.fresh("table")
            bits = r.randint(2, 6)
            if r.random() < 0.7:
                width, signed = min(self.width(), 40), r.random() < 0.5
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
            out.append(f"{qualifier} {type_text} {name}[{words}] = {{{', '.join(values)}}};")
            self.tables.append((name, bits, width, signed))
        return out

    def make_helpers(self):
        out = []
        for _ in range(self.r.choice([0, 0, 1, 2])):
            name = self.fresh("helper")
            parameters = [self.any_type() for _ in range(self.r.randint(1, 3))]
            result = self.any_type()
            self.scope = [Variable(f"a{i}", w, s, mutable=False) for i, (w, s) in enumerate(parameters)]
            self.lines = []
            for _ in range(self.r.randint(0, 2)):
                self.declare(2)
            if self.r.random() < 0.4:
                c = self.condition(1)
                self.emit(f"if ({c.text}) return {self.expression(1).cast(*result).text};")
            self.emit(f"return {self.expression(2).cast(*result).text};")
            texts = ", ".join(f"{type_name(w, s)} a{i}" for i, (w, s) in enumerate(parameters))
            out.append(f"static {type_name(*result)} {name}({texts}) {{")
            out += self.lines
            out.append("}")
            self.scope = []
            self.helpers.append((name, parameters, result))
        self.lines = []
        return out

    def generate(self):
        r = self.r
        shape = r.choices(["call", "counted", "nested", "until_last", "phases", "packets"], [25, 25, 15, 15, 10, 10])[0]
        self.shape = shape
        head = self.make_tables()
        head += self.make_helpers()

        # ports
        inputs, outputs = [], []
        for i in range(r.choice([1, 1, 2, 2, 3])):
            inputs.append(self.make_port(f"in{i}", True, axis=shape == "until_last" and i == 0))
        for i in range(r.choice([1, 1, 2, 3])):
            outputs.append(self.make_port(f"out{i}", False, axis=r.random() < 0.2))
        structs = []
        for port in inputs + outputs:
            if port["members"]:
                fields = " ".join(f"{type_name(w, s)} {n};" for n, w, s in port["members"])
                structs.append(f"struct {port['struct']} {{ {fields} }};")
        scalars = []
        if shape in ("counted", "nested"):
            scalars.append(("rows", r.choice([("ap_uint<5>", 5, False), ("int", 32, True), ("unsigned char", 8, False),
                                              ("ap_int<7>", 7, True)]), (0, 12)))
        if shape == "nested":
            scalars.append(("cols", r.choice([("ap_uint<4>", 4, False), ("unsigned", 32, False), ("short", 16, True)]),
                            (0, 9)))
        if scalars or r.random() < 0.3:
            for i in range(r.randint(0, 2)):
                width, signed = self.any_type()
                if r.random() < 0.3:
                    text = r.choice(["bool", "int", "unsigned char", "short", "unsigned long long"])
                    width, signed = C_TYPES[text]
                else:
                    text = type_name(width, signed)
                scalars.append((f"arg{i}", (text, width, signed), None))
        self.scalars = scalars
        results = []
        if shape != "call" and r.random() < 0.3:
            width, signed = self.any_type()
            results.append(("total", width, signed))

        body_static = True
        self.make_states(body_static)
        for name, (text, width, signed), _ in scalars:
            self.scope.append(Variable(name if text.startswith("ap_") else f"{type_name(width, signed)}({name})",
                                       width, signed, mutable=False))
        # the iteration counter: read conditions are cheap functions of it
        self.tick_static = shape == "call" or r.random() < 0.5
        self.tick = Variable("tick", 8, False, tainted=not self.fast, mutable=False)
        self.scope.append(self.tick)

        parameters = [f"hls::stream<{p['type']}>& {p['name']}" for p in inputs + outputs]
        parameters += [f"{t[0]} {n}" for n, t, _ in scalars]
        parameters += [f"{type_name(w, s)}& {n}" for n, w, s in results]

        if shape == "call":
            self.lines.append("#pragma HLS PIPELINE II=1")
        for state in self.states:
            if shape == "call":
                state.static = True
            keyword = "static " if state.static else ""
            self.emit(f"{keyword}{type_name(state.width, state.signed)} {state.name} = {state.initial};")
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
                self.lines.append(f"#pragma HLS ARRAY_PARTITION variable={name} complete")
        self.scope += self.states
        self.ram = None
        if r.random() < 0.45:
            self.make_ram(shape)
        if results:
            self.emit(f"{type_name(results[0][1], results[0][2])} result = 0;")

        conditional_inputs = inputs[1:]
        if shape == "call":
            self.iteration(inputs, outputs, conditional_inputs, results)
        elif shape == "counted":
            counter_type = r.choice(["ap_uint<8>", "int", "unsigned"])
            limit = "rows" if counter_type == "int" or scalars[0][1][0].startswith("ap_") and counter_type == "ap_uint<8>" \
                else "static_cast<unsigned>(rows)"
            if counter_type == "int":
                limit = "int(rows)"
            if counter_type == "ap_uint<8>":
                limit = "ap_uint<8>(rows)"
            self.emit(f"for ({counter_type} i = 0; i < {limit}; ++i) {{")
            self.loop_pragma()
            self.iteration(inputs, outputs, conditional_inputs, results, counter="i", counter_type=counter_type)
            self.emit("}")
        elif shape == "nested":
            self.emit("for (ap_uint<6> i = 0; i < ap_uint<6>(rows); ++i) {")
            self.indent += 1
            if r.random() < 0.3:
                local = self.fresh("w")
                width, signed = self.any_type()
                if self.fast:
                    width = min(width, 12)
                value = self.expression(1) if not self.fast else self.ap_literal(width, signed)
                self.emit(f"{type_name(width, signed)} {local} = {value.text};")
                self.row_state = (local, width, signed)
            else:
                self.row_state = None
            self.emit("for (ap_uint<5> j = 0; j < ap_uint<5>(cols); ++j) {")
            self.loop_pragma()
            self.scope.append(Variable("j", 5, False, mutable=False))
            self.iteration(inputs, outputs, conditional_inputs, results, counter="i", counter_type="ap_uint<6>",
                           row_state=self.row_state)
            self.emit("}")
            self.indent -= 1
            self.emit("}")
        elif shape == "until_last":
            form = r.choice(["do", "while"])
            self.emit("bool last = false;")
            self.emit("do {" if form == "do" else "while (!last) {")
            self.loop_pragma()
            self.iteration(inputs, outputs, conditional_inputs, results, last=True)
            self.emit("} while (!last);" if form == "do" else "}")
        elif shape == "phases":
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
        else:  # packets: the first token says how many follow
            first = inputs[0]
            self.emit(f"const {first['type']} header = in0.read();")
            source = "header" if not first["members"] else f"header.{first['members'][0][0]}"
            if first["axis"]:
                source = "header.data"
            self.emit(f"const ap_uint<4> count = {source};")
            self.emit("for (ap_uint<5> i = 0; i < count; ++i) {")
            self.loop_pragma()
            self.iteration(inputs, outputs, conditional_inputs, results, counter="i", counter_type="ap_uint<5>")
            self.emit("}")
        if results:
            self.emit("total = result;")

        text = ["// Written by random_program.py, seed " + str(self.seed) + ".",
                f"// epiline-hls: --clock {'6ns' if self.fast else '200ns'}",
                '#include "ap_axi_sdata.h"', '#include "ap_int.h"', '#include "hls_stream.h"', ""]
        text += structs + head
        text.append("")
        text.append(f"void {self.name}({', '.join(parameters)}) {{")
        for port in inputs + outputs:
            if r.random() < 0.3:
                text.append(f"#pragma HLS INTERFACE axis port={port['name']}")
        text += self.lines
        text.append("}")
        return "\n".join(text) + "\n", self.driver(inputs, outputs, scalars, results)

    def make_port(self, name, is_input, axis):
        r = self.r
        port = {"name": name, "members": [], "axis": axis, "input": is_input}
        if axis:
            width = r.choice([8, 16, 32, 64])
            signed = r.random() < 0.3
            port["type"] = f"{'ap_axis' if signed else 'ap_axiu'}<{width}, {r.randint(1, 3)}, 1, 1>"
            port["data"] = (width, signed)
        elif r.random() < 0.25:
            port["struct"] = f"{name}_{self.seed}_t"
            port["type"] = port["struct"]
            port["members"] = [(f"m{i}",) + self.any_type() for i in range(r.randint(1, 3))]
        elif r.random() < 0.15:
            port["type"] = r.choice(["unsigned char", "short", "int", "unsigned", "unsigned long long"])
            port["data"] = C_TYPES[port["type"]]
        else:
            port["data"] = self.any_type()
            port["type"] = type_name(*port["data"])
        return port

    def loop_pragma(self):
        if self.r.random() < 0.8:
            self.lines.append("#pragma HLS PIPELINE II=1")
        if self.r.random() < 0.2:
            self.lines.append("#pragma HLS LOOP_TRIPCOUNT min=1 max=16")

    def make_ram(self, shape):
        r = self.r
        bits = r.randint(5, 7)
        width, signed = self.any_type()
        words = (1 << bits) + (r.randint(1, 9) if r.random() < 0.3 else 0)
        static = shape == "call" or r.random() < 0.5
        self.emit(f"{'static ' if static else ''}{type_name(width, signed)} ram[{words}];")
        guarded = shape == "call" or r.random() < 0.5
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
        else:
            index = self.ap_operand(1).cast(bits, False)
            self.emit(f"ram[{index.text}] = {value.text};")
        if c is not None:
            self.indent -= 1
            self.emit("}")

    def read_port(self, port, name):
        r = self.r
        style = r.random()
        if style < 0.5:
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
            if port in conditional and r.random() < 0.6:
                condition = self.cheap_condition()
                if data_dependent and port is not inputs[0]:
                    condition = f"{self.compare(1).text} || tick == {r.randint(0, 3)}"
                style = r.random()
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
        condition = None
        pick = r.random()
        if pick < 0.2:
            # never always false: a port that is never written is refused
            condition = f"{self.condition(2).text} || tick == {r.randint(0, 3)}"
        elif pick < 0.4:
            condition = self.cheap_condition()
        if condition:
            self.emit(f"if ({condition}) {{")
            self.indent += 1
        name = port["name"]
        if port["members"]:
            token = self.fresh("t")
            self.emit(f"{port['type']} {token};")
            for member, _, _ in port["members"]:
                self.emit(f"{token}.{member} = {self.observed().text};")
            self.emit(f"{name}.write({token});")
        elif port["axis"]:
            token = self.fresh("t")
            self.emit(f"{port['type']} {token};")
            self.emit(f"{token}.data = {self.observed().text};")
            for member in ("keep", "strb", "user", "id", "dest"):
                self.emit(f"{token}.{member} = {r.choice(['0', '-1', '1', self.expression(1).text])};")
            self.emit(f"{token}.last = {self.condition(1).text};")
            self.emit(f"{name}.write({token});")
        else:
            value = self.observed()
            width, signed = port["data"]
            if not port["type"].startswith("ap_"):
                value = Value(f"static_cast<{port['type']}>({value.as_ap().text})", width, signed)
            text = value.text if value.c_int or not port["type"].startswith("ap_") else value.text
            if r.random() < 0.5:
                self.emit(f"{name}.write({text});")
            else:
                self.emit(f"{name} << {port['type']}({text});" if port["type"].startswith("ap_") else
                          f"{name} << {text};")
        if condition:
            self.indent -= 1
            self.emit("}")

    # ---- the native run -----------------------------------------------------------------------------------------
    def driver(self, inputs, outputs, scalars, results):
        r = self.r
        calls = {"call": 120, "counted": 16, "nested": 8, "until_last": 12, "phases": 5, "packets": 16}[self.shape]
        lines = ["#include \"drive.hpp\"", f"namespace program_{self.name} {{", f'#include "{self.name}.cpp"', "}",
                 f"using namespace program_{self.name};"]
        for port in inputs + outputs:
            if port["members"]:
                leaves = ", ".join(f"v.{n}" for n, _, _ in port["members"])
                lines.append(f"EPILINE_LEAVES(program_{self.name}::{port['struct']}, {leaves});")
        lines.append(f"EPILINE_DRIVER({self.name}) {{")
        for port in inputs:
            lines.append(f'  auto& {port["name"]} = s.input<{port["type"]}>("{port["name"]}");')
        for port in outputs:
            lines.append(f'  auto& {port["name"]} = s.output<{port["type"]}>("{port["name"]}");')
        lines.append(f"  for (int call = 0; call < {calls}; ++call) {{")
        # More tokens than a call can read; what is left at the end is taken back.
        for port in inputs:
            if port["axis"] and self.shape == "until_last" and port is inputs[0]:
                lines.append("    const auto beats = s.number(1, 12);")
                lines.append("    for (int i = 0; i < beats; ++i) {")
                lines.append(f'      auto beat = s.any<{port["type"]}>();')
                lines.append("      beat.last = i + 1 == beats;")
                lines.append(f'      {port["name"]}.push(beat);')
                lines.append("    }")
            else:
                most = {"call": 2, "counted": 16, "nested": 128, "until_last": 16, "phases": 64, "packets": 20}[self.shape]
                lines.append(f'    while ({port["name"]}.stream.size() < {most}) '
                             f'{port["name"]}.push(s.any<{port["type"]}>());')
        arguments = []
        for name, (text, width, signed), bound in scalars:
            if bound:
                lines.append(f"    const auto {name} = static_cast<{text}>(s.number({bound[0]}, {bound[1]}));")
            else:
                lines.append(f"    const auto {name} = s.any<{text}>();")
            arguments.append(f'{{"{name}", {name}}}')
        if arguments:
            lines.append(f"    s.call({{{', '.join(arguments)}}});")
        for name, width, signed in results:
            lines.append(f"    {type_name(width, signed)} {name} = 0;")
        call = [f"{p['name']}.stream" for p in inputs + outputs] + [n for n, _, _ in scalars] + [n for n, _, _ in results]
        lines.append(f"    {self.name}({', '.join(call)});")
        for name, _, _ in results:
            lines.append(f'    s.result("{name}", {name});')
        lines.append("  }")
        for port in inputs:
            lines.append(f"  {port['name']}.take_back();")
        lines.append("}")
        return "\n".join(lines) + "\n"


def r_width(r, widest):
    return r.choice([min(widest, 16), widest, r.randint(1, widest)])


def write(seed, folder):
    program, driver = Generator(seed).generate()
    (folder / f"random_{seed}.cpp").write_text(program, encoding="utf-8")
    (folder / f"random_{seed}.drive.cpp").write_text(driver, encoding="utf-8")


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__.split("\n\n")[1])
    folder = pathlib.Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    write(int(sys.argv[1]), folder)


if __name__ == "__main__":
    main()
