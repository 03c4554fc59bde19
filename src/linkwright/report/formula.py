"""Formulas as trees: read from the LaTeX that the worked solution writes, printed for Typst and for Word.

Only what formulas of mechanisms need is known: letters, numbers, fractions, roots, indices, accents, brackets,
functions. Another command is refused, so that nothing is printed wrong.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import field

from linkwright.core.dataclass import dataclass
from linkwright.errors import LinkwrightError
from linkwright.words.characters import cells

SYMBOLS = {
    "alpha": "α", "beta": "β", "gamma": "γ", "delta": "δ", "Delta": "Δ", "varepsilon": "ε", "eta": "η",
    "theta": "θ", "kappa": "κ", "lambda": "λ", "mu": "μ", "nu": "ν", "xi": "ξ", "pi": "π", "rho": "ρ", "sigma": "σ",
    "Sigma": "Σ", "tau": "τ", "varphi": "φ", "psi": "ψ", "omega": "ω", "Omega": "Ω", "phi": "φ",
    "cdot": "⋅", "times": "×", "to": "→", "circ": "°", "angle": "∠", "sum": "∑", "perp": "⊥", "pm": "±",
    "le": "≤", "ge": "≥", "approx": "≈", "infty": "∞", "partial": "∂", "int": "∫", "ldots": "…", "neq": "≠",
}  # fmt: skip
FUNCTIONS = (
    "cos", "sin", "tan", "arccos", "arcsin", "arctan", "acos", "asin", "atan", "det", "min", "max", "exp", "log",
    "ln",
)  # fmt: skip
ACCENTS = {"dot": "\u0307", "ddot": "\u0308", "vec": "\u20d7", "overrightarrow": "\u20d7", "bar": "\u0305"}
#: Binary signs and relations: a line may break before them.
SIGNS = "+-−=≤≥≈≠"
_TOKEN = re.compile(r"\\[A-Za-z]+|\\.|\d+(?:\.\d+)?|[^\s]")


@dataclass(frozen=True)
class Atom:
    """One sign: ``kind`` is ``letter`` (slanted), ``upright``, ``number``, ``sign`` or ``space``."""

    kind: str
    text: str


@dataclass(frozen=True)
class Row:
    """Formulas side by side."""

    items: tuple[Node, ...] = ()


@dataclass(frozen=True)
class Fraction:
    """A quotient."""

    above: Node
    below: Node


@dataclass(frozen=True)
class Root:
    """A square root."""

    inside: Node


@dataclass(frozen=True)
class Script:
    """A sign with what stands below and above it."""

    base: Node
    below: Node | None = None
    above: Node | None = None


@dataclass(frozen=True)
class Accent:
    """A sign with a dot, an arrow or a bar over it; ``mark`` is the command's name."""

    mark: str
    inside: Node


@dataclass(frozen=True)
class Bracket:
    """What stands in round or square brackets."""

    inside: Row
    left: str = "("
    right: str = ")"


Node = Atom | Row | Fraction | Root | Script | Accent | Bracket


def formula(text: str) -> Row:
    """The tree of a formula; raises LinkwrightError for what is no formula of ours."""
    reader = _Reader(_TOKEN.findall(text), text)
    found = reader.row(())
    if reader.more:
        raise reader.error()
    return found


@dataclass
class _Reader:
    """Reads tokens one after the other."""

    tokens: list[str]
    text: str
    at: int = field(default=0)

    @property
    def more(self) -> bool:
        return self.at < len(self.tokens)

    def error(self) -> LinkwrightError:
        place = self.tokens[self.at] if self.more else "…"
        return LinkwrightError("report.no_formula", sign=place, text=self.text)

    def next(self) -> str:
        if not self.more:
            raise self.error()
        self.at += 1
        return self.tokens[self.at - 1]

    def row(self, ends: Sequence[str]) -> Row:
        """Everything up to one of the ends."""
        items: list[Node] = []
        while self.more and self.tokens[self.at] not in ends:
            token = self.next()
            if token in "_^" and len(token) == 1:
                items.append(self._script(items.pop() if items else Row(), token))
            else:
                items.append(self._node(token))
        return Row(tuple(items))

    def _script(self, base: Node, token: str) -> Script:
        part = self.argument()
        own = base if isinstance(base, Script) else Script(base)
        if token == "_":
            return Script(own.base, part, own.above)
        return Script(own.base, own.below, part)

    def argument(self) -> Node:
        """What a command or an index applies to."""
        token = self.next()
        if token != "{":
            return self._node(token)
        inside = self.row(("}",))
        if self.next() != "}":
            raise self.error()
        return inside.items[0] if len(inside.items) == 1 else inside

    def _raw(self) -> str:
        """The text of an upright name, with its escapes taken out."""
        if self.next() != "{":
            raise self.error()
        found = ""
        while (token := self.next()) != "}":
            found += token.removeprefix("\\")
        return found

    def _node(self, token: str) -> Node:
        if token == "{":
            self.at -= 1
            return self.argument()
        if token.startswith("\\"):
            return self._command(token[1:])
        if token in (")", "}"):
            self.at -= 1
            raise self.error()
        if token == "(":
            return self._bracket("(", ")")
        if token[0].isdigit():
            return Atom("number", token)
        if token in "+-=<>,;|/·:→⊥°±≤≥≈×!":
            return Atom("sign", "−" if token == "-" else token)
        return Atom(
            "letter" if (token.isalpha() and token.isascii()) or "α" <= token <= "ω" else "upright", token
        )

    def _bracket(self, left: str, right: str) -> Bracket:
        inside = self.row((right,))
        if self.next() != right:
            raise self.error()
        return Bracket(inside, left, right)

    def _command(self, name: str) -> Node:
        if name == "frac":
            return Fraction(self.argument(), self.argument())
        if name == "sqrt":
            return Root(self.argument())
        if name in ("mathrm", "operatorname", "text"):
            return Atom("upright", self._raw())
        if name in ACCENTS:
            return Accent(name, self.argument())
        if name == "left":
            left = self.next()
            inside = self.row((r"\right",))
            self.next()
            return Bracket(inside, left, self.next())
        if name in FUNCTIONS:
            return Atom("upright", name)
        if name in SYMBOLS:
            text = SYMBOLS[name]
            return Atom("letter" if text.isalpha() else "sign", text)
        if name in (",", ";", "quad", " ", ":"):
            return Atom("space", name)
        if name in ("_", "%", "&", "#"):
            return Atom("upright", name)
        self.at -= 1
        raise self.error()


# widths and lines -----------------------------------------------------------------------------
def width(node: Node | None, size: float = 1.0) -> float:
    """Roughly how wide a formula is printed, in em."""
    match node:
        case None:
            return 0.0
        case Atom("space", text):
            return size * (1.0 if text == "quad" else 0.2)
        case Atom("sign", text):
            return size * (1.25 if text in "+−=→≤≥≈" else 0.35)
        case Atom(_, text):
            return size * 0.54 * cells(text)
        case Row(items):
            return sum(width(each, size) for each in items)
        case Fraction(above, below):
            return max(width(above, size), width(below, size)) + 0.3 * size
        case Root(inside):
            return width(inside, size) + 0.9 * size
        case Script(base, below, above):
            return width(base, size) + max(width(below, 0.7 * size), width(above, 0.7 * size))
        case Accent(_, inside):
            return width(inside, size)
        case Bracket(inside):
            return width(inside, size) + 0.8 * size


def lines(row: Row, widest: float) -> Iterator[Row]:
    """A formula in lines no wider than ``widest`` em: broken before signs, inside brackets where it must be."""
    line: list[Node] = []
    for piece in _pieces(row, widest):
        if line and width(Row((*line, *piece))) > widest:
            yield Row(tuple(line))
            line = []
        line += piece
    yield Row(tuple(line))


@dataclass(frozen=True)
class Line:
    """One line of an equation; ``place`` says where it begins: ``left``, ``right`` of the left side, ``below`` it,
    at the equal ``sign`` of the line before, or ``further`` in as what goes on from there."""

    place: str
    row: Row


def set_lines(sides: Sequence[Row], widest: float, left: float) -> Iterator[Line]:
    """Sides joined by equal signs: on one line no wider than ``widest`` em, else the signs below each other.

    Behind a left side wider than ``left`` em a new line begins.
    """
    equal = Atom("sign", "=")
    if len(sides) == 1:
        for number, row in enumerate(lines(sides[0], widest)):
            yield Line("further" if number else "left", row)
        return
    if sum(width(row) for row in sides) + 1.25 * (len(sides) - 1) <= widest:
        first, *rest = sides
        yield Line("left", Row((*first.items, *(each for row in rest for each in (equal, *row.items)))))
        return
    first, *rest = sides
    yield Line("left", first)
    place, margin = ("below", 1.5) if width(first) > left else ("right", width(first) + 1.5)
    for side in _joined(rest, widest - margin):
        for number, row in enumerate(lines(side, widest - margin - 1.0)):
            yield Line("further", row) if number else Line(place, Row((equal, *row.items)))
        place = "sign"


def _joined(sides: Sequence[Row], room: float) -> Iterator[Row]:
    """Short sides that follow each other share a line."""
    held: Row | None = None
    for side in sides:
        if held is not None and width(held) + width(side) + 1.25 <= room:
            held = Row((*held.items, Atom("sign", "="), *side.items))
            continue
        if held is not None:
            yield held
        held = side
    if held is not None:
        yield held


def _pieces(row: Row, widest: float) -> Iterator[list[Node]]:
    """Parts between which a line may break; brackets that are too wide are opened."""
    part: list[Node] = []
    for item in _opened(row, widest):
        breaks = isinstance(item, Atom) and item.kind == "sign" and item.text in f"{SIGNS}⋅"
        if breaks and part and not _leading(part):
            yield part
            part = []
        part.append(item)
    yield part


def _leading(part: Sequence[Node]) -> bool:
    """Whether nothing but a sign or an opening bracket stands there yet: the next sign belongs to it."""
    return all(isinstance(each, Atom) and (each.kind == "sign" or each.text == "(") for each in part)


def _opened(row: Row, widest: float) -> Iterator[Node]:
    for item in row.items:
        if isinstance(item, Bracket) and width(item) > 0.6 * widest:
            yield Atom("open", item.left)
            yield from _opened(item.inside, widest)
            yield Atom("close", item.right)
        else:
            yield item
