"""What loads write the formulas of their forces with, in this position."""

from __future__ import annotations

import math
from collections.abc import Callable

from linkwright.fields.references import LinkPoint
from linkwright.loads.base import Load
from linkwright.worked.page import Step
from linkwright.worked.symbols import Book, tex
from linkwright.worked.terms import FOUR, NOWHERE, Pair, Term, root, symbol

#: Shorter than this (m) a spring or damper has no direction.
SHORTEST = 1e-9


class LoadFormulas:
    """Writes the formula of a load once, and tells its parts on every link."""

    def __init__(self, book: Book) -> None:
        self.book = book
        self._sizes: dict[str, Term | None] = {}

    def named(self, letter: str, load: Load, amount: float) -> Term:
        """A number of a load (SI) with its symbol."""
        return symbol(f"{letter}_{load.name}", f"{letter}_{{{tex(load.name)}}}", amount)

    def circle(self, diameter: Term) -> Term:
        """The area of a circle, m²."""
        return symbol("π", r"\pi", math.pi) * diameter.squared / FOUR

    def size(
        self, step: Step, load: Load, letter: str, unit: str, formula: Callable[[], Term | None]
    ) -> Term | None:
        """The load's force or couple, written where it is first asked for; None where it is nothing."""
        if load.name not in self._sizes:
            found = formula()
            nothing = found is None or found.is_zero
            self._sizes[load.name] = (
                None
                if found is None or nothing
                else step.find(self.named(letter, load, found.value), found, unit)
            )
        return self._sizes[load.name]

    def couple(
        self,
        step: Step,
        load: Load,
        links: tuple[str, str],
        link: str,
        torque: float,
        moment: Callable[[float], Term | None],
    ) -> Term | None:
        """A couple between two links: its part on one, on which it is ``torque`` (N·m); ``moment``: the formula of
        that on the first, from its number."""
        first = link == links[0]
        size = self.size(step, load, "M", "N·m", lambda: moment(torque if first else -torque))
        return size if size is None or first else -size

    def between(
        self,
        step: Step,
        load: Load,
        ends: tuple[LinkPoint, LinkPoint],
        link: str,
        tension: Callable[[Term, Term], Term],
    ) -> Pair | None:
        """A force that pulls two points together: its part on one link; ``tension``: its formula from the distance of
        the points and its rate. None where they have none."""
        a, b = ends
        start, end = self.book.spot(a.link, a.point), self.book.spot(b.link, b.point)
        gap = NOWHERE if start.key == end.key else end.place - start.place
        length_is = root(gap.x.squared + gap.y.squared)
        if gap == NOWHERE or not length_is.value > SHORTEST:
            return None
        length = self.named("L", load, length_is.value)

        def pull() -> Term:
            step.find(length, length_is, "m")
            return tension(length, gap.dot(end.velocity - start.velocity) / length)

        size = self.size(step, load, "T", "N", pull)
        if size is None:
            return None
        pull_at = Pair(size * gap.x / length, size * gap.y / length)
        return pull_at if link == a.link else -pull_at
