"""Formulas as Word's own equations (OMML)."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from linkwright.report.formula import ACCENTS, Accent, Atom, Bracket, Fraction, Node, Root, Row, Script

SPACE = "http://schemas.openxmlformats.org/officeDocument/2006/math"
_SPACES = {",": "\u2009", ";": "\u2005", ":": "\u2005", " ": "\u2005", "quad": "\u2003"}


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


def _part(name: str, node: Node) -> Any:
    return _element(name, *_elements(node))


def _elements(node: Node) -> Iterator[Any]:
    match node:
        case Row(items):
            for item in items:
                yield from _elements(item)
        case Atom(kind, text):
            yield _run(kind, text)
        case Fraction(above, below):
            yield _element("f", _part("num", above), _part("den", below))
        case Root(inside):
            hidden = _element("radPr", _element("degHide", val="1"))
            yield _element("rad", hidden, _element("deg"), _part("e", inside))
        case Script(base, below, None) if below is not None:
            yield _element("sSub", _part("e", base), _part("sub", below))
        case Script(base, None, above) if above is not None:
            yield _element("sSup", _part("e", base), _part("sup", above))
        case Script(base, below, above) if below is not None and above is not None:
            yield _element("sSubSup", _part("e", base), _part("sub", below), _part("sup", above))
        case Script(base):
            yield from _elements(base)
        case Accent(mark, inside):
            yield _element("acc", _element("accPr", _element("chr", val=ACCENTS[mark])), _part("e", inside))
        case Bracket(inside, left, right):
            sides = _element("dPr", _element("begChr", val=left), _element("endChr", val=right))
            yield _element("d", sides, _part("e", inside))


def _run(kind: str, text: str) -> Any:
    shown = _SPACES[text] if kind == "space" else text
    written = _element("t")
    written.text = shown
    written.set("{http://www.w3.org/XML/1998/namespace}space", "preserve")
    if kind in ("upright", "space", "open", "close"):
        return _element("r", _element("rPr", _element("nor")), written)
    return _element("r", written)
