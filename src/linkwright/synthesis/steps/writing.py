"""What the steps of all tasks are written with: symbols with their units, tables, matrices, numbers as text."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from linkwright.core.quantity import fixed
from linkwright.equations.matrix import Entries, side_by_side
from linkwright.equations.steps import Step, Tabulated
from linkwright.equations.terms import ZERO, Term, symbol
from linkwright.synthesis.result import Synthesis
from linkwright.words import Message, Translate

#: Lengths are printed in m where the longest link has this length or more, m.
LARGE = 10.0
#: Share of its size below which a deviation is rounding.
ROUNDING = 1e-11
#: Most rows of a table of positions.
MOST_ROWS = 24


@dataclass
class Writer:
    """The steps of one synthesis as they are written; ``pictures``: kinds of diagrams behind a step by its number."""

    found: Synthesis
    say: Translate
    steps: list[Step] = field(default_factory=list)
    pictures: dict[str, list[str]] = field(default_factory=dict)

    @property
    def large(self) -> bool:
        """Whether lengths are printed in m."""
        return max(self.found.best.linkage.lengths().values()) >= LARGE

    @property
    def unit(self) -> str:
        """Unit of lengths."""
        return "m" if self.large else "mm"

    @property
    def scale(self) -> float:
        """That unit per m."""
        return 1.0 if self.large else 1e3

    def step(self, title: Message) -> Step:
        """A new step with its title."""
        step = Step(str(len(self.steps) + 1), self.say(title))
        self.steps.append(step)
        return step

    def picture(self, kind: str) -> None:
        """A diagram of the result behind the step that is being written."""
        self.pictures.setdefault(self.steps[-1].number, []).append(kind)

    # symbols ------------------------------------------------------------------------------------
    def length(self, name: str, metres: float, index: str = "") -> Term:
        """A length by its letter and index; nothing where it is zero."""
        return symbol(named(name, index), metres * self.scale) if metres else ZERO

    def angle(self, name: str, radians: float, index: str = "") -> Term:
        """An angle, in degrees."""
        return symbol(named(name, index), math.degrees(radians), degrees=True)

    def value(self, name: str, amount: float, index: str = "") -> Term:
        """A plain number."""
        return symbol(named(name, index), amount)

    # texts --------------------------------------------------------------------------------------
    def lengths(self, metres: ArrayLike) -> list[str]:
        """Lengths as a column of a table prints them, to 1/10000 mm."""
        return decimals(np.asarray(metres, float) * self.scale, 7 if self.large else 4)

    def length_text(self, metres: float) -> str:
        """A length with its unit."""
        return f"{metres * self.scale:.7g} {self.unit}"

    def over(self, text: str) -> str:
        """The head of a column of lengths: ``a / mm``."""
        return f"{text} / {self.unit}"

    def table(
        self, step: Step, title: Message, columns: Sequence[tuple[str, Sequence[str]]], align: str = ""
    ) -> None:
        """Adds a table by its columns, head and texts; a long one is shown by evenly spaced rows."""
        rows = list(zip(*(texts for _, texts in columns), strict=True))
        if len(rows) > MOST_ROWS:
            chosen = np.unique(np.linspace(0, len(rows) - 1, MOST_ROWS).round().astype(int))
            rows = [rows[i] for i in chosen]
        heads = tuple(head for head, _ in columns)
        step.items.append(Tabulated(self.say(title), heads, tuple(rows), align or ">" * len(heads)))


def named(name: str, index: str = "") -> str:
    """A symbol with its index."""
    return f"{name}_{index}" if index else name


def decimals(values: ArrayLike, places: int) -> list[str]:
    """Numbers with so many decimals, zero without a sign."""
    return [fixed(float(value), places, "-") for value in np.atleast_1d(values)]


def degrees(radians: ArrayLike, places: int = 4) -> list[str]:
    """Angles in degrees."""
    return decimals(np.degrees(np.asarray(radians, float)), places)


def small(values: ArrayLike, size: float = 1.0) -> list[str]:
    """Deviations with four digits; zero where they are rounding of ``size``."""
    numbers = np.atleast_1d(np.asarray(values, float))
    return ["0" if abs(value) <= ROUNDING * size else f"{value:.4g}" for value in numbers]


def numbers(count: int) -> list[str]:
    """1 … count."""
    return [str(i + 1) for i in range(count)]


def matrix(values: ArrayLike, places: int = 6) -> Entries:
    """A matrix of numbers; a vector is a column."""
    rows = np.asarray(values, float)
    rows = rows[:, None] if rows.ndim == 1 else rows
    return Entries(tuple(tuple(decimals(row, places)) for row in rows))


def product(step: Step, *parts: Entries | str) -> None:
    """Adds an equation of matrices."""
    step.items.append(side_by_side(parts))
