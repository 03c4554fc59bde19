"""Formulas as plain text and as LaTeX, with their symbols or with the numbers put in."""

from __future__ import annotations

from collections.abc import Callable

from linkwright.worked.digits import put_in
from linkwright.worked.terms import Term

Shown = Callable[[Term], str]
_LEVEL = {"sum": 1, "product": 2, "quotient": 2, "square": 3}


def plain(term: Term, digits: int | None = None) -> str:
    """Symbols, or with ``digits`` the numbers put in, in plain text."""
    return _Plain(digits).show(term)


def latex(term: Term, digits: int | None = None) -> str:
    """The same in LaTeX."""
    return _Latex(digits).show(term)


class _Plain:
    dot = "·"

    def __init__(self, digits: int | None) -> None:
        self.digits = digits

    def leaf(self, term: Term) -> str:
        if term.op == "symbol" and self.digits is None:
            return self.name(term)
        return put_in(term, self.digits or 15)

    def name(self, term: Term) -> str:
        return term.plain

    def show(self, term: Term, level: int = 0, *, first: bool = True) -> str:
        """``level``: what surrounds it binds this tightly; ``first``: nothing stands before it there."""
        if not term.args:
            text = self.leaf(term)
            bare = not text.startswith("-") or level == 0 or (first and level == 1)
            return text if bare else self.wrap(text)
        text = getattr(self, f"show_{term.op}", self.function)(term)
        own = _LEVEL.get(term.op, 4)
        leads = first and level == 1 and own >= 1
        return self.wrap(text) if own < level or (own == level == 1 and not leads) else text

    def wrap(self, text: str) -> str:
        return f"({text})"

    def show_sum(self, term: Term) -> str:
        parts = []
        for i, (each, sign) in enumerate(zip(term.args, term.signs, strict=True)):
            sub = self.show(each, 1 if sign > 0 else 2, first=i == 0 and sign > 0)
            parts.append(("" if i == 0 else " + ") + sub if sign > 0 else ("-" if i == 0 else " - ") + sub)
        return "".join(parts)

    def show_product(self, term: Term) -> str:
        return self.dot.join(self.show(each, 2, first=False) for each in term.args)

    def show_quotient(self, term: Term) -> str:
        above, below = term.args
        return f"{self.show(above, 2, first=False)}/{self.show(below, 3, first=False)}"

    def show_square(self, term: Term) -> str:
        return f"{self.show(term.args[0], 4, first=False)}²"

    def show_root(self, term: Term) -> str:
        return f"√({self.show(term.args[0])})"

    def show_size(self, term: Term) -> str:
        return f"|{self.show(term.args[0])}|"

    def function(self, term: Term) -> str:
        return f"{term.op}({', '.join(self.show(each) for each in term.args)})"


class _Latex(_Plain):
    dot = r"\,"

    def __init__(self, digits: int | None) -> None:
        super().__init__(digits)
        self.dot = r"\cdot " if digits is not None else r"\,"

    def leaf(self, term: Term) -> str:
        text = super().leaf(term).replace("°", r"^\circ")
        if "e" in text and (term.op == "number" or self.digits is not None):
            base, _, power = text.partition("e")
            return rf"{base}\cdot 10^{{{power}}}"
        return text

    def name(self, term: Term) -> str:
        return term.latex

    def wrap(self, text: str) -> str:
        return rf"\left({text}\right)"

    def show_quotient(self, term: Term) -> str:
        above, below = term.args
        return rf"\frac{{{self.show(above)}}}{{{self.show(below)}}}"

    def show_square(self, term: Term) -> str:
        return f"{self.show(term.args[0], 4, first=False)}^2"

    def show_root(self, term: Term) -> str:
        return rf"\sqrt{{{self.show(term.args[0])}}}"

    def show_size(self, term: Term) -> str:
        return rf"\left|{self.show(term.args[0])}\right|"

    def function(self, term: Term) -> str:
        name = r"\operatorname{atan2}" if term.op == "atan2" else rf"\{term.op}"
        return rf"{name}\left({', '.join(self.show(each) for each in term.args)}\right)"
