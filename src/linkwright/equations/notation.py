"""A formula as it is printed, in whatever medium: signs, fractions, roots, indices, brackets, matrices."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable
from dataclasses import dataclass, replace


@dataclass(frozen=True)
class Atom:
    """One sign: ``kind`` is ``letter`` (slanted), ``upright``, ``bold``, ``slanted bold``, ``script``, ``double``,
    ``number``, ``sign``, ``space``, or ``open`` and ``close`` (a delimiter by itself)."""

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
    """A root, a square one without ``degree``."""

    inside: Node
    degree: Node | None = None


@dataclass(frozen=True)
class Script:
    """A sign with a subscript and a superscript."""

    base: Node
    below: Node | None = None
    above: Node | None = None


@dataclass(frozen=True)
class Limits:
    """A sign with what is centred below and above it."""

    base: Node
    below: Node | None = None
    above: Node | None = None


@dataclass(frozen=True)
class Accent:
    """A sign with a dot, an arrow, a bar or a brace over or under it; ``mark`` is the command's name."""

    mark: str
    inside: Node


@dataclass(frozen=True)
class Bracket:
    """A group in brackets; an empty side has none."""

    inside: Row
    left: str = "("
    right: str = ")"


@dataclass(frozen=True)
class Matrix:
    """Rows of equally many cells between delimiters; ``align`` of the columns: ``<``, ``^``, ``>``, or ``=``: right
    and left in turn, as equations below each other."""

    rows: tuple[tuple[Row, ...], ...]
    left: str = ""
    right: str = ""
    align: str = "^"


Node = Atom | Row | Fraction | Root | Script | Limits | Accent | Bracket | Matrix


def sign(text: str) -> Atom:
    """A sign by itself, a hyphen as a minus."""
    return Atom("sign", "−" if text == "-" else text)


def upright(text: str) -> Atom:
    """Words within a formula."""
    return Atom("upright", text)


def letter(text: str) -> Atom:
    """One letter, slanted where it is Latin or small Greek."""
    slanted = (text.isascii() and text.isalpha()) or "α" <= text <= "ω"
    return Atom("letter" if slanted else "upright", text)


THIN, TIMES, EQUAL, COMMA = Atom("space", ","), sign("⋅"), sign("="), sign(",")


def row(nodes: Iterable[Node]) -> Row:
    """Formulas side by side, rows among them dissolved."""
    return Row(tuple(each for node in nodes for each in (node.items if isinstance(node, Row) else (node,))))


def group(nodes: Iterable[Node]) -> Node:
    """Formulas side by side as one part of another."""
    found = row(nodes)
    return found.items[0] if len(found.items) == 1 else found


def number(text: str) -> tuple[Node, ...]:
    """A number, powers of ten written out: ``-2.5e-3``, ``30°``."""
    base, e, power = text.rstrip("°").partition("e")
    found: list[Node] = [sign("-")] if base[:1] in "-−" else []
    found.append(Atom("number", base.lstrip("-−")))
    if e:
        found += [TIMES, Script(Atom("number", "10"), None, group(number(str(int(power)))))]
    if text.endswith("°"):
        found[-1] = raised(found[-1], sign("∘"))
    return tuple(found)


def raised(base: Node, above: Node) -> Script:
    """A sign with an exponent, behind the one that it has."""
    own = base if isinstance(base, Script) else Script(base)
    return replace(own, above=above if own.above is None else Row((own.above, above)))


def quantity(value: str, unit: str = "") -> tuple[Node, ...]:
    """A number with its unit."""
    if unit == "°":
        return number(f"{value}°")
    return (*number(value), THIN, upright(unit)) if unit else number(value)


# names ------------------------------------------------------------------------------------------
LETTER = r"[^\W\d_⁰¹²³⁴⁵⁶⁷⁸⁹ⁿᵀᵗᵏᵈ₀₁₂₃₄₅₆₇₈₉]"
RAISED = dict(zip("⁰¹²³⁴⁵⁶⁷⁸⁹⁻ⁿᵀᵗᵏᵈ", "0123456789−nTtkd", strict=True))
_LOWERED = str.maketrans("₀₁₂₃₄₅₆₇₈₉", "0123456789")
_ACCENTS = {"\u0304": "bar", "\u0305": "bar", "\u0307": "dot", "\u0308": "ddot", "\u20d7": "vec"}
_HEAD = re.compile(rf"((?:{LETTER}|[\u0300-\u030f\u20d7])+)([^'′″{''.join(RAISED)}]*)(['′″{''.join(RAISED)}]*)")
#: What an index names: points side by side, a number, one letter; with a component behind it.
_POINTS = re.compile(r"((?:[A-Z]\d*['*]?)+|\d+|\w)([xy]?)", re.ASCII)
_POINT = re.compile(r"[A-Z]\d*['*]?|\d+|.", re.ASCII)
_COMPONENT = re.compile(r"(.*[A-Z\d*'])([xy])", re.ASCII)
#: Characters of words that are no symbols.
WIDE = re.compile(r"[\u2e80-\u9fff\uf900-\ufaff]")
#: Greek letters by their names, as expressions of files have them.
_GREEK = dict(
    zip(
        (
            "alpha",
            "beta",
            "gamma",
            "delta",
            "epsilon",
            "zeta",
            "eta",
            "theta",
            "kappa",
            "lambda",
            "mu",
            "nu",
            "xi",
            "rho",
            "sigma",
            "tau",
            "phi",
            "psi",
            "omega",
            "pi",
        ),
        "αβγδεζηθκλμνξρστφψωπ",
        strict=True,
    )
)


def name(text: str) -> Node:
    """A symbol by its name on a line, ``φ1``, ``l_AB``, ``F_A,2x``, ``ṡ_B``, ``Rx``, ``A.Fx``: letter with accents,
    primes and index; several Greek letters as a product; words upright."""
    head, _, low = unicodedata.normalize("NFD", text).partition("_")
    if "." in head:
        return upright(text) if low else _owned(head)
    found = _HEAD.fullmatch(head)
    if found is None or WIDE.search(head):
        return indexed(upright(head), low)
    letters, rest = re.sub(r"[\u0300-\u030f\u20d7]", "", found[1]), found[2].translate(_LOWERED)
    above = [sign("′") if c in "'′" else label(RAISED[c]) for c in found[3].replace("″", "′′")]
    if low and (end := re.search(r"(?<![A-Z])['′″]+$", low)):
        above, low = [sign("′")] * len(end[0]), low[: end.start()]
    if not rest and len(letters) > 1:
        greek = letters[0] == "π" or any("α" <= c <= "ω" for c in letters[1:])
        if greek or (len(letters) == 2 and letters[0] in "Δd") or (letters.isupper() and letters.isascii()):
            *before, last = map(letter, letters)
            spaced = [each for node in before for each in ((node, THIN) if greek else (node,))]
            return row((*spaced, _exponent(indexed(last, low), above)))
    if len(letters) > 1 and not low and (letters[0].isupper() or not letters[0].isascii()):
        letters, rest = letters[0], letters[1:] + rest
    letters = _GREEK.get(letters, letters)
    base: Node = letter(letters) if len(letters) == 1 else upright(letters)
    for mark in re.findall(r"[\u0300-\u030f\u20d7]", found[1]):
        base = Accent(_ACCENTS.get(mark, "bar"), base)
    return _exponent(indexed(base, ",".join(filter(None, (rest, low)))), above)


def _owned(text: str) -> Node:
    """What belongs to something: ``A.Fx`` as F with the index Ax."""
    owner, _, what = text.rpartition(".")
    if len(what) > 3:
        return upright(text)
    mark = "," if len(owner) > 2 and what[1:] else ""
    return Script(letter(what[0]), upright(owner + mark + what[1:]))


def _exponent(base: Node, above: Iterable[Node]) -> Node:
    for each in above:
        base = raised(base, each)
    return base


def indexed(base: Node, low: str) -> Node:
    """A sign with an index by its text: parts separated by commas, arrows between numbers."""
    parts = [each for part in re.split(r"([,→])", low) if part for each in _part(part)]
    return Script(base, group(parts)) if parts else base


def _part(text: str) -> Iterable[Node]:
    """One part of an index: points and numbers one by one, other names upright, a component behind them."""
    if text in ",→":
        return (sign(text),)
    if found := _POINTS.fullmatch(text):
        names, component = [label(each) for each in _POINT.findall(found[1])], found[2]
        if len(names) > 1 and any(each.kind == "upright" for each in names):
            names = [upright(found[1])]
    elif found := _COMPONENT.fullmatch(text):
        names, component = [upright(found[1])], found[2]
    else:
        return (label(text),)
    return (*names, letter(component)) if component else names


def label(text: str) -> Atom:
    """A name as an index."""
    return Atom("number", text) if text.isdigit() else letter(text) if len(text) == 1 else upright(text)
