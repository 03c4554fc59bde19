"""Formulas as they are written on a line, ``√(Rx² + Ry²)``: read as they are printed, and filled with numbers.

Names: a letter with its index behind it (``Rx``, ``ρw``, ``T1``, ``m_b``), words upright; ``·`` and ``×`` multiply,
what precedes ``/`` since the last quotient is its numerator, one factor behind it the denominator.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Mapping, Sequence

from linkwright.equations.notation import (
    COMMA,
    LETTER,
    RAISED,
    THIN,
    TIMES,
    WIDE,
    Atom,
    Bracket,
    Fraction,
    Node,
    Root,
    Row,
    Script,
    group,
    letter,
    name,
    number,
    quantity,
    raised,
    row,
    sign,
    upright,
)
from linkwright.errors import LinkwrightError
from linkwright.words import _

#: Around a number with its unit, which is one factor.
OPEN, CLOSE = "\ue010", "\ue011"
FUNCTIONS = ("cos", "sin", "tan", "arctan", "arccos", "arcsin", "atan2", "ln", "exp", "min", "max", "det")
_RELATIONS = "=≤≥<>≈→∈"
_SIGNS = "+−-±∓"
_BRACKETS = {"(": ")", "[": "]", "|": "|"}
#: Prefix operators.
#: What a symbol with an index does not hold.
_OPERATION = re.compile(r"[·/=()√]| [-+−] ")
_PREFIX = {"Σ": "∑", "∑": "∑", "∫": "∫", "∇": "∇", "∂": "∂", "∠": "∠"}
_TOKEN = re.compile(
    rf"{OPEN}[^{CLOSE}]*{CLOSE}"
    r"|\d+(?:\.\d+)?(?:e[+-]?\d+)?°?"
    r"|[⁰¹²³⁴⁵⁶⁷⁸⁹⁻ⁿᵀ]+"
    r"|[Σ∑∫∇∂∠]"
    rf"|{LETTER}(?:{LETTER}|[\u0300-\u030f\u20d7\d_₀₁₂₃₄₅₆₇₈₉]|\.(?={LETTER}))*[′″'↑↓∞]*"
    r"|\S"
)


def filled(text: str, values: Mapping[str, str]) -> str:
    """The formula with the names that have a value replaced by it; empty where there is none to put in."""
    tokens = _tokens(text)
    if not any(token in values for token in tokens):
        return ""
    parts, at = [], 0
    spaced = normal(text)
    for before, token, behind in zip(["", *tokens[:-1]], tokens, [*tokens[1:], ""], strict=True):
        found = spaced.index(token, at)
        parts.append(spaced[at:found])
        tight = behind[:1] in RAISED or behind == "^" or before == "/"
        parts.append(_factor(values[token], tight=tight) if token in values else token)
        at = found + len(token)
    parts.append(spaced[at:])
    return "".join(parts)


def _factor(value: str, *, tight: bool) -> str:
    """A number as a factor: as one sign where it has a unit; in brackets where it is negative, or has a unit and is
    ``tight``: raised to a power, or what something is divided by."""
    bracketed = f"{OPEN}{value}{CLOSE}" if " " in value else value
    return f"({bracketed})" if value.startswith(("-", "−")) or (tight and bracketed != value) else bracketed


def names(text: str) -> list[str]:
    """The names of a formula, e and π among them."""
    return [each for each in _tokens(text) if each[0].isalpha() and each not in (*FUNCTIONS, *_PREFIX)]


def of_file(text: str) -> str:
    """An expression of a file as formulas are written: ``2*sqrt(x)`` as ``2·√(x)``."""
    for old, new in (("**", "^"), ("*", "·"), ("<=", "≤"), (">=", "≥"), ("==", "=")):
        text = text.replace(old, new)
    text = re.sub(r"(?<![≤≥])\s*=\s*", " = ", text)
    text = re.sub(r"\bsqrt\(", "√(", text)
    text = re.sub(r"\bpi\b", "π", text)
    return re.sub(r"(?<![·/^(\s])\s*-\s*|\s+-\s+", " − ", text)


def measured(text: str) -> str:
    """A number with its unit as one sign of a formula."""
    return f"{OPEN}{text}{CLOSE}"


def plain(text: str) -> str:
    """A filled formula as plain text."""
    return text.replace(OPEN, "").replace(CLOSE, "")


def read(text: str) -> Row:
    """A formula as it is printed; raises LinkwrightError for what is none."""
    reader = _Reader(_tokens(text), text)
    found = reader.relation()
    if reader.here:
        raise reader.error()
    return row(found)


def sides(text: str) -> tuple[Row, ...]:
    """The sides of an equation on a line."""
    return tuple(read(part) for part in re.split(r"\s=\s", text.strip()))


def read_name(text: str) -> Row:
    """What a result is called: a symbol with any names in its index, a formula, or words, which stand upright."""
    if text[:1] == "∠":
        return row((sign("∠"), read_name(text[1:])))
    head, _unused, index = text.partition("_")
    if head.isalnum() and head[0].isalpha() and head[0] not in _PREFIX and not _OPERATION.search(index):
        return row((name(text),))
    if not (WIDE.search(text) or re.search(r"[a-z]{4,} |[a-z] [a-z]", text)):
        try:
            return read(text)
        except LinkwrightError:
            pass
    return Row((upright(text),))


def normal(text: str) -> str:
    """A text with accents separated from their letters, as formulas are read."""
    return unicodedata.normalize("NFD", text)


def _tokens(text: str) -> list[str]:
    return _TOKEN.findall(normal(text))


class _Reader:
    """Reads tokens one after the other; ``ends``: the bracket that closes what is being read."""

    def __init__(self, tokens: list[str], text: str) -> None:
        self.tokens, self.text, self.at = tokens, text, 0

    def error(self) -> LinkwrightError:
        return LinkwrightError(
            _(
                'the formula "{text}" has "{sign}", which no form of the report can print; write it '
                "with letters, fractions, roots, indices, brackets, functions, sums, integrals, "
                "matrices and cases, as in LaTeX",
                code="report.no_formula",
                sign=self.here or "…",
                text=plain(self.text),
            )
        )

    @property
    def here(self) -> str:
        return self.tokens[self.at] if self.at < len(self.tokens) else ""

    def take(self) -> str:
        if not self.here:
            raise self.error()
        self.at += 1
        return self.tokens[self.at - 1]

    def more(self, ends: str) -> bool:
        return bool(self.here) and self.here not in ends

    def relation(self, ends: str = "") -> list[Node]:
        """Sums joined by relations and commas."""
        found = self.sum(ends)
        while self.more(ends):
            if self.here not in _RELATIONS + ",;:…":
                raise self.error()
            found.append(sign(self.take()))
            if found[-1] in (COMMA, sign(";"), sign(":")):
                found.append(Atom("space", ";"))
            if self.more(ends):
                found += self.sum(ends)
        return found

    def sum(self, ends: str) -> list[Node]:
        found = self._sign()
        found += self.product(ends)
        while self.here and self.here in _SIGNS:
            found += [*self._sign(), *self.product(ends)]
        return found

    def _sign(self) -> list[Node]:
        return [sign(self.take())] if self.here and self.here in _SIGNS else []

    def product(self, ends: str) -> list[Node]:
        """Factors; a quotient takes all factors since the last one above its line."""
        done, above = list[Node](), [self.power(ends)]
        while self.more(ends + _SIGNS + _RELATIONS + ",;:…)]}|"):
            if self.here in "·×*":
                times = sign("×") if self.take() == "×" else TIMES
                (above or done).append(times)
                above.append(self.power(ends))
            elif self.here == "/":
                self.take()
                done.append(Fraction(group(_bare(above)), group(_bare([self.power(ends)]))))
                above = []
            else:
                if self.here != "(" or not self.tokens[self.at - 1][0].isalpha():
                    (above or done).append(THIN)
                above.append(self.power(ends))
        return done + above

    def power(self, ends: str) -> Node:
        base = self.factor(ends)
        while self.here:
            if self.here[0] in RAISED:
                base = raised(base, self._raised())
            elif self.here == "_":
                self.take()
                base = Script(base, upright(self.take()))
            elif self.here == "^":
                self.take()
                base = raised(base, group([*self._sign(), *_bare([self.factor(ends)])]))
            else:
                break
        return base

    def _raised(self) -> Node:
        text = "".join(RAISED[c] for c in self.take())
        return letter(text) if text.isalpha() else group(number(text))

    def factor(self, ends: str) -> Node:
        token = self.take()
        if token[0] == OPEN:
            value, _unused, unit = token[1:-1].strip().partition(" ")
            return group(quantity(value, unit))
        if token[0].isdigit():
            return group(number(token))
        if token in _BRACKETS:
            inside = self.relation(_BRACKETS[token])
            if self.here != _BRACKETS[token]:
                raise self.error()
            return Bracket(row(inside), token, self.take())
        if token == "√":
            return Root(group(_bare([self.factor(ends)])))
        if token in _PREFIX:
            return self.applied(sign(_PREFIX[token]), ends)
        if token in FUNCTIONS:
            return self.applied(
                raised(upright(token), self._raised()) if self.here[:1] in RAISED else upright(token), ends
            )
        if token[0].isalpha():
            return name(token)
        self.at -= 1
        raise self.error()

    def applied(self, to: Node, ends: str) -> Node:
        """A function or a sum with what it applies to."""
        return Row((to, self.power(ends))) if self.more(ends) else to


def _bare(nodes: Sequence[Node]) -> Sequence[Node]:
    """A factor without the brackets around all of it."""
    return (
        nodes[0].inside.items if len(nodes) == 1 and isinstance(nodes[0], Bracket) and nodes[0].left == "(" else nodes
    )
