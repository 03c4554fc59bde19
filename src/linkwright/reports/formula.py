"""A user's own formulas, in LaTeX, as they are printed, and where one that is too wide for a page is broken.

Known is what formulas of mechanisms need: letters, numbers, fractions, roots, indices, accents, brackets, functions,
sums and integrals, matrices, cases, equations below each other. Another command is refused, so that nothing is
printed wrong.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace

from linkwright.equations.latex import (
    ACCENTS,
    BARE,
    BELOW,
    BRACES,
    DELIMITERS,
    FUNCTIONS,
    IGNORED,
    LARGE,
    MATRICES,
    RELATIONS,
    SPACES,
    STYLES,
    SYMBOLS,
)
from linkwright.equations.notation import (
    EQUAL,
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
    letter,
    sign,
)
from linkwright.errors import LinkwrightError
from linkwright.words import _
from linkwright.words.characters import cells

_TEXT = r"\\(?:text|textrm|textit|textbf|mbox)\s*\{[^{}]*\}"
_TOKEN = re.compile(rf"{_TEXT}|\\[A-Za-z]+\*?|\\.|\d+(?:\.\d+)?|[^\s]", re.DOTALL)
#: Escaped signs that are letters of an upright name.
_PLAIN = (r"\_", r"\%", r"\&", r"\#", r"\$", r"\{", r"\}")
_SIGNS = "+-=<>,;|/·:→⊥°±≤≥≈≠×!−"


def formula(text: str) -> Row:
    """The tree of a formula; raises LinkwrightError for what is no formula of ours."""
    reader = _Reader(_TOKEN.findall(text), text)
    rows = reader.rows(())
    if reader.more:
        raise reader.error()
    if len(rows) == len(rows[0]) == 1:
        return rows[0][0]
    return Row((Matrix(rows, align="="),))


def styled(node: Node, kind: str) -> Node:
    """A formula whose letters are of a kind."""
    match node:
        case Atom("letter" | "upright", text) | Atom("number", text) if kind != "letter":
            return Atom("number" if node.kind == "number" and "bold" not in kind else kind, text)
        case Row(items):
            return Row(tuple(styled(each, kind) for each in items))
        case Script(base, below, above):
            return Script(styled(base, kind), below and styled(below, kind), above and styled(above, kind))
        case Fraction(above, below):
            return Fraction(styled(above, kind), styled(below, kind))
        case Accent() | Root():
            return replace(node, inside=styled(node.inside, kind))
        case Bracket(inside):
            return replace(node, inside=Row(tuple(styled(each, kind) for each in inside.items)))
    return node


@dataclass
class _Reader:
    """Reads tokens one after the other."""

    tokens: list[str]
    text: str
    at: int = field(default=0)

    @property
    def more(self) -> bool:
        return self.at < len(self.tokens)

    def error(self, back: int = 0) -> LinkwrightError:
        self.at -= back
        place = self.tokens[self.at] if self.more else "…"
        return LinkwrightError(
            _(
                'the formula "{text}" has "{sign}", which no form of the report can print; write it '
                "with letters, fractions, roots, indices, brackets, functions, sums, integrals, "
                "matrices and cases, as in LaTeX",
                code="report.no_formula",
                sign=place,
                text=self.text,
            )
        )

    def next(self) -> str:
        if not self.more:
            raise self.error()
        self.at += 1
        return self.tokens[self.at - 1]

    def peek(self) -> str:
        return self.tokens[self.at] if self.more else ""

    def expect(self, token: str) -> None:
        if self.next() != token:
            raise self.error(1)

    def rows(self, ends: Sequence[str]) -> tuple[tuple[Row, ...], ...]:
        """Rows of cells up to one of the ends, filled up to the longest row; an empty last one is none."""
        found: list[list[Row]] = [[]]
        while True:
            found[-1].append(self.row(("&", "\\\\", *ends)))
            if self.peek() == "&":
                self.next()
            elif self.peek() == "\\\\":
                self.next()
                found.append([])
            else:
                break
        if len(found) > 1 and found[-1] == [Row()]:
            found.pop()
        most = max(map(len, found))
        return tuple((*row, *[Row()] * (most - len(row))) for row in found)

    def row(self, ends: Sequence[str]) -> Row:
        """Everything up to one of the ends."""
        items: list[Node] = []
        while self.more and self.tokens[self.at] not in ends:
            token = self.next()
            if token in ("_", "^"):
                items.append(_with_script(items.pop() if items else Row(), token, self.argument()))
            elif token == "'":
                items.append(_with_script(items.pop() if items else Row(), "^", Atom("sign", "′")))
            elif token.removeprefix("\\") not in IGNORED or token == "!":
                items.append(self._node(token))
        return Row(tuple(items))

    def argument(self, *, digit: bool = False) -> Node:
        """What a command or an index applies to; ``digit``: of a number without braces the first digit alone."""
        if digit and len(number := self.peek()) > 1 and number.isdigit():
            self.tokens[self.at : self.at + 1] = [number[0], number[1:]]
        token = self.next()
        if token != "{":
            return self._node(token)
        inside = self.row(("}",))
        self.expect("}")
        return inside.items[0] if len(inside.items) == 1 else inside

    def _name(self) -> Node:
        """An upright name, with its escapes taken out; what is more than a name is read as a formula."""
        self.expect("{")
        begin, found = self.at, ""
        while (token := self.next()) != "}":
            if token in ("_", "^", "{") or (token.startswith("\\") and token not in _PLAIN):
                self.at = begin - 1
                return styled(self.argument(), "upright")
            found += token.removeprefix("\\")
        return Atom("upright", found)

    def _word(self) -> str:
        """The letters between braces."""
        self.expect("{")
        found = ""
        while (token := self.next()) != "}":
            found += token
        return found

    def _node(self, token: str) -> Node:
        if token == "{":
            self.at -= 1
            return self.argument()
        if token.startswith("\\"):
            return self._command(token)
        if token in ("}", "&", "_", "^", "#", "$"):
            raise self.error(1)
        if token in "()":
            return (
                self._bracket()
                if token == "(" and self._closed()
                else Atom("open" if token == "(" else "close", token)
            )
        if token == "~":
            return Atom("space", " ")
        if token[0].isdigit():
            return Atom("number", token)
        if token in _SIGNS:
            return sign(token)
        return letter(token)

    def _closed(self) -> bool:
        """Whether a round bracket that was opened is closed within the same braces."""
        depth, brackets = 0, 1
        for token in self.tokens[self.at :]:
            depth += (token in ("{", r"\left", r"\begin")) - (token in ("}", r"\right", r"\end"))
            if depth < 0 or (not depth and token in ("&", "\\\\")):
                return False
            brackets += 0 if depth else (token == "(") - (token == ")")
            if not brackets:
                return True
        return False

    def _bracket(self) -> Bracket:
        inside = self.row((")",))
        self.expect(")")
        return Bracket(inside)

    def _command(self, token: str) -> Node:
        if token.startswith(("\\text", "\\mbox")) and token.endswith("}"):
            return Atom("bold" if token.startswith("\\textbf") else "upright", token.partition("{")[2][:-1])
        name = token[1:]
        if name in _COMMANDS:
            return _COMMANDS[name](self)
        if name in STYLES:
            return styled(self.argument(), STYLES[name])
        if name in ACCENTS or name in BRACES or name == "overline":
            return Accent(name, self.argument())
        if token in BARE:
            return Atom(*BARE[token])
        if name in FUNCTIONS:
            return Atom("upright", name)
        if name in SYMBOLS:
            text = SYMBOLS[name]
            return Atom("letter" if text.isalpha() else "sign", text)
        if name in SPACES:
            return Atom("space", SPACES[name])
        if token in _PLAIN:
            return Atom("upright", name)
        raise self.error(1)

    def _fraction(self) -> Node:
        return Fraction(self.argument(digit=True), self.argument(digit=True))

    def _binomial(self) -> Node:
        above, below = (Row((self.argument(digit=True),)) for _unused in range(2))
        return Matrix(((above,), (below,)), "(", ")")

    def _root(self) -> Node:
        degree: Node | None = None
        if self.peek() == "[":
            self.next()
            degree = self.row(("]",))
            self.expect("]")
        return Root(self.argument(digit=True), degree)

    def _over(self) -> Node:
        above = self.argument()
        return Limits(self.argument(), None, above)

    def _under(self) -> Node:
        below = self.argument()
        return Limits(self.argument(), below)

    def _arrow(self) -> Node:
        return Limits(Atom("sign", "⟶"), None, self.argument())

    def _delimited(self) -> Node:
        left = self._delimiter()
        inside = self.row((r"\right",))
        self.expect(r"\right")
        return Bracket(inside, left, self._delimiter())

    def _delimiter(self) -> str:
        if (token := self.next()) not in DELIMITERS:
            raise self.error(1)
        return DELIMITERS[token]

    def _matrix(self) -> Node:
        name = self._word().removesuffix("*")
        if name not in MATRICES:
            raise self.error(1)
        left, right, align = MATRICES[name]
        if name in ("array", "alignedat"):
            columns = self._word().replace("|", "")
            align = {"l": "<", "r": ">"}.get(columns, align) if len(set(columns)) == 1 else align
            align = "<" if name == "array" and set(columns[:1]) == {"l"} else align
        rows = self.rows((r"\end",))
        self.expect(r"\end")
        self._word()
        return Matrix(rows, left, right, align)


_COMMANDS = {
    "frac": _Reader._fraction,
    "dfrac": _Reader._fraction,
    "tfrac": _Reader._fraction,
    "cfrac": _Reader._fraction,
    "binom": _Reader._binomial,
    "sqrt": _Reader._root,
    "mathrm": _Reader._name,
    "operatorname": _Reader._name,
    "overset": _Reader._over,
    "stackrel": _Reader._over,
    "underset": _Reader._under,
    "xrightarrow": _Reader._arrow,
    "left": _Reader._delimited,
    "begin": _Reader._matrix,
}


def _with_script(base: Node, token: str, part: Node) -> Node:
    """A sign with one more index or exponent; primes and exponents share a place."""
    match base:
        case Atom("upright", text) if text in BELOW:
            base = Limits(base)
        case Accent(mark) if mark in BRACES:
            base = Limits(base)
    own = base if isinstance(base, Script | Limits) else Script(base)
    if token == "_":
        return replace(own, below=part if own.below is None else Row((own.below, part)))
    return replace(own, above=part if own.above is None else Row((own.above, part)))


#: Binary signs and relations: a line may break before them.
SIGNS = "+-−=≤≥≈≠"


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
    if len(sides) == 1:
        for number, row in enumerate(lines(sides[0], widest)):
            yield Line("further" if number else "left", row)
        return
    if sum(width(row) for row in sides) + 1.25 * (len(sides) - 1) <= widest:
        first, *rest = sides
        yield Line("left", Row((*first.items, *(each for row in rest for each in (EQUAL, *row.items)))))
        return
    first, *rest = sides
    yield Line("left", first)
    place, margin = ("below", 1.5) if width(first) > left else ("right", width(first) + 1.5)
    room = widest - margin - 1.0
    for side in _joined(rest, room):
        for number, row in enumerate(lines(side, room)):
            yield Line("further", row) if number else Line(place, Row((EQUAL, *row.items)))
        place = "sign"


def _joined(sides: Sequence[Row], room: float) -> Iterator[Row]:
    """Short sides that follow each other share a line."""
    held: Row | None = None
    for side in sides:
        if held is not None and width(held) + width(side) + 1.25 <= room:
            held = Row((*held.items, EQUAL, *side.items))
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
    """Whether the part is only signs and opening brackets so far: the next sign is a leading one."""
    return all(isinstance(each, Atom) and (each.kind == "sign" or each.text == "(") for each in part)


def _opened(row: Row, widest: float) -> Iterator[Node]:
    for item in row.items:
        if isinstance(item, Bracket) and width(item) > 0.6 * widest:
            yield from (Atom("open", item.left),) if item.left else ()
            yield from _opened(item.inside, widest)
            yield from (Atom("close", item.right),) if item.right else ()
        else:
            yield item


def large(node: Node) -> bool:
    """Whether it is the sign of a sum or an integral."""
    return isinstance(node, Atom) and node.text in LARGE.values()


def relation(node: Node) -> bool:
    """Whether it is a sign between two sides."""
    return isinstance(node, Atom) and node.kind == "sign" and node.text in ("=", "<", ">", *RELATIONS.values())


def width(node: Node | None, size: float = 1.0) -> float:
    """Roughly how wide a formula is printed, in em."""
    match node:
        case None:
            return 0.0
        case Atom("space", text):
            return size * {"quad": 1.0, "qquad": 2.0}.get(text, 0.2)
        case Atom("sign", text):
            return size * (1.25 if text in "+−" or relation(node) else 1.1 if large(node) else 0.35)
        case Atom(_, text):
            return size * 0.54 * cells(text)
        case Row(items):
            return sum(width(each, size) for each in items)
        case Fraction(above, below):
            return max(width(above, size), width(below, size)) + 0.3 * size
        case Root(inside, degree):
            return width(inside, size) + width(degree, 0.5 * size) + 0.9 * size
        case Script(base, below, above):
            return width(base, size) + max(width(below, 0.7 * size), width(above, 0.7 * size))
        case Limits(base, below, above):
            return max(width(base, size), width(below, 0.7 * size), width(above, 0.7 * size))
        case Accent(_, inside):
            return width(inside, size)
        case Bracket(inside):
            return width(inside, size) + 0.8 * size
        case Matrix(rows, left, right):
            columns = (max(width(row[i], size) for row in rows) for i in range(len(rows[0])))
            return sum(columns) + size * (len(rows[0]) - 1 + 0.5 * (bool(left) + bool(right)))
