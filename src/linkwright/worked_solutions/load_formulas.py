"""The formulas of the forces of loads in this position, by kinds of loads."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import singledispatch

from linkwright.applied_loads.base import Load
from linkwright.applied_loads.damper import Damper
from linkwright.applied_loads.force import Force
from linkwright.applied_loads.pressure import Pressure
from linkwright.applied_loads.spring import Spring
from linkwright.applied_loads.torsion_damper import TorsionDamper
from linkwright.applied_loads.torsion_spring import TorsionSpring
from linkwright.equations.steps import Step
from linkwright.equations.terms import FOUR, NOWHERE, Pair, Term, root, symbol
from linkwright.fields.references import LinkPoint
from linkwright.worked_solutions.symbols import SymbolTable

#: Shorter than this (m) a spring or damper has no direction.
SHORTEST = 1e-9


class LoadFormulas:
    """Writes the formula of a load once, and tells its parts on every link."""

    def __init__(self, book: SymbolTable) -> None:
        self.book = book
        self._sizes: dict[str, Term | None] = {}

    def named(self, letter: str, load: Load, amount: float) -> Term:
        """A number of a load (SI) with its symbol."""
        return symbol(f"{letter}_{load.name}", amount)

    def circle(self, diameter: Term) -> Term:
        """The area of a circle, m²."""
        return symbol("π", math.pi) * diameter.squared / FOUR

    def size(self, step: Step, load: Load, letter: str, unit: str, formula: Callable[[], Term | None]) -> Term | None:
        """The load's force or couple, written where it is first asked for; None where it is nothing."""
        if load.name not in self._sizes:
            found = formula()
            nothing = found is None or found.is_zero
            self._sizes[load.name] = (
                None if found is None or nothing else step.find(self.named(letter, load, found.value), found, unit)
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


@singledispatch
def worked_force(load: Load, write: LoadFormulas, step: Step, link: str, force: complex) -> Pair | None:
    """The formula of the force (N, frame axes) of a load on a link; None: magnitude and direction."""
    return None


@worked_force.register
def _spring(load: Spring, write: LoadFormulas, step: Step, link: str, force: complex) -> Pair | None:
    def tension(length: Term, parting: Term) -> Term:
        free, stiff = write.named("L0", load, load.free_length), write.named("k", load, load.stiffness)
        pull = stiff * (length - free) if load.free_length else stiff * length
        return write.named("F0", load, load.preload) + pull if load.preload else pull

    return write.between(step, load, load.between, link, tension)


@worked_force.register
def _damper(load: Damper, write: LoadFormulas, step: Step, link: str, force: complex) -> Pair | None:
    def tension(length: Term, parting: Term) -> Term:
        speed = step.find(write.named("L'", load, parting.value), parting, "m/s")
        return write.named("c", load, load.damping) * speed

    return write.between(step, load, load.between, link, tension)


@worked_force.register
def _pressure(load: Pressure, write: LoadFormulas, step: Step, link: str, force: complex) -> Pair | None:
    joint, along = write.book.mechanism.guides[load.joint], write.book.slide(load.joint).along
    forward = (link == joint.block) == (load.pushes == "forward")
    push = force.real * along.x.value + force.imag * along.y.value

    def press() -> Term:
        if load.area is not None:
            area = step.give(write.named("A", load, load.area), "m²")
        else:
            round_area = write.circle(write.named("d", load, load.bore or 0.0))
            area = step.find(write.named("A", load, round_area.value), round_area, "m²")
        pressure = (push if forward else -push) / area.amount
        return step.give(write.named("p", load, pressure), "Pa") * area

    size = write.size(step, load, "F", "N", press)
    if size is None:
        return None
    return along.times(size) if forward else -along.times(size)


@singledispatch
def worked_couple(load: Load, write: LoadFormulas, step: Step, link: str, torque: float) -> Term | None:
    """The formula of the couple (N·m) of a load on a link; None: its number."""
    return None


@worked_couple.register
def _torsion_damper(load: TorsionDamper, write: LoadFormulas, step: Step, link: str, torque: float) -> Term | None:
    a, b = (write.book.omega(each) for each in load.links)
    drag = write.named("c", load, load.damping) * (b - a)
    return write.couple(step, load, load.links, link, torque, lambda _: drag)


@worked_couple.register
def _torsion_spring(load: TorsionSpring, write: LoadFormulas, step: Step, link: str, torque: float) -> Term | None:
    def moment(known: float) -> Term | None:
        if not load.stiffness:
            return None
        angle = load.free_angle + (known - load.preload) / load.stiffness
        twist = step.give(write.named("φ", load, angle), "rad")
        free = write.named("φ0", load, load.free_angle)
        found = write.named("k", load, load.stiffness) * (twist - free if load.free_angle else twist)
        return write.named("M0", load, load.preload) + found if load.preload else found

    return write.couple(step, load, load.links, link, torque, moment)


@singledispatch
def turns_with(load: Load) -> str | None:
    """The link with which the direction of a load's force turns."""
    return None


@turns_with.register
def _of_link(load: Force) -> str | None:
    return load.on if load.normal_to or load.along or load.in_link is not None else None
