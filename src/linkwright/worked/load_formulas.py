"""How springs, dampers and pressures come to their forces in this position."""

from __future__ import annotations

import math

from linkwright.loads.base import Load
from linkwright.loads.damper import Damper
from linkwright.loads.pressure import Pressure
from linkwright.loads.spring import Spring
from linkwright.loads.torsion_damper import TorsionDamper
from linkwright.loads.torsion_spring import TorsionSpring
from linkwright.worked.book import Book, tex
from linkwright.worked.page import Step
from linkwright.worked.terms import FOUR, NOWHERE, Pair, Term, root, symbol

#: Shorter than this (m) a spring or damper has no direction.
SHORTEST = 1e-9


class LoadFormulas:
    """Writes the formula of a load once, and tells its parts on every link."""

    def __init__(self, book: Book) -> None:
        self.book = book
        self._sizes: dict[str, Term | None] = {}

    def force(self, step: Step, load: Load | None, link: str) -> Pair | None:
        """The force on a link as a formula; None for other kinds."""
        if isinstance(load, Spring | Damper):
            return self._between(step, load, link)
        if isinstance(load, Pressure):
            return self._pressure(step, load, link)
        return None

    def couple(self, step: Step, load: Load | None, link: str, torque: float) -> Term | None:
        """The couple on a link as a formula; None for other kinds."""
        if not isinstance(load, TorsionSpring | TorsionDamper):
            return None
        first = link == load.links[0]
        if load.name not in self._sizes:
            self._sizes[load.name] = self._twist(step, load, torque if first else -torque)
        size = self._sizes[load.name]
        return size if size is None or first else -size

    def _named(self, letter: str, load: Load, amount: float) -> Term:
        return symbol(f"{letter}_{load.name}", f"{letter}_{{{tex(load.name)}}}", amount)

    def _between(self, step: Step, load: Spring | Damper, link: str) -> Pair | None:
        a, b = load.between
        start, end = self.book.spot(a.link, a.point), self.book.spot(b.link, b.point)
        gap = NOWHERE if start.key == end.key else end.place - start.place
        length_is = root(gap.x.squared + gap.y.squared)
        if gap == NOWHERE or not length_is.value > SHORTEST:
            return None
        length = self._named("L", load, length_is.value)
        if load.name not in self._sizes:
            step.find(length, length_is, "m")
            if isinstance(load, Spring):
                self._sizes[load.name] = self._tension(step, load, length)
            else:
                parting = gap.dot(end.velocity - start.velocity) / length
                speed = step.find(self._named("L'", load, parting.value), parting, "m/s")
                pull = self._named("c", load, load.damping) * speed
                self._sizes[load.name] = step.find(self._named("T", load, pull.value), pull, "N")
        size = self._sizes[load.name]
        assert size is not None
        pull_at = Pair(size * gap.x / length, size * gap.y / length)
        return pull_at if link == a.link else -pull_at

    def _tension(self, step: Step, load: Spring, length: Term) -> Term:
        free, stiff = self._named("L0", load, load.free_length), self._named("k", load, load.stiffness)
        pull = stiff * (length - free) if load.free_length else stiff * length
        if load.preload:
            pull = self._named("F0", load, load.preload) + pull
        return step.find(self._named("T", load, pull.value), pull, "N")

    def _twist(self, step: Step, load: TorsionSpring | TorsionDamper, moment: float) -> Term | None:
        a, b = load.links
        if isinstance(load, TorsionDamper):
            turning = self._named("c", load, load.damping) * (self.book.omega(b) - self.book.omega(a))
            return (
                None if turning.is_zero else step.find(self._named("M", load, turning.value), turning, "N·m")
            )
        if not load.stiffness:
            return None
        angle = load.free_angle + (moment - load.preload) / load.stiffness
        twist = step.give(self._named("φ", load, angle), "rad")
        free = self._named("φ0", load, load.free_angle)
        found = self._named("k", load, load.stiffness) * (twist - free if load.free_angle else twist)
        if load.preload:
            found = self._named("M0", load, load.preload) + found
        return step.find(self._named("M", load, found.value), found, "N·m")

    def _pressure(self, step: Step, load: Pressure, link: str) -> Pair | None:
        joint = self.book.mechanism.guides[load.joint]
        size = self._sizes.get(load.name)
        if size is None:
            return None
        along = self.book.slide(load.joint).along.times(size)
        return along if (link == joint.block) == (load.pushes == "forward") else -along

    def press(self, step: Step, load: Load | None, force: float) -> None:
        """Notes pressure, area and force of a pressure load, from the size of its force with sign."""
        if not isinstance(load, Pressure) or load.name in self._sizes:
            return
        if load.area is not None:
            area = step.give(self._named("A", load, load.area), "m²")
        else:
            assert load.bore is not None
            bore = self._named("d", load, load.bore)
            round_area = symbol("π", r"\pi", math.pi) * bore.squared / FOUR
            area = step.find(self._named("A", load, round_area.value), round_area, "m²")
        pressure = step.give(self._named("p", load, force / area.amount), "Pa")
        push = pressure * area
        self._sizes[load.name] = step.find(self._named("F", load, push.value), push, "N")
