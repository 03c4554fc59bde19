"""Formulas as LaTeX."""

from __future__ import annotations

import re

from linkwright.equations.notation import Accent, Atom, Bracket, Fraction, Limits, Matrix, Node, Root, Row, Script
from linkwright.equations.signs import FUNCTIONS, SYMBOLS

#: Commands by the signs that they stand for, the usual one of several.
_COMMANDS = {text: name for name, text in reversed(SYMBOLS.items())} | {"φ": "varphi"}
_SPACES = {",": r"\,", ":": r"\:", ";": r"\;", " ": r"\ ", "quad": r"\quad ", "qquad": r"\qquad "}
_STYLES = {"bold": "mathbf", "slanted bold": "bm", "script": "mathcal", "double": "mathbb"}
#: Signs with room on both sides, behind something.
_SPACED = "+−=<>±∓≤≥≈→∈"


def latex(node: Node) -> str:
    """A formula as LaTeX."""
    match node:
        case Row(items):
            return _row(items)
        case Atom():
            return _atom(node)
        case Fraction(above, below):
            return rf"\frac{{{latex(above)}}}{{{latex(below)}}}"
        case Root(inside, degree):
            return rf"\sqrt{f'[{latex(degree)}]' if degree else ''}{{{latex(inside)}}}"
        case Script(base, below, above) | Limits(base, below, above):
            nucleus = f"{{{latex(base)}}}" if isinstance(base, Row) else latex(base)
            low, high = (f"{mark}{{{latex(part)}}}" if part else "" for mark, part in (("_", below), ("^", above)))
            return nucleus + low + high
        case Accent(mark, inside):
            return rf"\{mark}{{{latex(inside)}}}"
        case Bracket(inside, left, right):
            return rf"\left{_delimiter(left)}{latex(inside)}\right{_delimiter(right)}"
        case Matrix(rows, left, right):
            kind = {"(": "pmatrix", "[": "bmatrix", "|": "vmatrix", "{": "cases"}.get(left, "matrix")
            body = r" \\ ".join(" & ".join(map(latex, each)) for each in rows)
            return rf"\begin{{{kind}}} {body} \end{{{kind}}}"


def _row(items: tuple[Node, ...]) -> str:
    found = ""
    for item in items:
        spaced = isinstance(item, Atom) and item.kind == "sign" and item.text in _SPACED
        text = f" {latex(item)} " if spaced and found and not found.endswith(" ") else latex(item)
        command = re.search(r"\\[A-Za-z]+$", found)
        found += f" {text}" if command and (text[0].isalnum() or command[0][1:] in (*FUNCTIONS, "cdot")) else text
    return found.strip()


def _delimiter(text: str) -> str:
    return f"\\{text}" if text in "{}" and text else text or "."


def _atom(atom: Atom) -> str:
    kind, text = atom.kind, atom.text
    if kind == "space":
        return _SPACES[text]
    if text in _COMMANDS and kind in ("letter", "upright", "sign"):
        return rf"\{_COMMANDS[text]}"
    if kind == "upright" and text in FUNCTIONS:
        return rf"\{text}"
    if kind in _STYLES:
        return rf"\{_STYLES[kind]}{{{text}}}"
    if kind == "upright" and (text.isascii() or len(text) > 1):
        name = "operatorname" if text == "atan2" else "mathrm"
        return rf"\{name}{{{re.sub(r'([ {}%&#_$])', lambda found: chr(92) + found[1], text)}}}"
    return text.replace("−", "-")
