"""Random expressions over ap_int, ap_uint and C integers."""

from .values import C_TYPES, MAX_WIDTH, Value, type_name, width_class


class Expressions:
    # ---- small helpers ------------------------------------------------------------------------------------------
    def fresh(self, stem):
        self.counter += 1
        return f"{stem}{self.counter}"

    def hit(self, feature, width=None, signed=None):
        """Counts a feature for the statistics, with the class of the width it met and the sign."""
        where = "" if width is None else width_class(width) + ("" if signed is None else "s" if signed else "u")
        self.features[feature, where] = self.features.get((feature, where), 0) + 1

    def emit(self, text):
        self.lines.append("  " * self.indent + text)

    def width_up_to(self, widest):
        return self.r.choice([min(widest, 16), widest, self.r.choice([w for w in self.palette if w <= widest] or [1])])

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
            width = self.r.choice([self.any_type()[0], self.r.randint(33, MAX_WIDTH)])
            return value.cast(width, value.signed)
        return value

    def expression(self, depth):
        r = self.r
        if depth <= 0:
            return self.leaf()
        if self.small:
            depth = 1
        kinds = [("arithmetic", 26), ("multiply", 6), ("bitwise", 12), ("shift", 10), ("divide", 4), ("ternary", 8),
                 ("cast", 8), ("clamp", 4), ("range", 7), ("bit", 5), ("concat", 5), ("unary", 8), ("reduce", 2), ("c_int", 5),
                 ("table", 5 if self.tables else 0), ("helper", 5 if self.helpers else 0), ("compare", 4), ("leaf", 6)]
        kind = r.choices([k for k, _ in kinds], [w for _, w in kinds])[0]
        return self.limit(getattr(self, "make_" + kind)(depth - 1))

    def ap_operand(self, depth, widest=MAX_WIDTH):
        value = self.expression(depth).as_ap()
        if value.width > widest:
            value = value.cast(self.width_up_to(widest), value.signed)
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
        self.hit(op, max(a.width, b.width), a.signed or b.signed)
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
        self.hit("*", max(a.width, b.width), a.signed or b.signed)
        return Value(f"({a.text} * {b.text})", a.width + b.width, a.signed or b.signed, tainted=a.tainted or b.tainted)

    def make_clamp(self, depth):
        """A sum, difference or product that stays within what a type holds, or whether it does."""
        r = self.r
        a, b = self.pair(0)
        op = r.choice("+-*")
        if op == "*":
            a, b = (v.cast(self.width_up_to(20), v.signed) for v in (a, b))
        exact = f"({a.text} {op} {b.text})"
        width, signed = r.choice([8, 16, self.width_up_to(30)]), r.random() < 0.5
        low, high = (-(1 << (width - 1)), (1 << (width - 1)) - 1) if signed else (0, (1 << width) - 1)
        tainted = a.tainted or b.tainted
        self.hit("clamp " + op, width, signed)
        if r.random() < 0.3:
            return Value(f"({exact} > {high} || {exact} < {low})", 1, False, tainted=tainted, c_int=True)
        name = type_name(width, signed)
        return Value(f"({exact} > {high} ? {name}({high}) : {exact} < {low} ? {name}({low}) : {name}({exact}))", width,
                     signed, tainted=tainted)

    def make_bitwise(self, depth):
        a, b = self.pair(depth)
        op = self.r.choice("&|^")
        self.hit(op, max(a.width, b.width), a.signed or b.signed)
        return Value(f"({a.text} {op} {b.text})", self.join_width(a, b), a.signed or b.signed,
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
        self.hit(op + (" constant" if pick < 0.45 else ""), a.width, a.signed)
        return Value(f"({a.text} {op} {amount.text})", a.width, a.signed, tainted=a.tainted or amount.tainted)

    def make_divide(self, depth):
        r = self.r
        op = r.choice("/%")
        if r.random() < 0.25 and self.variable_divisions < 2:
            self.variable_divisions += 1
            a, b = self.ap_operand(depth, 40), self.ap_operand(min(depth, 1), 20)
            a = a.cast(min(a.width, 33), a.signed)
            divisor = f"{type_name(b.width, b.signed)}({b.text} | 1)"  # never 0
            self.hit(op, max(a.width, b.width), a.signed or b.signed)
            width = a.width + b.signed if op == "/" else min(a.width, b.width + (not b.signed and a.signed))
            return Value(f"({a.text} {op} {divisor})", width, a.signed or (op == "/" and b.signed),
                         tainted=a.tainted or b.tainted)
        a = self.ap_operand(depth, 40)
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
        self.hit(op + " constant", max(a.width, width), a.signed or signed)
        if op == "/":
            return Value(f"({a.text} / {text})", a.width + signed, a.signed or signed, tainted=a.tainted)
        return Value(f"({a.text} % {text})", min(a.width, width + (not signed and a.signed)), a.signed,
                     tainted=a.tainted)

    def make_ternary(self, depth):
        c = self.condition(depth)
        width, signed = self.any_type()
        a, b = self.expression(depth), self.expression(self.r.randint(0, depth))
        name = type_name(width, signed)
        self.hit("?:", width, signed)
        return Value(f"({c.text} ? {name}({a.text}) : {name}({b.text}))", width, signed,
                     tainted=a.tainted or b.tainted or c.tainted)

    def make_cast(self, depth):
        a = self.expression(depth)
        if self.r.random() < 0.75:
            result = a.cast(*self.any_type())
            self.hit("cast", result.width, result.signed)
            return result
        name = self.r.choice(list(C_TYPES))
        width, signed = C_TYPES[name]
        a = a.as_ap()
        self.hit("cast to " + name, a.width, a.signed)
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
                self.hit("range variable", a.width, a.signed)
                where = Value(f"{a.text}.range({at.text} + {size - 1}, {at.text})", a.width, False, proxy=True,
                              tainted=a.tainted or at.tainted)
                return where.cast(size, False)
        self.hit("range reversed" if pick < 0.3 and high != low else "range", a.width, a.signed)
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
        brackets = r.random() < 0.7
        self.hit("bit", a.width, a.signed)
        tainted = a.tainted or index.tainted
        if brackets and not index.text.isdigit():
            # g++ takes type(name[type(..)]) for the declaration of an array and complains about its size.
            return Value(f"((ap_uint<1>){a.text}[{index.text}])", 1, False, tainted=tainted)
        text = f"{a.text}[{index.text}]" if brackets else f"{a.text}.test({index.text})"
        return Value(text, 1, False, proxy=True, tainted=tainted).cast(1, False)

    def make_concat(self, depth):
        a = self.ap_operand(depth, 70)
        b = self.ap_operand(self.r.randint(0, depth), 60)
        text = f"({a.text}, {b.text})" if self.r.random() < 0.7 else f"{a.text}.concat({b.text})"
        value = Value(text, a.width + b.width, False, proxy=True, tainted=a.tainted or b.tainted)
        self.hit("concat", value.width)
        return value.cast(a.width + b.width, False)

    def make_unary(self, depth):
        a = self.ap_operand(depth)
        if self.r.random() < 0.5:
            self.hit("unary -", a.width, a.signed)
            return Value(f"(-{a.text})", a.width + 1, True, tainted=a.tainted)
        self.hit("~", a.width, a.signed)
        return Value(f"(~{a.text})", a.width, a.signed, tainted=a.tainted)

    def make_reduce(self, depth):
        a = self.ap_operand(depth)
        method = self.r.choice(["and_reduce", "or_reduce", "xor_reduce"])
        self.hit(method, a.width, a.signed)
        return Value(f"{a.text}.{method}()", 1, False, tainted=a.tainted, c_int=True)

    def make_compare(self, depth):
        return self.compare(depth)

    def compare(self, depth):
        a, b = self.pair(depth)
        op = self.r.choice(["<", "<=", ">", ">=", "==", "!="])
        self.hit(op, max(a.width, b.width), a.signed or b.signed)
        return Value(f"({a.text} {op} {b.text})", 1, False, tainted=a.tainted or b.tainted, c_int=True)

    def condition(self, depth):
        r = self.r
        pick = r.random()
        if pick < 0.6 or depth <= 0:
            return self.compare(max(0, depth))
        if pick < 0.75:
            a = self.ap_operand(depth - 1)
            # Not (bool(T(v))), which g++ takes for a cast to a function type, and what follows for its operand.
            return Value(f"static_cast<bool>({a.text})", 1, False, tainted=a.tainted, c_int=True)
        if pick < 0.85:
            a = self.condition(depth - 1)
            return Value(f"!{a.text}", 1, False, tainted=a.tainted, c_int=True)
        a, b = self.condition(depth - 1), self.condition(depth - 1)
        self.hit("&& ||")
        return Value(f"({a.text} {r.choice(['&&', '||'])} {b.text})", 1, False, tainted=a.tainted or b.tainted,
                     c_int=True)

    def make_table(self, depth):
        name, bits, width, signed = self.r.choice(self.tables)
        index = self.ap_operand(depth).cast(bits, False)
        self.hit("table", width, signed)
        # The + is for g++, which takes "(ap_uint<2>(table[i]) ..." for the beginning of a type and refuses its array's size.
        return Value(f"+{name}[{index.text}]", width, signed, tainted=index.tainted).cast(width, signed)

    def make_helper(self, depth):
        name, parameters, (width, signed), kind = self.r.choice(self.helpers)
        self.hit(kind, width, signed)
        arguments = [self.expression(self.r.randint(0, min(depth, 1))) for _ in parameters]
        texts = [f"{type_name(*p)}({a.text})" for p, a in zip(parameters, arguments)]
        return Value(f"{name}({', '.join(texts)})", width, signed, tainted=any(a.tainted for a in arguments))

    def make_c_int(self, depth):
        text, low, high, tainted = self.c_expression(min(depth, 2))
        self.hit("int arithmetic")
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
