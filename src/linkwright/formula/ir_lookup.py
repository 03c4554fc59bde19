"""Look-ups in tables as functions of a module: binary search in all lanes, then a cubic."""

from __future__ import annotations

from linkwright.formula.ir_vectors import Lanes
from linkwright.formula.table import HEAD

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
