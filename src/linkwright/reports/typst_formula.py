"""Formulas as Typst."""

from __future__ import annotations

from linkwright.equations.latex import ACCENTS, BRACES
from linkwright.equations.notation import Accent, Atom, Bracket, Fraction, Limits, Matrix, Node, Root, Row, Script

_ACCENTS = {
    "dot": "dot",
    "ddot": "dot.double",
    "dddot": "dot.triple",
    "vec": "arrow",
    "overrightarrow": "arrow",
    "bar": "macron",
    "hat": "hat",
    "widehat": "hat",
    "tilde": "tilde",
    "widetilde": "tilde",
}
_SPACES = {",": "thin", ":": "med", ";": "thick", " ": "med", "quad": "quad", "qquad": "wide"}
_STYLES = {"bold": "bold(upright({}))", "slanted bold": "bold({})", "script": "cal({})", "double": "bb({})"}
_ALIGN = {"<": "left", "^": "center", ">": "right"}
_ESCAPED = '\\"'
assert _ACCENTS.keys() == ACCENTS.keys()


def typst(node: Node) -> str:
    """A formula between dollar signs of Typst."""
    match node:
        case Atom():
            return _sign(node)
        case Row(items):
            return " ".join(typst(each) for each in items)
        case Fraction(above, below):
            return f"frac({typst(above)}, {typst(below)})"
        case Root(inside, None):
            return f"sqrt({typst(inside)})"
        case Root(inside, degree) if degree is not None:
            return f"root({typst(degree)}, {typst(inside)})"
        case Script(base, below, above):
            found = '""' if base == Row() else f"lr({typst(base)})" if isinstance(base, Row) else typst(base)
            return found + _scripts(below, above)
        case Limits(Accent(mark, inside), below, None) if mark == "underbrace" and below is not None:
            return f"underbrace({typst(inside)}, {typst(below)})"
        case Limits(Accent(mark, inside), None, above) if mark == "overbrace" and above is not None:
            return f"overbrace({typst(inside)}, {typst(above)})"
        case Limits(base, below, above):
            return f"limits({typst(base)})" + _scripts(below, above)
        case Accent("overline", inside):
            return f"#lw-overline($ {typst(inside)} $)"
        case Accent(mark, inside):
            return f"{mark}({typst(inside)})" if mark in BRACES else f"accent({typst(inside)}, {_ACCENTS[mark]})"
        case Bracket(inside, "(", ")"):
            return f"lr(({typst(inside)}))"
        case Bracket(inside, left, right):
            return f"lr({_delimiter(left)} {typst(inside)} {_delimiter(right)})"
        case Matrix():
            return _matrix(node)
    raise AssertionError(node)


def _scripts(below: Node | None, above: Node | None) -> str:
    under = f"_({typst(below)})" if below is not None else ""
    return under + (f"^({typst(above)})" if above is not None else "")


def _sign(atom: Atom) -> str:
    kind, text = atom.kind, atom.text
    if kind in ("letter", "number"):
        return text
    if kind == "space":
        return _SPACES[text]
    if kind in ("open", "close"):
        return _delimiter(text)
    if kind == "sign":
        return f"\\{text}" if text in "/;,:!" else text
    style = _STYLES.get(kind, "upright({})")
    if len(text) == 1 and text.isascii():
        return style.format(text) if text.isalnum() else f"\\{text}"
    return quoted(text) if kind == "upright" else style.format(quoted(text))


def _delimiter(text: str) -> str:
    return text if text in ("", "|", "‖", "[", "]") else f"\\{text}"


def _matrix(matrix: Matrix) -> str:
    """Cells row by row; equations below each other share one column that is aligned at its marks."""
    if matrix.align == "=":
        rows = "; ".join(" & ".join(_cell(cell) for cell in row) for row in matrix.rows)
        return f"mat(delim: #none, row-gap: #0.6em, {rows})"
    sides = ", ".join(quoted(each) if each else "none" for each in (matrix.left, matrix.right))
    rows = "; ".join(", ".join(_cell(cell) for cell in row) for row in matrix.rows)
    return f"mat(delim: #({sides}), align: #{_ALIGN[matrix.align]}, {rows})"


def _cell(cell: Row) -> str:
    return typst(cell) if cell.items else '""'


def quoted(text: str) -> str:
    """A text as a string of Typst."""
    return '"' + "".join(f"\\{c}" if c in _ESCAPED else c for c in text).replace("\n", " ") + '"'
