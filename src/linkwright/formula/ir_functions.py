"""Functions of a module in LLVM intermediate representation: vectors of one width, sine to arc tangent, look-ups.

Polynomials and reductions are those of fdlibm (Sun Microsystems, 1993), whose errors are below one unit in the last
place. Lanes with arguments too large for the reduction, or too small, go to the C library, one by one.
"""

from __future__ import annotations

import struct
from collections.abc import Callable, Mapping, Sequence

from linkwright.formula.table import HEAD


class Lanes:
    """Types of vectors of so many lanes, and instructions for them."""

    def __init__(self, width: int) -> None:
        self.width = width
        self.vector, self.integers = f"<{width} x double>", f"<{width} x i64>"
        self.mask, self.pointers = f"<{width} x i1>", f"<{width} x ptr>"
        self.all_true = self.same("i1", "true")

    def same(self, kind: str, value: object) -> str:
        """The same constant in all lanes."""
        return f"<{', '.join([f'{kind} {value}'] * self.width)}>"

    def numbers(self) -> str:
        """0, 1, 2, … as a constant vector."""
        return f"<{', '.join(f'i64 {lane}' for lane in range(self.width))}>"

    def spread(self, scalar: str, name: str, kind: str) -> list[str]:
        """Instructions that put a scalar into all lanes of ``name``."""
        vector = f"<{self.width} x {kind}>"
        lanes = f"<{self.width} x i32> zeroinitializer"
        return [
            f"{name}.0 = insertelement {vector} poison, {kind} {scalar}, i32 0",
            f"{name} = shufflevector {vector} {name}.0, {vector} poison, {lanes}",
        ]

    def gather(self, name: str, base: str, offset: str) -> list[str]:
        """The numbers at ``base`` + ``offset``, lane by lane."""
        return [
            f"{name}.at = getelementptr double, ptr {base}, {self.integers} {offset}",
            f"{name} = call {self.vector} @llvm.masked.gather.{self._suffix}({self.pointers} {name}.at, i32 8, "
            f"{self.mask} {self.all_true}, {self.vector} zeroinitializer)",
        ]

    @property
    def _suffix(self) -> str:
        return f"v{self.width}f64.v{self.width}p0"


#: Prefix of the functions; the function's name in the C library follows.
VECTOR = "linkwright_vector_"
#: Beyond it, multiples of a quarter turn are no longer exact.
_LARGEST = 1e5
_HUGE = 1e300
#: Adding it rounds to an integer, which is then in the last bits.
_ROUND = 6755399441055744.0
_QUARTERS = 6.36619772367581382433e-01
#: π/2 in parts of 33 bits.
_PARTS = (1.57079632673412561417e00, 6.07710050630396597660e-11, 2.02226624879595063154e-21)
_SINE = (
    -1.66666666666666324348e-01,
    8.33333333332248946124e-03,
    -1.98412698298579493134e-04,
    2.75573137070700676789e-06,
    -2.50507602534068634195e-08,
    1.58969099521155010221e-10,
)
_COSINE = (
    4.16666666666666019037e-02,
    -1.38888888888741095749e-03,
    2.48015872894767294178e-05,
    -2.75573143513906633035e-07,
    2.08757232129817482790e-09,
    -1.13596475577881948265e-11,
)
_ARC = (
    3.33333333333329318027e-01,
    -1.99999999998764832476e-01,
    1.42857142725034663711e-01,
    -1.11111104054623557880e-01,
    9.09088713343650656196e-02,
    -7.69187620504482999495e-02,
    6.66107313738753120669e-02,
    -5.83357013379057348645e-02,
    4.97687799461593236017e-02,
    -3.65315727442169155270e-02,
    1.62858201153657823623e-02,
)
#: Arc tangents of 0, 0.5, 1, 1.5 and infinity, and what these doubles lack.
_KNOWN = (
    0.0,
    4.63647609000806093515e-01,
    7.85398163397448278999e-01,
    9.82793723247329054082e-01,
    1.57079632679489655800e00,
)
_LACK = (
    0.0,
    2.26987774529616870924e-17,
    3.06161699786838301793e-17,
    1.39033110312309984516e-17,
    6.12323399573676603587e-17,
)
#: Ratios below which the arc is taken from these.
_BELOW = (0.4375, 0.6875, 1.1875, 2.4375)
_PI, _PI_LACK = 3.14159265358979311600, 1.2246467991473531772e-16


def number(value: float) -> str:
    """A double as LLVM writes it exactly."""
    return "0x" + struct.pack(">d", value).hex().upper()


def vector_functions(body: list[str], width: int) -> list[str]:
    """The functions that the instructions of a module call."""
    calls = "".join(line for line in body if VECTOR in line)
    wanted = [name for name in _WRITERS if f"@{VECTOR}{name}(" in calls]
    return [line for name in wanted for line in _WRITERS[name](_Lanes(name, width))]


class _Lanes(Lanes):
    """Writes one function of vectors."""

    def __init__(self, name: str, width: int) -> None:
        super().__init__(width)
        self.name, self.count = name, 0
        self.lines: list[str] = []

    def put(self, text: str) -> str:
        """A new value."""
        self.count += 1
        self.lines.append(f"%t{self.count} = {text}")
        return f"%t{self.count}"

    def all(self, value: float) -> str:
        """A number in all lanes."""
        return self.same("double", number(value))

    def integer(self, value: int) -> str:
        """An integer in all lanes."""
        return self.same("i64", value)

    def add(self, a: str, b: str) -> str:
        return self.put(f"fadd {self.vector} {a}, {b}")

    def sub(self, a: str, b: str) -> str:
        return self.put(f"fsub {self.vector} {a}, {b}")

    def mul(self, a: str, b: str) -> str:
        return self.put(f"fmul {self.vector} {a}, {b}")

    def div(self, a: str, b: str) -> str:
        return self.put(f"fdiv {self.vector} {a}, {b}")

    def neg(self, a: str) -> str:
        return self.put(f"fneg {self.vector} {a}")

    def below(self, a: str, b: str) -> str:
        return self.put(f"fcmp olt {self.vector} {a}, {b}")

    def choose(self, mask: str, a: str, b: str) -> str:
        return self.put(f"select {self.mask} {mask}, {self.vector} {a}, {self.vector} {b}")

    def size(self, a: str) -> str:
        return self.put(f"call {self.vector} @llvm.fabs.v{self.width}f64({self.vector} {a})")

    def bits(self, a: str) -> str:
        return self.put(f"bitcast {self.vector} {a} to {self.integers}")

    def series(self, z: str, factors: Sequence[float]) -> str:
        """Factors times powers of z; products and sums may be fused."""
        found = self.all(factors[-1])
        for factor in reversed(factors[:-1]):
            product = self.put(f"fmul contract {self.vector} {found}, {z}")
            found = self.put(f"fadd contract {self.vector} {product}, {self.all(factor)}")
        return found

    def function(self, arguments: Sequence[str], far: str, values: Mapping[str, str]) -> list[str]:
        """The text of a function of all these values, by their names in the C library, which finds them for lanes
        where ``far`` holds."""
        parameters = ", ".join(f"{self.vector} {each}" for each in arguments)
        result = f"{{ {', '.join([self.vector] * len(values))} }}"
        code = [
            f"define internal {result} @{VECTOR}{self.name}({parameters}) nounwind {{",
            "entry:",
            *self.lines,
            f"%bits = bitcast {self.mask} {far} to i{self.width}",
            f"%any = icmp ne i{self.width} %bits, 0",
            "br i1 %any, label %slow, label %done",
            "slow:",
        ]
        for lane in range(self.width):
            for k, each in enumerate(arguments):
                code.append(f"%x{lane}.{k} = extractelement {self.vector} {each}, i32 {lane}")
            places = ", ".join(f"double %x{lane}.{k}" for k in range(len(arguments)))
            for name in values:
                code += [
                    f"%{name}{lane} = call double @linkwright_{name}({places})",
                    f"%{name}.l{lane} = insertelement {self.vector} {f'%{name}.l{lane - 1}' if lane else 'poison'}, "
                    f"double %{name}{lane}, i32 {lane}",
                ]
        for name, value in values.items():
            last = f"{self.vector} %{name}.l{self.width - 1}"
            code.append(f"%{name}.slowly = select {self.mask} {far}, {last}, {self.vector} {value}")
        code += ["br label %done", "done:"]
        found = "poison"
        for name, value in values.items():
            code.append(f"%{name}.found = phi {self.vector} [ {value}, %entry ], [ %{name}.slowly, %slow ]")
        for k, name in enumerate(values):
            code.append(f"%all{k} = insertvalue {result} {found}, {self.vector} %{name}.found, {k}")
            found = f"%all{k}"
        return [*code, f"ret {result} {found}", "}"]


_Writer = Callable[[_Lanes], list[str]]


def _circle(w: _Lanes) -> list[str]:
    """Sine and cosine of what is left of a quarter turn, in two parts."""
    scaled = w.mul("%x", w.all(_QUARTERS))
    shifted = w.add(scaled, w.all(_ROUND))
    quarters = w.sub(shifted, w.all(_ROUND))
    first = w.sub("%x", w.mul(quarters, w.all(_PARTS[0])))
    second = w.mul(quarters, w.all(_PARTS[1]))
    left = w.sub(first, second)
    lost = w.sub(w.sub(first, left), second)
    third = w.sub(w.mul(quarters, w.all(_PARTS[2])), lost)
    r = w.sub(left, third)
    rest = w.sub(w.sub(left, r), third)
    z = w.mul(r, r)
    cube = w.mul(z, r)
    half = w.mul(z, w.all(0.5))
    high = w.series(z, _SINE[1:])
    inner = w.sub(w.mul(w.all(0.5), rest), w.mul(cube, high))
    sine = w.sub(r, w.sub(w.sub(w.mul(z, inner), rest), w.mul(cube, w.all(_SINE[0]))))
    square = w.mul(z, w.series(z, _COSINE))
    near = w.sub(w.all(1.0), half)
    gone = w.sub(w.sub(w.all(1.0), near), half)
    cosine = w.add(near, w.add(gone, w.sub(w.mul(z, square), w.mul(r, rest))))
    place = w.bits(shifted)
    odd = w.put(f"and {w.integers} {place}, {w.integer(1)}")
    across = w.put(f"icmp ne {w.integers} {odd}, zeroinitializer")
    values = {
        "sin": _turned(w, w.choose(across, cosine, sine), place),
        "cos": _turned(w, w.choose(across, sine, cosine), w.put(f"add {w.integers} {place}, {w.integer(1)}")),
    }
    return w.function(["%x"], w.below(w.all(_LARGEST), w.size("%x")), values)


def _turned(w: _Lanes, value: str, place: str) -> str:
    """A value with its sign changed in the second half of four quarters."""
    two = w.put(f"and {w.integers} {place}, {w.integer(2)}")
    sign = w.put(f"shl {w.integers} {two}, {w.integer(62)}")
    turned = w.put(f"xor {w.integers} {w.bits(value)}, {sign}")
    return w.put(f"bitcast {w.integers} {turned} to {w.vector}")


def _arc(w: _Lanes, a: str, b: str) -> str:
    """The angle of (b, a) in the first quarter, both above or equal to zero."""
    top, bottom = w.neg(b), a
    known, lack = w.all(_KNOWN[4]), w.all(_LACK[4])
    forms = ((0.0, 1.0), (0.5, 2.0), (1.0, 1.0), (1.5, 1.0))
    for k in (3, 2, 1, 0):
        ratio, scale = forms[k]
        at = w.all(ratio * scale)
        upper = a if not k else w.sub(a if scale == 1.0 else w.mul(a, w.all(scale)), w.mul(b, at))
        denominator = b if not k else w.add(b if scale == 1.0 else w.mul(b, w.all(scale)), w.mul(a, at))
        inside = w.below(a, w.mul(b, w.all(_BELOW[k])))
        top, bottom = w.choose(inside, upper, top), w.choose(inside, denominator, bottom)
        known, lack = w.choose(inside, w.all(_KNOWN[k]), known), w.choose(inside, w.all(_LACK[k]), lack)
    x = w.div(top, bottom)
    bend = w.mul(x, w.mul(w.mul(x, x), w.series(w.mul(x, x), _ARC)))
    return w.sub(known, w.sub(w.sub(bend, lack), x))


def _signed(w: _Lanes, value: str, like: str) -> str:
    """A value above or equal to zero with the sign of another."""
    sign = w.put(f"and {w.integers} {w.bits(like)}, {w.integer(-(2**63))}")
    joined = w.put(f"or {w.integers} {w.bits(value)}, {sign}")
    return w.put(f"bitcast {w.integers} {joined} to {w.vector}")


def _arc_tangent(w: _Lanes) -> list[str]:
    size = w.size("%x")
    far = w.put(f"fcmp ugt {w.vector} {size}, {w.all(_HUGE)}")
    return w.function(["%x"], far, {"atan": _signed(w, _arc(w, size, w.all(1.0)), "%x")})


def _angle(w: _Lanes) -> list[str]:
    a, b = w.size("%y"), w.size("%x")
    both = w.add(a, b)
    large = w.put(f"fcmp ugt {w.vector} {both}, {w.all(_HUGE)}")
    far = w.put(f"or {w.mask} {large}, {w.below(both, w.all(1.0 / _HUGE))}")
    arc = _arc(w, a, b)
    behind = w.sub(w.all(_PI), w.sub(arc, w.all(_PI_LACK)))
    left = w.put(f"icmp slt {w.integers} {w.bits('%x')}, zeroinitializer")
    return w.function(["%y", "%x"], far, {"atan2": _signed(w, w.choose(left, behind, arc), "%y")})


_WRITERS: dict[str, _Writer] = {"circle": _circle, "atan": _arc_tangent, "atan2": _angle}
#: The functions of the C library that each of them finds.
FORMS = {"circle": ("sin", "cos"), "atan": ("atan",), "atan2": ("atan2",)}
IN_LANES = {name: form for form, names in FORMS.items() for name in names}


#: Prefix of the functions; the order of the derivative follows.
LOOKUP = "linkwright_lookup"


def lookup_functions(body: list[str], width: int) -> list[str]:
    """The functions that the instructions of a module call."""
    orders = [k for k in range(4) if any(f"@{LOOKUP}{k}(" in line for line in body)]
    return [line for order in orders for line in _function(order, width)]


def _function(order: int, width: int) -> list[str]:
    """Operations in the order of :meth:`Table.__call__`, none fused, so that the bits are the same."""
    w = Lanes(width)
    return [
        f"define internal {w.vector} @{LOOKUP}{order}(ptr %table, {w.vector} %x) nounwind {{",
        "entry:",
        *(f"%at{k} = getelementptr double, ptr %table, i64 {k}" for k in range(HEAD)),
        *(f"%h{k} = load double, ptr %at{k}, align 8" for k in range(HEAD)),
        "%pieces = fptosi double %h0 to i64",
        *(line for k in (1, 2, 4) for line in w.spread(f"%h{k}", f"%s{k}", "double")),
        "%periodic = fcmp une double %h3, 0.0",
        f"%from = fsub {w.vector} %x, %s1",
        f"%share = fdiv {w.vector} %from, %s2",
        f"%laps = call {w.vector} @llvm.floor.v{width}f64({w.vector} %share)",
        f"%turned = fmul {w.vector} %laps, %s2",
        f"%within = fsub {w.vector} %x, %turned",
        f"%y = select i1 %periodic, {w.vector} %within, {w.vector} %x",
        f"%breaks = getelementptr double, ptr %table, i64 {HEAD}",
        "%behind = add i64 %pieces, 1",
        "%rows = getelementptr double, ptr %breaks, i64 %behind",
        "br label %search",
        "search:",
        "%left = phi i64 [ %pieces, %entry ], [ %rest, %halve ]",
        f"%piece = phi {w.integers} [ zeroinitializer, %entry ], [ %next, %halve ]",
        "%more = icmp sgt i64 %left, 1",
        "br i1 %more, label %halve, label %found",
        "halve:",
        "%half = lshr i64 %left, 1",
        *w.spread("%half", "%half.all", "i64"),
        f"%probe = add {w.integers} %piece, %half.all",
        *w.gather("%break", "%breaks", "%probe"),
        f"%right = fcmp ole {w.vector} %break, %y",
        f"%next = select {w.mask} %right, {w.integers} %probe, {w.integers} %piece",
        "%rest = sub i64 %left, %half",
        "br label %search",
        "found:",
        *w.gather("%low", "%breaks", "%piece"),
        f"%u = fsub {w.vector} %y, %low",
        f"%row = mul {w.integers} %piece, {w.same('i64', 4)}",
        *(line for k in range(min(order, 3), 4) for line in _coefficient(w, k)),
        *_polynomial(order, w),
        f"ret {w.vector} %value",
        "}",
    ]


def _polynomial(order: int, w: Lanes) -> list[str]:
    def times(name: str, a: str, b: str) -> str:
        return f"{name} = fmul {w.vector} {a}, {b}"

    def plus(name: str, a: str, b: str) -> str:
        return f"{name} = fadd {w.vector} {a}, {b}"

    if order == 0:
        return [
            *(times("%p3", "%u", "%c3"), plus("%q2", "%c2", "%p3"), times("%p2", "%u", "%q2")),
            *(plus("%q1", "%c1", "%p2"), times("%p1", "%u", "%q1"), plus("%q0", "%c0", "%p1")),
            *(times("%gain", "%laps", "%s4"), plus("%high", "%q0", "%gain")),
            f"%value = select i1 %periodic, {w.vector} %high, {w.vector} %q0",
        ]
    three, two, six = (w.same("double", number) for number in ("3.0", "2.0", "6.0"))
    if order == 1:
        return [
            *(times("%t3", three, "%c3"), times("%p3", "%u", "%t3"), times("%t2", two, "%c2")),
            *(plus("%q2", "%t2", "%p3"), times("%p2", "%u", "%q2"), plus("%value", "%c1", "%p2")),
        ]
    if order == 2:
        return [
            *(times("%t3", six, "%c3"), times("%p3", "%u", "%t3"), times("%t2", two, "%c2")),
            plus("%value", "%t2", "%p3"),
        ]
    zero = w.same("double", "0.0")
    return [times("%t3", six, "%c3"), times("%nothing", zero, "%u"), plus("%value", "%t3", "%nothing")]


def _coefficient(w: Lanes, power: int) -> list[str]:
    """Coefficient ``power`` of every lane's piece."""
    place = f"%place{power} = add {w.integers} %row, {w.same('i64', power)}"
    return [place, *w.gather(f"%c{power}", "%rows", f"%place{power}")]
