"""Formulas as they are written on a line, ``√(Rx² + Ry²)``, read and set as LaTeX, and filled with numbers.

Names: a letter with its index behind it (``Rx``, ``ρw``, ``T1``, ``m_b``), words upright; ``·`` and ``×`` multiply, what
stands before ``/`` since the last product sign of a quotient is its numerator, one factor behind it the denominator.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Mapping

from linkwright.errors import LinkwrightError

#: Around a number with its unit, which is one factor.
OPEN, CLOSE = "\ue010", "\ue011"
FUNCTIONS = ("cos", "sin", "tan", "arctan", "arccos", "arcsin", "atan2", "ln", "exp", "min", "max")
_KNOWN = ("cos", "sin", "tan", "arctan", "ln", "exp", "min", "max")
_ACCENTS = {"\u0304": "bar", "\u0305": "bar", "\u0307": "dot", "\u0308": "ddot"}
_RAISED = dict(zip("⁰¹²³⁴⁵⁶⁷⁸⁹⁻ⁿᵀ", "0123456789-nT", strict=True))
_RELATIONS = {
    "∧": r",\quad ",
    "=": "=",
    "≤": r"\le ",
    "≥": r"\ge ",
    "<": "<",
    ">": ">",
    "≈": r"\approx ",
    "→": r"\to ",
    "∈": "∈",
}
_SIGNS = {"+": "+", "−": "-", "-": "-", "±": r"\pm ", "∓": "∓"}
_PREFIX = {"Σ": r"\sum ", "∑": r"\sum ", "∫": r"\int ", "∇": "∇", "∂": r"\partial ", "∠": r"\angle "}
_LOWERED = dict(zip("₀₁₂₃₄₅₆₇₈₉", "0123456789", strict=True))
_LETTER = r"[^\W\d_⁰¹²³⁴⁵⁶⁷⁸⁹ⁿᵀ₀₁₂₃₄₅₆₇₈₉]"
_TOKEN = re.compile(
    rf"{OPEN}[^{CLOSE}]*{CLOSE}"
    r"|\d+(?:\.\d+)?(?:e[+-]?\d+)?°?"
    r"|[⁰¹²³⁴⁵⁶⁷⁸⁹⁻ⁿᵀ]+"
    r"|[Σ∑∫∇∂∠]"
    rf"|{_LETTER}(?:{_LETTER}|[\u0300-\u030f\d_₀₁₂₃₄₅₆₇₈₉]|\.(?={_LETTER}))*[′″'↑↓∞]*"
    r"|\S"
)


#: Characters of words that are no symbols.
_WIDE = re.compile(r"[\u2e80-\u9fff\uf900-\ufaff]")


def filled(text: str, values: Mapping[str, str]) -> str:
    """The formula with the names that have a value replaced by it; empty where there is none to put in."""
    tokens = _tokens(text)
    if not any(token in values for token in tokens):
        return ""
    parts, at = [], 0
    spaced = normal(text)
    for token in tokens:
        found = spaced.index(token, at)
        parts.append(spaced[at:found])
        parts.append(_factor(values[token]) if token in values else token)
        at = found + len(token)
    return "".join(parts)


def _factor(value: str) -> str:
    """A number as a factor: in brackets where it is negative, as one sign where it has a unit."""
    whole = f"{OPEN}{value}{CLOSE}" if " " in value else value
    return f"({whole})" if value.startswith(("-", "−")) else whole


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


def latex(text: str) -> str:
    """LaTeX of a formula; raises LinkwrightError for what is none."""
    reader = _Reader(_tokens(text), text)
    found = reader.relation()
    if reader.at < len(reader.tokens):
        raise reader.error()
    return found


def latex_symbol(text: str) -> str:
    """LaTeX of what a result is called: a symbol, or words, which stand upright."""
    if _WIDE.search(text) or re.search(r"[a-z]{4,} |[a-z] [a-z]", text):
        return upright(text)
    try:
        return latex(text)
    except LinkwrightError:
        return upright(text)


def upright(text: str) -> str:
    """Words within a formula."""
    return rf"\mathrm{{{re.sub(r'([ {}%&#_$])', lambda found: chr(92) + found[1], text)}}}"


def sides(text: str) -> tuple[str, ...]:
    """LaTeX of the sides of an equation on a line."""
    return tuple(latex(part) for part in re.split(r"\s=\s", text.strip()))


def normal(text: str) -> str:
    """A text with accents apart from their letters, as formulas are read."""
    return unicodedata.normalize("NFD", text)


def _tokens(text: str) -> list[str]:
    return _TOKEN.findall(normal(text))


class _Reader:
    """Reads tokens one after the other."""

    def __init__(self, tokens: list[str], text: str) -> None:
        self.tokens, self.text, self.at = tokens, text, 0

    def error(self) -> LinkwrightError:
        sign = self.tokens[self.at] if self.at < len(self.tokens) else "…"
        return LinkwrightError("report.no_formula", sign=sign, text=plain(self.text))

    @property
    def here(self) -> str:
        return self.tokens[self.at] if self.at < len(self.tokens) else ""

    def take(self) -> str:
        if not self.here:
            raise self.error()
        self.at += 1
        return self.tokens[self.at - 1]

    def relation(self, ends: str = "") -> str:
        """Sums joined by relations and commas."""
        found = self.sum(ends)
        while self.here and self.here not in ends:
            if self.here in _RELATIONS:
                found += f" {_RELATIONS[self.take()]}"
            elif self.here in ",;:":
                found += rf"{self.take()}\;"
            elif self.here == "…":
                self.take()
                found += r" \ldots "
            else:
                raise self.error()
            if self.here and self.here not in ends:
                found += f" {self.sum(ends)}"
        return found

    def sum(self, ends: str) -> str:
        found = ""
        if self.here in _SIGNS:
            found = _SIGNS[self.take()]
        found += self.product(ends)
        while self.here in _SIGNS:
            found += f" {_SIGNS[self.take()]} {self.product(ends)}"
        return found

    def product(self, ends: str) -> str:
        """Factors; a quotient takes all factors since the last one above its line."""
        done, above = "", [self.power(ends)]
        while self.here and self.here not in ends and self.here not in _SIGNS:
            if self.here in "·×*":
                sign = r"\times " if self.take() == "×" else r"\cdot "
                if not above:
                    done, sign = done + sign, ""
                above += [sign, self.power(ends)]
            elif self.here == "/":
                self.take()
                below = self.power(ends)
                done += rf"\frac{{{_bare(''.join(above), above)}}}{{{_bare(below, [below])}}}"
                above = []
            elif self.here in _RELATIONS or self.here in ",;:…)]}|":
                break
            else:
                of = self.here == "(" and self.tokens[self.at - 1][0].isalpha()
                above += ["" if of else r"\,", self.power(ends)]
        return done + "".join(above)

    def power(self, ends: str) -> str:
        base = self.factor(ends)
        while self.here:
            if self.here[0] in _RAISED:
                base += f"^{{{''.join(_RAISED[c] for c in self.take())}}}"
            elif self.here == "_":
                self.take()
                base += f"_{{{upright(self.take())}}}"
            elif self.here == "^":
                self.take()
                sign = _SIGNS[self.take()] if self.here in _SIGNS else ""
                inside = sign + self.factor(ends)
                base += f"^{{{_bare(inside, [inside])}}}"
            else:
                return base
        return base

    def factor(self, ends: str) -> str:
        token = self.take()
        if token[0] == OPEN:
            return quantity(token[1:-1])
        if token[0].isdigit():
            return number(token)
        if token == "(":
            return rf"\left({self.closed(')')}\right)"
        if token == "[":
            return rf"\left[{self.closed(']')}\right]"
        if token == "|":
            return rf"\left|{self.closed('|')}\right|"
        if token == "√":
            inside = self.factor(ends)
            return rf"\sqrt{{{_bare(inside, [inside])}}}"
        if token in _PREFIX:
            return _PREFIX[token] + (self.power(ends) if self.here and self.here not in ends else "")
        if token in FUNCTIONS:
            return self.applied(token, ends)
        if token[0].isalpha():
            return name(token)
        self.at -= 1
        raise self.error()

    def closed(self, end: str) -> str:
        found = self.relation(end)
        if self.take() != end:
            self.at -= 1
            raise self.error()
        return found

    def applied(self, token: str, ends: str) -> str:
        """A function with its argument; a power may stand between."""
        found = rf"\{token}" if token in _KNOWN else rf"\operatorname{{{token}}}"
        if self.here and self.here[0] in _RAISED:
            found += f"^{{{''.join(_RAISED[c] for c in self.take())}}}"
        return f"{found} {self.power(ends)}" if self.here and self.here not in ends else found


def _bare(text: str, parts: list[str]) -> str:
    """A factor without the brackets around the whole of it."""
    if len(parts) == 1 and text.startswith(r"\left(") and text.endswith(r"\right)"):
        inside = text[len(r"\left(") : -len(r"\right)")]
        depth = 0
        for found in re.findall(r"\\left|\\right", inside):
            depth += 1 if found == r"\left" else -1
            if depth < 0:
                return text
        return inside
    return text


def number(text: str) -> str:
    """A number, powers of ten written out."""
    base, e, power = text.partition("e")
    degrees = base.endswith("°") or power.endswith("°")
    base, power = base.rstrip("°"), power.rstrip("°")
    found = rf"{base}\cdot 10^{{{int(power)}}}" if e else base
    return found + (r"^\circ" if degrees else "")


def quantity(text: str) -> str:
    """A number with its unit."""
    value, _, unit = text.strip().partition(" ")
    sign = "-" if value[:1] in "-−" else ""
    found = sign + number(value.lstrip("-−"))
    return rf"{found}\,{upright(unit)}" if unit else found


def name(text: str) -> str:
    """A name as a symbol: its letter with accents, primes and index; several Greek letters as a product."""
    if "." in text:
        owner, _, what = text.rpartition(".")
        mark = "," if len(owner) > 2 and what[1:] else ""
        return rf"{what[0]}_{{{upright(owner + mark + what[1:])}}}"
    if _WIDE.search(text):
        return upright(text)
    stem = re.match(rf"(?:{_LETTER}|[\u0300-\u030f])+", text)
    assert stem is not None
    letters = re.sub(r"[\u0300-\u030f]", "", stem[0])
    marks = "".join(re.findall(r"[′″']", text)).replace("″", "′′").replace("'", "′")
    rest = "".join(_LOWERED.get(c, c) for c in re.sub(r"[′″']", "", text[stem.end() :]))
    if len(letters) > 1 and letters[0] in "Δd" and not rest and len(letters) == 2:
        return letters[0] + letters[1] + _primes(marks)
    if len(letters) > 1 and any("α" <= c <= "ω" for c in letters[1:]) and not rest:
        return r"\,".join(letters) + _primes(marks)
    if len(letters) > 1 and "_" not in rest and (letters[0].isupper() or not letters[0].isascii()):
        if letters.isupper() and letters.isascii() and not rest:
            return letters
        letters, rest = letters[0], letters[1:] + rest
    found = letters if len(letters) == 1 else upright(letters)
    for mark in re.findall(r"[\u0300-\u030f]", stem[0]):
        found = rf"\{_ACCENTS.get(mark, 'bar')}{{{found}}}"
    index = rest.lstrip("_.")
    if index:
        found += f"_{{{index if len(index) == 1 or index.isdigit() else upright(index)}}}"
    return found + _primes(marks)


def _primes(marks: str) -> str:
    return f"^{{{marks}}}" if marks else ""
