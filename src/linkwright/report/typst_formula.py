"""Formulas in Typst's notation."""

from __future__ import annotations

from linkwright.report.formula import ACCENTS, Accent, Atom, Bracket, Fraction, Node, Root, Row, Script

_ACCENTS = {"dot": "dot", "ddot": "dot.double", "vec": "arrow", "overrightarrow": "arrow", "bar": "macron"}
_SPACES = {",": "thin", ";": "med", ":": "med", " ": "med", "quad": "quad"}
_ESCAPED = '\\"'
assert _ACCENTS.keys() == ACCENTS.keys()


def typst(node: Node) -> str:
    """A formula between dollar signs of Typst."""
    match node:
        case Atom("letter" | "number", text):
            return text
        case Atom("space", text):
            return _SPACES[text]
        case Atom("open" | "close", text):
            return f"\\{text}"
        case Atom("sign", text):
            return f"\\{text}" if text in "/;,:!" else text
        case Atom(_, text):
            return quoted(text)
        case Row(items):
            return " ".join(typst(each) for each in items)
        case Fraction(above, below):
            return f"frac({typst(above)}, {typst(below)})"
        case Root(inside):
            return f"sqrt({typst(inside)})"
        case Script(base, below, above):
            found = '""' if base == Row() else f"lr({typst(base)})" if isinstance(base, Row) else typst(base)
            found += f"_({typst(below)})" if below is not None else ""
            return found + (f"^({typst(above)})" if above is not None else "")
        case Accent(mark, inside):
            return f"accent({typst(inside)}, {_ACCENTS[mark]})"
        case Bracket(inside, left, right):
            return (
                f"lr(({typst(inside)}))"
                if (left, right) == ("(", ")")
                else f"lr({left} {typst(inside)} {right})"
            )


def quoted(text: str) -> str:
    """A text as a string of Typst."""
    return '"' + "".join(f"\\{c}" if c in _ESCAPED else c for c in text).replace("\n", " ") + '"'
