"""How springs, dampers and pressures come to their forces in this position."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TypeVar

from linkwright.loads.base import Load
from linkwright.loads.damper import Damper
from linkwright.loads.pressure import Pressure
from linkwright.loads.spring import Spring
from linkwright.loads.torsion_damper import TorsionDamper
from linkwright.loads.torsion_spring import TorsionSpring
from linkwright.worked.page import Step
from linkwright.worked.symbols import Book, tex
from linkwright.worked.terms import FOUR, NOWHERE, Pair, Term, root, symbol

#: Shorter than this (m) a spring or damper has no direction.
SHORTEST = 1e-9


L = TypeVar("L", Spring, Damper)


class LoadFormulas:
    """Writes the formula of a load once, and tells its parts on every link."""

    def __init__(self, book: Book) -> None:
        self.book = book
        self._sizes: dict[str, Term | None] = {}

    def spring(self, step: Step, load: Spring, link: str) -> Pair | None:
        """The force of a spring between two points."""
        return self._between(step, load, link, self._tension)

    def damper(self, step: Step, load: Damper, link: str) -> Pair | None:
        """The force of a damper between two points."""
        return self._between(step, load, link, self._resistance)

    def torsion_spring(self, step: Step, load: TorsionSpring, link: str, torque: float) -> Term | None:
        """The couple of a torsion spring."""
        return self._on_both(load, link, torque, lambda moment: self._twist(step, load, moment))

    def torsion_damper(self, step: Step, load: TorsionDamper, link: str, torque: float) -> Term | None:
        """The couple of a torsion damper."""
        return self._on_both(load, link, torque, lambda _: self._drag(step, load))

    def _on_both(
        self,
        load: TorsionSpring | TorsionDamper,
        link: str,
        torque: float,
        moment: Callable[[float], Term | None],
    ) -> Term | None:
        first = link == load.links[0]
        if load.name not in self._sizes:
            self._sizes[load.name] = moment(torque if first else -torque)
        size = self._sizes[load.name]
        return size if size is None or first else -size

    def _named(self, letter: str, load: Load, amount: float) -> Term:
        return symbol(f"{letter}_{load.name}", f"{letter}_{{{tex(load.name)}}}", amount)

    def _between(
        self, step: Step, load: L, link: str, pull: Callable[[Step, L, Term, Term], Term]
    ) -> Pair | None:
        a, b = load.between
        start, end = self.book.spot(a.link, a.point), self.book.spot(b.link, b.point)
        gap = NOWHERE if start.key == end.key else end.place - start.place
        length_is = root(gap.x.squared + gap.y.squared)
        if gap == NOWHERE or not length_is.value > SHORTEST:
            return None
        length = self._named("L", load, length_is.value)
        if load.name not in self._sizes:
            step.find(length, length_is, "m")
            parting = gap.dot(end.velocity - start.velocity) / length
            self._sizes[load.name] = pull(step, load, length, parting)
        size = self._sizes[load.name]
        assert size is not None
        pull_at = Pair(size * gap.x / length, size * gap.y / length)
        return pull_at if link == a.link else -pull_at

    def _tension(self, step: Step, load: Spring, length: Term, parting: Term) -> Term:
        free, stiff = self._named("L0", load, load.free_length), self._named("k", load, load.stiffness)
        pull = stiff * (length - free) if load.free_length else stiff * length
        if load.preload:
            pull = self._named("F0", load, load.preload) + pull
        return step.find(self._named("T", load, pull.value), pull, "N")

    def _resistance(self, step: Step, load: Damper, length: Term, parting: Term) -> Term:
        speed = step.find(self._named("L'", load, parting.value), parting, "m/s")
        pull = self._named("c", load, load.damping) * speed
        return step.find(self._named("T", load, pull.value), pull, "N")

    def _drag(self, step: Step, load: TorsionDamper) -> Term | None:
        a, b = load.links
        turning = self._named("c", load, load.damping) * (self.book.omega(b) - self.book.omega(a))
        return None if turning.is_zero else step.find(self._named("M", load, turning.value), turning, "N·m")

    def _twist(self, step: Step, load: TorsionSpring, moment: float) -> Term | None:
        if not load.stiffness:
            return None
        angle = load.free_angle + (moment - load.preload) / load.stiffness
        twist = step.give(self._named("φ", load, angle), "rad")
        free = self._named("φ0", load, load.free_angle)
        found = self._named("k", load, load.stiffness) * (twist - free if load.free_angle else twist)
        if load.preload:
            found = self._named("M0", load, load.preload) + found
        return step.find(self._named("M", load, found.value), found, "N·m")

    def pressure(self, step: Step, load: Pressure, link: str, force: complex) -> Pair:
        """The force of a pressure, from its number in frame axes."""
        joint, along = self.book.mechanism.guides[load.joint], self.book.slide(load.joint).along
        forward = (link == joint.block) == (load.pushes == "forward")
        if load.name not in self._sizes:
            push = force.real * along.x.value + force.imag * along.y.value
            self._sizes[load.name] = self._press(step, load, push if forward else -push)
        size = self._sizes[load.name]
        assert size is not None
        return along.times(size) if forward else -along.times(size)

    def _press(self, step: Step, load: Pressure, force: float) -> Term:
        """Pressure, area and force with sign."""
        if load.area is not None:
            area = step.give(self._named("A", load, load.area), "m²")
        else:
            assert load.bore is not None
            bore = self._named("d", load, load.bore)
            round_area = symbol("π", r"\pi", math.pi) * bore.squared / FOUR
            area = step.find(self._named("A", load, round_area.value), round_area, "m²")
        pressure = step.give(self._named("p", load, force / area.amount), "Pa")
        push = pressure * area
        return step.find(self._named("F", load, push.value), push, "N")
