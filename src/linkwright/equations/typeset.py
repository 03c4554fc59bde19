"""Terms as plain text and as they are printed, with as many digits as a reader with a calculator needs."""

from __future__ import annotations

import math
from functools import partial

from linkwright.equations.notation import (
    COMMA,
    THIN,
    TIMES,
    Atom,
    Bracket,
    Fraction,
    Node,
    Root,
    Row,
    group,
    number,
    raised,
    row,
    sign,
    upright,
)
from linkwright.equations.reading import read_name
from linkwright.equations.terms import ZERO_TOLERANCE, Term

_LEVEL = {"sum": 1, "product": 2, "quotient": 2, "square": 3}


def plain(term: Term, digits: int | None = None) -> str:
    """Symbols, or with ``digits`` the numbers put in, in plain text."""
    return _plain(term, digits)


def typeset(term: Term, digits: int | None = None) -> Row:
    """The same as it is printed."""
    return row(_printed(term, digits))


def _leaf(term: Term, digits: int | None) -> str:
    if term.op == "symbol" and digits is None:
        return term.plain
    return put_in(term, digits or 15)


def _wrapped(text: str, own: int, level: int, first: bool) -> bool:
    """Whether a part is in brackets, by how tightly it and what surrounds it (``level``) bind; ``first``: nothing
    precedes it there."""
    if own == 5:
        return text.startswith("-") and level != 0 and not (first and level == 1)
    return own < level or (own == level == 1 and not first)


def _plain(term: Term, digits: int | None, level: int = 0, *, first: bool = True) -> str:
    def show(index: int, level: int = 0, *, first: bool = False) -> str:
        return _plain(term.args[index], digits, level, first=first)

    own = _LEVEL.get(term.op, 4) if term.args else 5
    match term.op:
        case "symbol" | "number":
            text = _leaf(term, digits)
        case "sum":
            text = ""
            for i, way in enumerate(term.signs):
                between = ("-" if way < 0 else "") if i == 0 else " + " if way > 0 else " - "
                text += between + show(i, 1 if way > 0 else 2, first=i == 0 and way > 0)
        case "product":
            text = "·".join(show(i, 2) for i in range(len(term.args)))
        case "quotient":
            text = f"{show(0, 2)}/{show(1, 3)}"
        case "square":
            text = f"{show(0, 4)}²"
        case "root":
            text = f"√({show(0, first=True)})"
        case "size":
            text = f"|{show(0, first=True)}|"
        case _:
            text = f"{term.op}({', '.join(show(i, first=True) for i in range(len(term.args)))})"
    return f"({text})" if _wrapped(text, own, level, first) else text


def _printed(term: Term, digits: int | None, level: int = 0, *, first: bool = True) -> tuple[Node, ...]:
    def show(index: int, level: int = 0, *, first: bool = False) -> tuple[Node, ...]:
        return _printed(term.args[index], digits, level, first=first)

    def parts(between: Node) -> list[Node]:
        level = 2 if term.op == "product" else 0
        each = [(between, *show(i, level, first=not level)) for i in range(len(term.args))]
        return [node for nodes in each for node in nodes][1:]

    own, text = _LEVEL.get(term.op, 4) if term.args else 5, ""
    match term.op:
        case "symbol" | "number":
            text = _leaf(term, digits)
            named = term.op == "symbol" and digits is None
            nodes = read_name(term.look or text).items if named else number(text)
        case "sum":
            found: list[Node] = []
            for i, way in enumerate(term.signs):
                found += [sign("+" if way > 0 else "-")] if i or way < 0 else []
                found += show(i, 1 if way > 0 else 2, first=i == 0 and way > 0)
            nodes = tuple(found)
        case "product":
            nodes = tuple(parts(THIN if digits is None else TIMES))
        case "quotient":
            nodes = (Fraction(group(show(0, first=True)), group(show(1, first=True))),)
        case "square":
            base = show(0, 4)
            if len(base) > 1 and TIMES in base:
                base = (Bracket(row(base)),)
            nodes = (*base[:-1], raised(base[-1], Atom("number", "2")))
        case "root":
            nodes = (Root(group(show(0, first=True))),)
        case "size":
            nodes = (Bracket(row(show(0, first=True)), "|", "|"),)
        case _:
            nodes = (upright(term.op), Bracket(row(parts(COMMA))))
    return (Bracket(row(nodes)),) if _wrapped(text, own, level, first) else nodes


#: Significant digits of a result, and the fewest and most of a substituted number.
RESULT, FEWEST, MOST = 6, 6, 15
#: Relative error of the numbers put in that no result's last digit may fall below.
FINEST = 1e-11


def rounded(value: float, digits: int) -> str:
    """A number put in, to some significant digits."""
    text = f"{value:.{digits}g}"
    mantissa, e, exponent = text.partition("e")
    if e and -5 <= int(exponent) < 0:
        return f"{value:.{digits - 1 - int(exponent)}f}".rstrip("0")
    if mantissa in ("-0", "0"):
        return "0"
    return f"{mantissa}e{int(exponent)}" if e else mantissa


def put_in(term: Term, digits: int) -> str:
    """How a symbol's or a number's value is printed."""
    if term.is_rounding:
        return "0" + ("°" if term.degrees else "")
    if term.op == "number":
        return rounded(term.amount, MOST) + ("°" if term.degrees else "")
    return rounded(term.amount, digits) + ("°" if term.degrees else "")


def _as_put_in(leaf: Term, digits: int) -> float:
    return float(put_in(leaf, digits).rstrip("°"))


def last_place(value: float, error: float = 0.0) -> int:
    """Power of ten of the last digit of a result that may be wrong by ``error``."""
    own = math.floor(math.log10(abs(value))) - RESULT + 1 if value else -RESULT
    if error <= 0.0 or not math.isfinite(error):
        return own
    return max(own, math.ceil(math.log10(error)))


def printed(value: float, place: int) -> str:
    """A result to the digit of ``10**place``."""
    if abs(value) < max(0.5 * 10.0**place, ZERO_TOLERANCE):
        return "0"
    exponent = math.floor(math.log10(abs(value)))
    if exponent >= 7 or exponent < -4 or place > 0:
        mantissa = f"{value:.{max(exponent - place, 0)}e}"
        base, _, power = mantissa.partition("e")
        return f"{base}e{int(power)}"
    return f"{value:.{max(-place, 0)}f}"


def error_of(term: Term) -> float:
    """Bound of a term's error when every symbol has a relative error of FINEST."""
    if not term.args:
        return abs(term.amount) * FINEST if term.op == "symbol" else 0.0
    errors = [error_of(each) for each in term.args]
    values = [each.value for each in term.args]
    match term.op:
        case "sum":
            return sum(errors)
        case "product":
            product = math.prod(values)
            return sum(e * _share(product, values, i) for i, e in enumerate(errors))
        case "quotient":
            return (errors[0] + abs(values[0] / values[1]) * errors[1]) / abs(values[1]) if values[1] else math.inf
        case "square":
            return 2.0 * abs(values[0]) * errors[0]
        case "root":
            return errors[0] / (2.0 * math.sqrt(values[0])) if values[0] > 0.0 else math.inf
        case "size":
            return errors[0]
        case "tan":
            return math.radians(errors[0]) * (1.0 + term.value**2)
        case "atan2":
            size = values[0] ** 2 + values[1] ** 2
            turn = abs(values[0]) * errors[1] + abs(values[1]) * errors[0]
            return math.degrees(turn / size) if size else math.inf
        case "arccos" | "arcsin":
            across = 1.0 - values[0] ** 2
            return math.degrees(errors[0] / math.sqrt(across)) if across > 0.0 else math.inf
        case "arctan":
            return math.degrees(errors[0] / (1.0 + values[0] ** 2))
    return math.radians(errors[0])


def _share(product: float, values: list[float], index: int) -> float:
    if values[index]:
        return abs(product / values[index])
    return abs(math.prod(v for i, v in enumerate(values) if i != index))


def digits_needed(term: Term, goal: str, place: int) -> int:
    """The fewest digits of the numbers put in with which the term comes out as printed, within its last digit."""
    aim, step = float(goal), 10.0**place
    for digits in range(FEWEST, MOST + 1):
        found = term.evaluate(partial(_as_put_in, digits=digits))
        if abs(found - aim) <= 0.98 * step:
            return digits
    return MOST
