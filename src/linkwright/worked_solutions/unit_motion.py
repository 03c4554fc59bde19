"""Symbols of motions not the mechanism's own: per unit rate of one input, and without accelerations of inputs."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from linkwright.dynamics.states import FoundMotion
from linkwright.equations.terms import ONE, ZERO, Pair, Term, symbol
from linkwright.words import Translate
from linkwright.worked_solutions.symbols import Slide, SymbolTable


class MarkedTable(SymbolTable):
    """Symbols of a motion that is not the mechanism's own: other letters for what moves.

    ``turning``, ``moving``: letters of rates of links and of points; ``mark``: behind their indices; ``rates``: the
    terms of a driver's rates, where they are not symbols.
    """

    def __init__(self, motion: FoundMotion, translate: Translate, letters: Mapping[str, str], mark: str = "") -> None:
        super().__init__(motion, 0, translate)
        self.letters = letters
        self.mark = mark

    def _rate(self, link: str, letter: str, name: str) -> Term:
        found = super()._rate(link, letter, name)
        return (
            found if found.is_zero else symbol(f"{self.letters[letter]}{self.numbers[link]}{self.mark}", found.amount)
        )

    def _components(self, letter: str, label: str, x: float, y: float) -> Pair:
        return super()._components(self.letters[letter], f"{label}{self.mark}", x, y)

    def slide(self, joint: str) -> Slide:
        found = super().slide(joint)
        rate, second = (
            each
            if each.is_zero or self.letters[letter] == letter
            else symbol(f"{self.letters[letter]}_{joint}{self.mark}", each.amount)
            for letter, each in (("v", found.rate), ("a", found.second))
        )
        return replace(found, rate=rate, second=second)


class UnitTable(MarkedTable):
    """Symbols of the motion with the unit rate of one input, the others at rest: per unit of that rate."""

    def drive(self, name: str) -> tuple[Term, Term, Term]:
        q, rate, _second = super().drive(name)
        return q, ONE if rate.amount else ZERO, ZERO


class BentTable(MarkedTable):
    """Symbols of the motion at the rates there are, the accelerations of the inputs zero."""

    def drive(self, name: str) -> tuple[Term, Term, Term]:
        return *super().drive(name)[:2], ZERO


#: Letters of a motion with a unit rate, and of what the rates alone make of accelerations.
UNIT = {"ω": "i", "v": "ν", "α": "i", "a": "ν"}
BENT = {"ω": "ω", "v": "v", "α": "ε", "a": "η"}
