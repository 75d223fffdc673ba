"""Types, values and variables of random programs."""

import random

MAX_WIDTH = 200
# Every width of a value falls into one of these: the statistics tell which features met which widths.
WIDTH_CLASSES = ((1, 1), (2, 2), (3, 30), (31, 33), (34, 62), (63, 65), (66, 128), (129, 200), (201, 1000))
C_TYPES = {"bool": (1, False), "signed char": (8, True), "unsigned char": (8, False), "short": (16, True),
           "unsigned short": (16, False), "int": (32, True), "unsigned": (32, False), "long long": (64, True),
           "unsigned long long": (64, False)}


def type_name(width, signed):
    return f"{'ap_int' if signed else 'ap_uint'}<{width}>"


def width_class(width):
    low, high = next(c for c in WIDTH_CLASSES if c[0] <= width <= c[1])
    return str(low) if low == high else f"{low}-{high}"


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


# Neighbouring seeds, which are compiled together, have their widths in common: compiling is what takes time, and most of
# it goes into the operators of ap_int, one function for each pair of widths.
FAMILY = 200
# How many widths of which kind a family has, and how often a program takes one of that kind.
KINDS = (((1,), 1, 12), ((2,), 1, 8), (range(3, 17), 4, 55), (range(31, 34), 1, 10), (range(63, 66), 1, 7),
         (range(17, 49), 1, 4), (range(66, 131), 1, 2.5), ((127, 128, 129, *range(131, 191, 10), 191, 192, 193, 200), 1, 1.5))


def palette_of(seed, r, count):
    """The widths of one program, from those of its family."""
    family = random.Random(seed // FAMILY)
    widths, weights = [], []
    for kind, number, weight in KINDS:
        widths += (family.choice(kind) for _ in range(number))
        weights += [weight / number] * number
    return r.choices(widths, weights, k=count)
