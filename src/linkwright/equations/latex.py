"""Formulas as LaTeX, and its commands with the characters that they stand for."""

from __future__ import annotations

import re

from linkwright.equations.notation import Accent, Atom, Bracket, Fraction, Limits, Matrix, Node, Root, Row, Script


def _pairs(text: str) -> dict[str, str]:
    """Commands and their signs, written in turn."""
    words = text.split()
    return dict(zip(words[::2], words[1::2], strict=True))


#: Letters, slanted.
LETTERS = _pairs(
    """
    alpha α beta β gamma γ delta δ epsilon ϵ varepsilon ε zeta ζ eta η theta θ vartheta ϑ iota ι kappa κ lambda λ
    mu μ nu ν xi ξ pi π varpi ϖ rho ρ varrho ϱ sigma σ varsigma ς tau τ upsilon υ phi φ varphi φ chi χ psi ψ
    omega ω Gamma Γ Delta Δ Theta Θ Lambda Λ Xi Ξ Pi Π Sigma Σ Upsilon Υ Phi Φ Psi Ψ Omega Ω ell ℓ hbar ℏ
    """
)
#: Relations and arrows: they have room on both sides.
RELATIONS = _pairs(
    """
    le ≤ leq ≤ leqslant ≤ ge ≥ geq ≥ geqslant ≥ ne ≠ neq ≠ approx ≈ equiv ≡ sim ∼ simeq ≃ cong ≅ propto ∝ ll ≪
    gg ≫ lt < gt > in ∈ notin ∉ ni ∋ subset ⊂ subseteq ⊆ supset ⊃ supseteq ⊇ perp ⊥ parallel ∥ mid ∣ to →
    rightarrow → leftarrow ← gets ← leftrightarrow ↔ Rightarrow ⇒ implies ⇒ Leftarrow ⇐ mapsto ↦ Leftrightarrow ⇔
    iff ⇔ longrightarrow ⟶ uparrow ↑ downarrow ↓
    """
)
#: Sums, products, integrals: what they apply to follows them, with limits below and above.
LARGE = {"sum": "∑", "prod": "∏", "int": "∫", "iint": "∬", "iiint": "∭", "oint": "∮", "bigcup": "⋃", "bigcap": "⋂"}
#: Integrals have their limits to the right.
INTEGRALS = "∫∬∭∮"
OTHERS = _pairs(
    """
    cdot ⋅ times × div ÷ pm ± mp ∓ ast ∗ star ⋆ oplus ⊕ otimes ⊗ circ ∘ degree ° bullet ∙ cup ∪ cap ∩ setminus ∖
    wedge ∧ vee ∨ neg ¬ forall ∀ exists ∃ emptyset ∅ varnothing ∅ infty ∞ partial ∂ nabla ∇ prime ′ angle ∠
    triangle △ therefore ∴ because ∵ ldots … dots … cdots ⋯ vdots ⋮ ddots ⋱ vert | Vert ‖
    """
)
SYMBOLS = {**LETTERS, **RELATIONS, **LARGE, **OTHERS}
FUNCTIONS = (
    "cos",
    "sin",
    "tan",
    "cot",
    "sec",
    "csc",
    "sinh",
    "cosh",
    "tanh",
    "arccos",
    "arcsin",
    "arctan",
    "acos",
    "asin",
    "atan",
    "det",
    "dim",
    "rank",
    "min",
    "max",
    "sup",
    "inf",
    "lim",
    "exp",
    "log",
    "lg",
    "ln",
    "arg",
    "gcd",
    "sgn",
)
#: Functions that have their index below them.
BELOW = ("lim", "sup", "inf")
#: Accents over letters, as Word takes them.
ACCENTS = {
    "dot": "\u0307",
    "ddot": "\u0308",
    "dddot": "\u20db",
    "vec": "\u20d7",
    "overrightarrow": "\u20d7",
    "bar": "\u0305",
    "hat": "\u0302",
    "widehat": "\u0302",
    "tilde": "\u0303",
    "widetilde": "\u0303",
}
#: Braces over or below a term; their index or exponent is what they say of it.
BRACES = {"overbrace": "⏞", "underbrace": "⏟"}
DELIMITERS = {
    "(": "(",
    ")": ")",
    "[": "[",
    "]": "]",
    "|": "|",
    ".": "",
    "/": "/",
    r"\{": "{",
    r"\}": "}",
    r"\|": "‖",
    r"\lbrace": "{",
    r"\rbrace": "}",
    r"\lbrack": "[",
    r"\rbrack": "]",
    r"\langle": "⟨",
    r"\rangle": "⟩",
    r"\lvert": "|",
    r"\rvert": "|",
    r"\lVert": "‖",
    r"\rVert": "‖",
    r"\vert": "|",
    r"\Vert": "‖",
    r"\lceil": "⌈",
    r"\rceil": "⌉",
    r"\lfloor": "⌊",
    r"\rfloor": "⌋",
}
#: Delimiters that stand for themselves, without ``\\left``: kind and sign.
BARE = {
    command: ("sign" if text in "|‖" else "close" if command.startswith(r"\r") or text == "}" else "open", text)
    for command, text in DELIMITERS.items()
    if command.startswith("\\")
}
#: Letters of a style by command: kind of sign.
STYLES = {
    "mathbf": "bold",
    "bm": "slanted bold",
    "boldsymbol": "slanted bold",
    "mathcal": "script",
    "mathbb": "double",
    "mathit": "letter",
    "mathsf": "upright",
}
SPACES = {
    ",": ",",
    "thinspace": ",",
    ":": ":",
    ">": ":",
    ";": ";",
    " ": " ",
    "space": " ",
    "quad": "quad",
    "qquad": "qquad",
}
#: Commands that change nothing here: sizes, places of limits.
IGNORED = (
    "!",
    "limits",
    "nolimits",
    "displaystyle",
    "textstyle",
    "scriptstyle",
    "nonumber",
    "notag",
    "big",
    "Big",
    "bigg",
    "Bigg",
    "bigl",
    "bigr",
    "Bigl",
    "Bigr",
    "biggl",
    "biggr",
    "Biggl",
    "Biggr",
    "middle",
)
#: Surroundings of rows and columns: delimiters, and how columns are aligned (``=``: at the signs between them).
MATRICES = {
    "matrix": ("", "", "^"),
    "smallmatrix": ("", "", "^"),
    "array": ("", "", "^"),
    "pmatrix": ("(", ")", "^"),
    "bmatrix": ("[", "]", "^"),
    "Bmatrix": ("{", "}", "^"),
    "vmatrix": ("|", "|", "^"),
    "Vmatrix": ("‖", "‖", "^"),
    "cases": ("{", "", "<"),
    "dcases": ("{", "", "<"),
    "aligned": ("", "", "="),
    "align": ("", "", "="),
    "alignedat": ("", "", "="),
    "split": ("", "", "="),
    "eqnarray": ("", "", "="),
    "gathered": ("", "", "^"),
    "gather": ("", "", "^"),
    "equation": ("", "", "="),
}


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
