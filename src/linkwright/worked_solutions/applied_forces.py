"""Forces that are known before the joints': weight, inertia, friction, and loads by their formulas."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import singledispatch

from linkwright.applied_loads.base import Load
from linkwright.applied_loads.damper import Damper
from linkwright.applied_loads.force import Force
from linkwright.applied_loads.pressure import Pressure
from linkwright.applied_loads.spring import Spring
from linkwright.applied_loads.torsion_damper import TorsionDamper
from linkwright.applied_loads.torsion_spring import TorsionSpring
from linkwright.core.outputs import owners_of
from linkwright.equations.steps import Step
from linkwright.equations.terms import FOUR, NOWHERE, ZERO, Pair, Term, cosine, root, sine, symbol
from linkwright.fields.references import LinkPoint
from linkwright.kinetostatics.forces import Forces
from linkwright.kinetostatics.link_balance import AppliedWrench, applied_wrenches
from linkwright.words import _
from linkwright.worked_solutions.symbols import PointState, SymbolTable


@dataclass(frozen=True)
class Known:
    """A known force on a link, at a place, and a couple; ``velocity`` of the point where it acts."""

    force: Pair
    place: Pair
    velocity: Pair
    couple: Term = ZERO

    def moment(self, about: Pair) -> Term:
        """Moment about a point."""
        arm = NOWHERE if self.place == about else self.place - about
        return arm.cross(self.force) + self.couple


class KnownForces:
    """The known forces of every link at one position."""

    def __init__(self, forces: Forces, book: SymbolTable) -> None:
        self.forces = forces
        self.book = book
        self.formulas = LoadFormulas(book)
        self.on: dict[str, list[Known]] = {name: [] for name in book.mechanism.links}
        self._found: list[AppliedWrench] = []

    def steps(self, number: int) -> list[Step]:
        """The steps that find them."""
        translate = self.book.translate
        head = Step(str(number), translate(_("Forces")))
        head.note(
            translate(
                _(
                    "F_A,2: force that joint A exerts on link 2 (F_A,1→2: that link 1 exerts on link 2 "
                    "at A); K, M_J: weight and inertia force at the mass centre, inertia couple. The "
                    "other link of a joint feels the reverse. Groups in reverse order."
                )
            )
        )
        inertia = Step(
            f"{number}.1",
            translate(_("Weights") if self.forces.static else _("Weight and inertia: K = m (g - a_G), M_J = -J α")),
        )
        for link in self.book.mechanism.links:
            self._own(inertia, link)
        loads = Step(f"{number}.2", translate(_("Loads")))
        self._loads(loads)
        return [head, inertia, loads]

    @property
    def acting(self) -> list[AppliedWrench]:
        """What loads and friction do, after the steps are written."""
        return self._found

    def _own(self, step: Step, link: str) -> None:
        """Weight and inertia force at the mass centre, inertia couple."""
        book, part = self.book, self.book.mechanism.links[link]
        n = book.numbers[link]
        moving = not self.forces.static and bool(book.mechanism.drivers)
        mass, inertia = symbol(f"m{n}", part.mass), symbol(f"J{n}", part.inertia)
        alpha = book.alpha(link) if moving else ZERO
        if part.mass:
            spot = book.spot(link, "@centre")
            parts = []
            for c, pull, rush in zip("xy", self._gravity(), (spot.acceleration.x, spot.acceleration.y), strict=True):
                formula = mass * (pull - rush) if moving else mass * pull
                parts.append(self._named(step, f"K_{n}{c}", formula, "N"))
            self.on[link].append(Known(Pair(*parts), spot.place, spot.velocity))
        if part.inertia and not alpha.is_zero:
            couple = self._named(step, f"M_J{n}", -(inertia * alpha), "N·m")
            self.on[link].append(Known(NOWHERE, NOWHERE, NOWHERE, couple))

    def _named(self, step: Step, name: str, formula: Term, unit: str) -> Term:
        if formula.is_zero:
            return ZERO
        return step.define(name, formula, unit)

    def _gravity(self) -> list[Term]:
        named = zip("xy", self.book.mechanism.gravity, strict=True)
        return [symbol(f"g_{c}", value) if value else ZERO for c, value in named]

    def _loads(self, step: Step) -> None:
        self._found = applied_wrenches(self.forces, self.book.index)
        for each in self._found:
            name, link, torque = each.name, each.link, each.torque
            (fx, fy), (px, py) = each.force, each.place
            label = self._label(name, link)
            if not (fx or fy or torque):
                if link in self.on:
                    self._announce(step, name, link, idle=True)
                continue
            if link not in self.on:
                continue
            self._announce(step, name, link)
            known = Known(NOWHERE, NOWHERE, NOWHERE)
            if fx or fy:
                known = self._force(step, name, label, link, complex(fx, fy), complex(px, py))
            if torque:
                couple = self._couple(step, name, label, link, torque)
                known = Known(known.force, known.place, known.velocity, couple)
            self.on[link].append(known)

    def _announce(self, step: Step, name: str, link: str, *, idle: bool = False) -> None:
        joint = self._rubbing(name)
        if joint:
            text = self.book.translate(
                _(
                    "friction in {joint}, on link {link} (coefficient times the joint's force, found by iteration):",
                    joint=joint,
                    link=link,
                )
            )
        else:
            text = self.book.translate(
                (_("{name}: does not act in this position.") if idle else _("{name}, on link {link}:")).format(
                    name=name, link=link
                )
            )
        if not (idle and joint):
            step.note(text)

    def _couple(self, step: Step, name: str, label: str, link: str, torque: float) -> Term:
        couple = symbol(f"M_{label}", torque)
        load = self.book.mechanism.loads.get(name)
        formula = None if load is None else worked_couple(load, self.formulas, step, link, torque)
        if formula is None:
            return step.give(couple, "N·m")
        if formula.op == "symbol" and formula.plain == couple.plain:
            return formula
        return step.find(couple, formula, "N·m")

    def _force(self, step: Step, name: str, label: str, link: str, force: complex, place: complex) -> Known:
        book = self.book
        spot = self._spot(link, place)
        if spot is None:
            at = [step.give(symbol(f"{c}_{label}", v), "m") for c, v in (("x", place.real), ("y", place.imag))]
            where = Pair(*at)
            base = next(book.spot(link, point) for point in book.mechanism.links[link].points)
            velocity = base.velocity + (where - base.place).perp.times(book.omega(link))
        else:
            where, velocity = spot.place, spot.velocity
        formula = self._formula(step, name, label, link, force)
        parts = [
            ZERO if part.is_zero else step.find(symbol(f"F_{label},{c}", v), part, "N")
            for c, v, part in (("x", force.real, formula.x), ("y", force.imag, formula.y))
        ]
        return Known(Pair(*parts), where, velocity)

    def _formula(self, step: Step, name: str, label: str, link: str, force: complex) -> Pair:
        """Components of a load: from the formula of its kind, or from magnitude and direction."""
        load = self.book.mechanism.loads.get(name)
        found = None if load is None else worked_force(load, self.formulas, step, link, force)
        if found is not None:
            return found
        size = step.give(symbol(f"F_{label}", abs(force)), "N")
        way = math.degrees(math.atan2(force.imag, force.real))
        angle = symbol(f"θ_{label}", way, degrees=True)
        self._direction(step, name, link, angle)
        return Pair(size * cosine(angle), size * sine(angle))

    def _direction(self, step: Step, name: str, link: str, angle: Term) -> None:
        """The angle of a load; for one normal to a line of its link, from the angle of the link."""
        load = self.book.mechanism.loads.get(name)
        if load is not None and link == turns_with(load):
            lean = angle.amount - self.book.turn(link).amount
            own = self.book.degrees(math.radians((lean + 180.0) % 360.0 - 180.0))
            formula = self.book.turn(link) + own
            if abs(formula.value - angle.amount) < 1e-9:
                step.find(angle, formula, "°")
                return
        step.give(angle, "°")

    def _rubbing(self, name: str) -> str:
        """The joint whose friction goes by a name; empty where a load does."""
        return "" if name in self.book.mechanism.loads else "".join(owners_of("friction", [name]))

    def _label(self, name: str, link: str) -> str:
        if joint := self._rubbing(name):
            return f"f{joint}{self.book.numbers[link]}"
        several = sum(1 for each in self._found if each.name == name and each.link in self.on) > 1
        return f"{name}{self.book.numbers[link]}" if several else name

    def _spot(self, link: str, place: complex) -> PointState | None:
        """The point of the link at which a force acts, if it has one there."""
        for point in self.book.mechanism.links[link].points:
            spot = self.book.spot(link, point)
            if abs(complex(spot.place.x.value, spot.place.y.value) - place) < 1e-12 * max(1.0, abs(place)):
                return spot
        return None


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
