"""Look-ups in tables as functions of a module: binary search in all lanes, then a cubic."""

from __future__ import annotations

from linkwright.engine.table import HEAD

#: Prefix of the functions; the order of the derivative follows.
LOOKUP = "linkwright_lookup"


def lookup_functions(body: list[str], width: int) -> list[str]:
    """The functions that the instructions of a module call."""
    orders = [k for k in range(4) if any(f"@{LOOKUP}{k}(" in line for line in body)]
    return [line for order in orders for line in _function(order, width)]


def _function(order: int, width: int) -> list[str]:
    """Operations in the order of :meth:`Table.__call__`, none fused, so that the bits are the same."""
    w = _Lanes(width)
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
        f"%whole = call {w.vector} @llvm.floor.v{width}f64({w.vector} %share)",
        f"%turned = fmul {w.vector} %whole, %s2",
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
        f"%row = mul {w.integers} %piece, {w.all('i64', '4')}",
        *(line for k in range(min(order, 3), 4) for line in w.coefficient(k)),
        *_polynomial(order, w),
        f"ret {w.vector} %value",
        "}",
    ]


def _polynomial(order: int, w: _Lanes) -> list[str]:
    def times(name: str, a: str, b: str) -> str:
        return f"{name} = fmul {w.vector} {a}, {b}"

    def plus(name: str, a: str, b: str) -> str:
        return f"{name} = fadd {w.vector} {a}, {b}"

    if order == 0:
        return [
            *(times("%p3", "%u", "%c3"), plus("%q2", "%c2", "%p3"), times("%p2", "%u", "%q2")),
            *(plus("%q1", "%c1", "%p2"), times("%p1", "%u", "%q1"), plus("%q0", "%c0", "%p1")),
            *(times("%gain", "%whole", "%s4"), plus("%high", "%q0", "%gain")),
            f"%value = select i1 %periodic, {w.vector} %high, {w.vector} %q0",
        ]
    three, two, six = (w.all("double", number) for number in ("3.0", "2.0", "6.0"))
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
    zero = w.all("double", "0.0")
    return [times("%t3", six, "%c3"), times("%nothing", zero, "%u"), plus("%value", "%t3", "%nothing")]


class _Lanes:
    """Vectors of one width."""

    def __init__(self, width: int) -> None:
        self.width = width
        self.vector, self.integers = f"<{width} x double>", f"<{width} x i64>"
        self.mask, self.pointers = f"<{width} x i1>", f"<{width} x ptr>"

    def all(self, kind: str, value: str) -> str:
        """The same constant in all lanes."""
        return f"<{', '.join([f'{kind} {value}'] * self.width)}>"

    def spread(self, scalar: str, name: str, kind: str) -> list[str]:
        """A scalar put into all lanes of ``name``."""
        vector = f"<{self.width} x {kind}>"
        lanes = f"<{self.width} x i32> zeroinitializer"
        return [
            f"{name}.0 = insertelement {vector} poison, {kind} {scalar}, i32 0",
            f"{name} = shufflevector {vector} {name}.0, {vector} poison, {lanes}",
        ]

    def gather(self, name: str, base: str, offset: str) -> list[str]:
        """The numbers at ``base`` + ``offset``, lane by lane."""
        suffix = f"v{self.width}f64.v{self.width}p0"
        return [
            f"{name}.at = getelementptr double, ptr {base}, {self.integers} {offset}",
            f"{name} = call {self.vector} @llvm.masked.gather.{suffix}({self.pointers} {name}.at, i32 8, "
            f"{self.mask} {self.all('i1', 'true')}, {self.vector} zeroinitializer)",
        ]

    def coefficient(self, power: int) -> list[str]:
        """Coefficient ``power`` of every lane's piece."""
        code = [f"%place{power} = add {self.integers} %row, {self.all('i64', str(power))}"]
        return code + self.gather(f"%c{power}", "%rows", f"%place{power}")
