"""Formulas as Word's own equations (Office Math), which can be edited."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from linkwright.equations.latex import ACCENTS, BRACES, INTEGRALS
from linkwright.equations.notation import Accent, Atom, Bracket, Fraction, Limits, Matrix, Node, Root, Row, Script
from linkwright.reports.formula_lines import large, relation

SPACE = "http://schemas.openxmlformats.org/officeDocument/2006/math"
_SPACES = {",": "\u2009", ":": "\u2005", ";": "\u2004", " ": "\u2005", "quad": "\u2003", "qquad": "\u2003\u2003"}
_STYLES = {
    "bold": (("sty", "b"),),
    "slanted bold": (("sty", "bi"),),
    "script": (("scr", "script"), ("sty", "p")),
    "double": (("scr", "double-struck"), ("sty", "p")),
}
_ALIGN = {"<": "left", "^": "center", ">": "right"}


def equation(row: Row) -> Any:
    """The element ``m:oMath`` of a formula."""
    return _part("oMath", row)


def _element(name: str, *inside: Any, **attributes: str) -> Any:
    from lxml import etree

    found = etree.Element(f"{{{SPACE}}}{name}", nsmap={"m": SPACE})
    for key, value in attributes.items():
        found.set(f"{{{SPACE}}}{key}", value)
    found.extend(inside)
    return found


def _part(name: str, *nodes: Node | None) -> Any:
    return _element(name, *_elements(Row(tuple(each for each in nodes if each is not None))))


def _elements(node: Node) -> Iterator[Any]:
    match node:
        case Row(items):
            yield from _row(items)
        case Atom(kind, text):
            yield _run(kind, text)
        case Fraction(above, below):
            yield _element("f", _part("num", above), _part("den", below))
        case Root(inside, degree):
            look = [] if degree is not None else [_element("radPr", _element("degHide", val="1"))]
            yield _element("rad", *look, _part("deg", degree), _part("e", inside))
        case Script(base, below, None) if below is not None:
            yield _element("sSub", _part("e", base), _part("sub", below))
        case Script(base, None, above) if above is not None:
            yield _element("sSup", _part("e", base), _part("sup", above))
        case Script(base, below, above) if below is not None and above is not None:
            yield _element("sSubSup", _part("e", base), _part("sub", below), _part("sup", above))
        case Script(base):
            yield from _elements(base)
        case Limits(base, below, above):
            yield from _limits(base, below, above)
        case Accent(mark, inside):
            yield _accent(mark, inside)
        case Bracket(inside, left, right):
            sides = _element("dPr", _element("begChr", val=left), _element("endChr", val=right))
            yield _element("d", sides, _part("e", inside))
        case Matrix():
            yield _matrix(node)


def _row(items: Sequence[Node]) -> Iterator[Any]:
    """Formulas side by side; a sum or an integral holds what follows up to the next sum or equal sign."""
    rest = list(items)
    while rest:
        first = rest.pop(0)
        own = first if isinstance(first, Script) else Script(first)
        if not large(own.base):
            yield from _elements(first)
            continue
        applied: list[Node] = []
        while rest and not (relation(rest[0]) or (applied and rest[0] in _SUMMED)):
            applied.append(rest.pop(0))
        assert isinstance(own.base, Atom)
        place = "subSup" if own.base.text in INTEGRALS else "undOvr"
        hidden = [
            _element(name, val="1") for name, part in (("subHide", own.below), ("supHide", own.above)) if part is None
        ]
        look = _element("naryPr", _element("chr", val=own.base.text), _element("limLoc", val=place), *hidden)
        yield _element("nary", look, _part("sub", own.below), _part("sup", own.above), _part("e", *applied))


_SUMMED = (Atom("sign", "+"), Atom("sign", "−"), Atom("sign", ","), Atom("sign", ";"))


def _limits(base: Node, below: Node | None, above: Node | None) -> Iterator[Any]:
    found = list(_elements(base))
    for name, part in (("limLow", below), ("limUpp", above)):
        if part is not None:
            found = [_element(name, _element("e", *found), _part("lim", part))]
    yield from found


def _accent(mark: str, inside: Node) -> Any:
    if mark == "overline":
        return _element("bar", _element("barPr", _element("pos", val="top")), _part("e", inside))
    if mark in BRACES:
        place = "top" if mark == "overbrace" else "bot"
        look = [_element("chr", val=BRACES[mark]), _element("pos", val=place)]
        if place == "top":
            look.append(_element("vertJc", val="bot"))
        return _element("groupChr", _element("groupChrPr", *look), _part("e", inside))
    return _element("acc", _element("accPr", _element("chr", val=ACCENTS[mark])), _part("e", inside))


def _matrix(matrix: Matrix) -> Any:
    """A matrix between its delimiters; equations below each other without gaps between their columns."""
    number = len(matrix.rows[0])
    aligned = matrix.align == "="
    sides = [("right", "left")[i % 2] if aligned else _ALIGN[matrix.align] for i in range(number)]
    if aligned and number == 1:
        sides = ["left"]
    columns = [
        _element("mc", _element("mcPr", _element("count", val="1"), _element("mcJc", val=each))) for each in sides
    ]
    gaps = [_element("cGpRule", val="3"), _element("cGp", val="0")] if aligned else []
    look = _element("mPr", *gaps, _element("mcs", *columns))
    rows = [_element("mr", *(_part("e", cell) for cell in row)) for row in matrix.rows]
    found = _element("m", look, *rows)
    if not (matrix.left or matrix.right):
        return found
    ends = _element("dPr", _element("begChr", val=matrix.left), _element("endChr", val=matrix.right))
    return _element("d", ends, _element("e", found))


def _run(kind: str, text: str) -> Any:
    written = _element("t")
    written.text = _SPACES[text] if kind == "space" else text
    written.set("{http://www.w3.org/XML/1998/namespace}space", "preserve")
    if kind in ("upright", "space", "open", "close"):
        return _element("r", _element("rPr", _element("nor")), written)
    if kind in _STYLES:
        return _element("r", _element("rPr", *(_element(k, val=v) for k, v in _STYLES[kind])), written)
    return _element("r", written)
