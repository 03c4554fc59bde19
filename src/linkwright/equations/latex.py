"""Formulas as LaTeX."""

from __future__ import annotations

import re

from linkwright.equations.notation import (
    Accent,
    Atom,
    Bracket,
    Fraction,
    Limits,
    Matrix,
    Node,
    Root,
    Row,
    Script,
)

_FUNCTIONS = ("cos", "sin", "tan", "arccos", "arcsin", "arctan", "ln", "exp", "min", "max", "det")
_GREEK = dict(
    zip(
        "αβγδεζηθικλμνξπρστυφχψωΓΔΘΛΞΠΣΦΨΩ",
        ("alpha", "beta", "gamma", "delta", "varepsilon", "zeta", "eta", "theta", "iota", "kappa", "lambda", "mu",
         "nu", "xi", "pi", "rho", "sigma", "tau", "upsilon", "varphi", "chi", "psi", "omega", "Gamma", "Delta",
         "Theta", "Lambda", "Xi", "Pi", "Sigma", "Phi", "Psi", "Omega"), strict=True,
    )
)  # fmt: skip
_SIGNS = {
    "−": "-", "⋅": r"\cdot", "×": r"\times", "±": r"\pm", "∓": r"\mp", "≤": r"\le", "≥": r"\ge", "≈": r"\approx",
    "→": r"\to", "∈": r"\in", "…": r"\ldots", "∑": r"\sum", "∫": r"\int", "∂": r"\partial", "∇": r"\nabla",
    "∠": r"\angle", "∘": r"\circ", "′": r"\prime", "⊥": r"\perp",
}  # fmt: skip
_SPACES = {",": r"\,", ":": r"\:", ";": r"\;", " ": r"\ ", "quad": r"\quad ", "qquad": r"\qquad "}
_STYLES = {"bold": "mathbf", "slanted bold": "bm", "script": "mathcal", "double": "mathbb"}
#: Signs with room on both sides, behind something.
_APART = "+−=<>±∓≤≥≈→∈"


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
            whole = f"{{{latex(base)}}}" if isinstance(base, Row) else latex(base)
            low, high = (
                f"{mark}{{{latex(part)}}}" if part else "" for mark, part in (("_", below), ("^", above))
            )
            return whole + low + high
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
        apart = isinstance(item, Atom) and item.kind == "sign" and item.text in _APART
        text = f" {latex(item)} " if apart and found and not found.endswith(" ") else latex(item)
        command = re.search(r"\\[A-Za-z]+$", found)
        found += (
            f" {text}" if command and (text[0].isalnum() or command[0][1:] in (*_FUNCTIONS, "cdot")) else text
        )
    return found.strip()


def _delimiter(text: str) -> str:
    return f"\\{text}" if text in "{}" and text else text or "."


def _atom(atom: Atom) -> str:
    kind, text = atom.kind, atom.text
    if kind == "space":
        return _SPACES[text]
    if kind == "letter" or (kind == "upright" and len(text) == 1):
        return (
            rf"\{_GREEK[text]}"
            if text in _GREEK
            else text
            if kind == "letter" or not text.isascii()
            else _upright(text)
        )
    if kind == "upright" and text in _FUNCTIONS:
        return rf"\{text}"
    if kind in _STYLES:
        return rf"\{_STYLES[kind]}{{{text}}}"
    return _upright(text) if kind == "upright" else _SIGNS.get(text, text)


def _upright(text: str) -> str:
    if text == "atan2":
        return r"\operatorname{atan2}"
    return rf"\mathrm{{{re.sub(r'([ {}%&#_$])', lambda found: chr(92) + found[1], text)}}}"
