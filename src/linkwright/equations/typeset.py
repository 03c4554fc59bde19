"""Terms as plain text and as they are printed, with their symbols or with the numbers put in."""

from __future__ import annotations

from linkwright.equations.digits import put_in
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
from linkwright.equations.terms import Term

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
