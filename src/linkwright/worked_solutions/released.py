"""The worked solution of a mechanism that forces set going, as textbooks do it: inertia and forces reduced to its
inputs, the accelerations that follow, then the forces on every link."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

import numpy as np

from linkwright.core.outputs import Output
from linkwright.dynamics.release import Release
from linkwright.dynamics.states import FoundForces, FoundMotion, motion_at
from linkwright.equations.steps import Equation, Item, Step
from linkwright.equations.terms import NOWHERE, ZERO, Pair, Term, symbol, total
from linkwright.errors import LinkwrightError, require_language, speaker
from linkwright.words import Message, Translate, _
from linkwright.worked_solutions.applied_forces import Known, KnownForces
from linkwright.worked_solutions.rates import System, named_points, solve
from linkwright.worked_solutions.reactions import Reactions
from linkwright.worked_solutions.solution import Kinematics, Worked, legend
from linkwright.worked_solutions.symbols import PointState, SymbolTable
from linkwright.worked_solutions.unit_motion import BENT, UNIT, BentTable, UnitTable


def worked(release: Release, *, language: str = "en") -> Worked:
    """The worked solution of a release; see :meth:`linkwright.Release.worked`."""
    require_language(language)
    if release.outcome == "sticks" and release.mechanism.higher:
        raise LinkwrightError(
            _(
                "{name!r} sticks: the forces of its teeth and belts then lie between those of setting out either "
                "way, which no formula on paper gives; ask for a position in which it moves",
                code="worked.sticks_in_pairs",
                name=release.mechanism.name,
            )
        )
    translate = speaker(language)
    book = SymbolTable(release.motion, 0, translate)
    steps = _Writer(release, book, translate).steps()
    title = translate(_("{name}: worked solution of the motion under forces", name=release.mechanism.name))
    lines = [*legend(book), translate(_MORE)]
    return Worked(title, tuple(step for step in steps if step.items), tuple(lines))


_MORE = _(
    "i, ν: angular velocity of a link and velocity of a point (or of a block along its guide) per unit of the rate "
    "q' of an input; ε, η: their accelerations where all q'' are zero; M: reduced inertia; Q: reduced force."
)


class _Writer:
    """Writes the steps of one release."""

    def __init__(self, release: Release, book: SymbolTable, translate: Translate) -> None:
        self.release = release
        self.book = book
        self.translate = translate
        self.equation = release.equation
        self.free = self.equation.free
        self.moves = any(np.any(w) for _q, w, _a in release.motion.positions.coordinates.values())
        self.bends = self.moves or len(self.free) < len(self.equation.names)
        self.alone = alone = len(self.equation.names) == 1
        self.index = {name: str(number) for number, name in enumerate(self.equation.names, 1)}
        self.units = {
            name: UnitTable(self._motion({name: 1.0}), translate, UNIT, "" if alone else f",{number}")
            for number, name in enumerate(self.equation.names, 1)
        }
        kept = {name: second for name, second in release.accelerations.items() if name not in self.free}
        self.unaccelerated = self._motion(None, kept)
        self.bent = BentTable(self.unaccelerated, translate, BENT)
        self.number = 0

    def _motion(self, rates: Mapping[str, float] | None, seconds: Mapping[str, float] | None = None) -> FoundMotion:
        """The motion at the position with other rates (None: its own) and accelerations, zero where not given."""
        moment = self.release.moment
        course = {
            name: (
                q,
                w if rates is None else np.array([rates.get(name, 0.0)]),
                np.array([(seconds or {}).get(name, 0.0)]),
            )
            for name, (q, w, _a) in moment.course.items()
        }
        return motion_at(replace(moment, parts=[part.going(course) for part in moment.parts]))

    def _step(self, title: Message) -> Step:
        self.number += 1
        return Step(str(self.number), self.translate(title))

    def steps(self) -> list[Step]:
        """All steps."""
        found = [self._input(), *self._positions()]
        for name in self.equation.names[1:]:
            found += self._rates(name)
        if self.bends:
            found += self._bends()
        known = self._known(self.release.motion if self.equation.rubs else self.unaccelerated)
        found += self._forces(known)
        found += [self._inertia(), self._reduced(known), self._accelerations(), self._moving()]
        actual = self._known(self.release.motion)
        found += self._reactions(actual)
        found.append(self._check())
        return found

    # motion -----------------------------------------------------------------------------------------------
    def _input(self) -> Step:
        """Coordinates and rates."""
        step, book = self._step(_("Inputs")), self.book
        if not self.alone:
            numbered = ", ".join(f"{number} {name}" for name, number in self.index.items())
            step.note(self.translate(_("Numbers of the inputs, last in an index: {names}.", names=numbered)))
        for name in self.equation.names:
            turning = self.equation.rotary[name]
            q, rate, _second = book.drive(name)
            step.give(q, Output("input", name, slides=not turning))
            if rate.amount:
                step.give(rate, "rad/s" if turning else "m/s")
        if not self.moves:
            step.note(self.translate(_("Released from rest: all rates are zero.")))
        return step

    def _positions(self) -> Iterator[Step]:
        """Positions, and motion with the unit rate of the first input."""
        name = self.equation.names[0]
        book = self.units[name]
        head = self._step(_("Positions, and motion per unit rate of {name}", name=name))
        head.note(self.translate(_UNIT_NOTES[not self.alone].format(name=name)))
        yield head
        yield from self._groups(book, (1, 2), name)

    def _rates(self, name: str) -> Iterator[Step]:
        """Motion with the unit rate of a further input."""
        head = self._step(_("Motion per unit rate of {name}", name=name))
        head.note(self.translate(_UNIT_NOTES[not self.alone].format(name=name)))
        yield head
        yield from self._groups(self.units[name], (2,), name)

    def _bends(self) -> Iterator[Step]:
        """Velocities, and accelerations without those of free inputs."""
        head = self._step(_("Velocities, and accelerations without those of the inputs"))
        head.note(self.translate(_("The rates are as given, every q'' of a free input is zero.")))
        yield head
        yield from self._groups(self.bent, (2, 3), "")

    def _groups(self, book: SymbolTable, parts: Sequence[int], unit: str) -> Iterator[Step]:
        """The steps of the groups of a motion: 1 positions, 2 velocities, 3 accelerations."""
        writer, place = Kinematics(book), 0
        for group in book.motion.structure.groups:
            wanted = [step for step in writer.group(group, 1) if _part(step) in parts]
            for step in wanted:
                place += 1
                own = _("{group}: {what}").format(group=", ".join(group.links), what=step.title)
                items = [self._measured(each, unit if _part(step) == 2 else None) for each in step.items]
                yield replace(step, number=f"{self.number}.{place}", title=self.translate(own), items=items)

    def _measured(self, item: Item, unit: str | None) -> Item:
        """An equation of a motion that is not the mechanism's, with its unit per unit rate."""
        if not isinstance(item, Equation) or unit is None:
            return item
        if not unit:
            return item if item.symbol.startswith(("v", "ω", "s")) else replace(item, output=None)
        per = {"rad/s": "" if self.equation.rotary[unit] else "1/m", "m/s": "m" if self.equation.rotary[unit] else ""}
        return replace(item, output=None, unit=per.get(item.unit, item.unit))

    # forces -----------------------------------------------------------------------------------------------
    def _known(self, motion: FoundMotion) -> KnownForces:
        """Weights, loads and friction in a motion."""
        forces = self.release.forces
        found = FoundForces(self.release.motion, forces.solver, {}, True, forces.rows, found=motion.found)
        return KnownForces(found, self.book)

    def _forces(self, known: KnownForces) -> list[Step]:
        self.number += 1
        head, *rest = known.steps(self.number)
        self.before = known.acting
        head.items.clear()
        head.note(self.translate(_("K: weight, at the mass centre. No joint's force is known yet.")))
        return [head, *rest]

    def _inertia(self) -> Step:
        """M: masses and moments of inertia reduced to the inputs."""
        step = self._step(_("Reduced inertia"))
        step.note(self.translate(_INERTIA_NOTES[len(self.free) > 1]))
        self.matrix: dict[tuple[str, str], Term] = {}
        for i, a in enumerate(self.free):
            for b in self.free[: i + 1]:
                self.matrix[a, b] = self.matrix[b, a] = self._entry(step, a, b)
        return step

    def _entry(self, step: Step, a: str, b: str) -> Term:
        book, parts = self.book, []
        first, second = self.units[a], self.units[b]
        for link, part in book.mechanism.links.items():
            n, terms = book.numbers[link], []
            if part.mass:
                u, v = (each.spot(link, "@centre").velocity for each in (first, second))
                square = u.x.squared + u.y.squared if a == b else u.dot(v)
                terms.append(symbol(f"m{n}", part.mass) * square)
            if part.inertia:
                i, j = first.omega(link), second.omega(link)
                terms.append(symbol(f"J{n}", part.inertia) * (i.squared if a == b else i * j))
            if not (formula := total(terms)).is_zero:
                parts.append(step.define(f"M_{self._pair(a, b)}{n}", formula, self._unit(a, b)))
        row, column = (self.free.index(each) for each in (a, b))
        whole = float(self.release.mass_matrix[row, column])
        rest = whole - total(parts).value
        if abs(rest) > 1e-10 * max(abs(whole), 1e-300):
            step.note(self.translate(_("What actuators and loads have of inertia:")))
            parts.append(step.give(symbol(f"M_{self._pair(a, b)}a", rest), self._unit(a, b)))
        name = "M" if len(self.free) == 1 else f"M_{self.index[a]},{self.index[b]}"
        return step.find(symbol(name, whole), total(parts), self._unit(a, b))

    def _pair(self, a: str, b: str) -> str:
        return "" if len(self.free) == 1 else f"{self.index[a]},{self.index[b]},"

    def _unit(self, a: str, b: str) -> str:
        turning = self.equation.rotary[a] + self.equation.rotary[b]
        return ("kg", "kg·m", "kg·m²")[turning]

    def _reduced(self, known: KnownForces) -> Step:
        """Q: forces reduced to the inputs, with what the rates make of inertia."""
        step = self._step(_("Reduced forces"))
        step.note(
            self.translate(_("Q = Σ (F·ν + M i): power of weights and loads per unit of the rate of an input."))
        )
        self.right: dict[str, Term] = {}
        for name in self.free:
            unit = "N·m" if self.equation.rotary[name] else "N"
            mark, parts = "" if len(self.free) == 1 else f"{self.index[name]},", []
            for link, acting in known.on.items():
                n = self.book.numbers[link]
                formula = total([self._share(name, link, each) for each in acting])
                if not formula.is_zero:
                    parts.append(step.define(f"Q_{mark}{n}", formula, unit))
            if self.bends:
                step.note(self.translate(_("What the rates make of inertia, -m η·ν - J ε i:")))
                for link in self.book.mechanism.links:
                    if not (formula := self._bias(name, link)).is_zero:
                        parts.append(step.define(f"H_{mark}{self.book.numbers[link]}", formula, unit))
            whole = total(parts)
            own = "Q" if len(self.free) == 1 else f"Q_{self.index[name]}"
            self.right[name] = ZERO if whole.is_zero else step.define(own, whole, unit)
        return step

    def _share(self, name: str, link: str, known: Known) -> Term:
        book = self.units[name]
        return known.force.dot(self._velocity(book, link, known.place)) + known.couple * book.omega(link)

    @staticmethod
    def _velocity(book: SymbolTable, link: str, place: Pair) -> Pair:
        """Velocity of the point of a link at a place."""
        spots = [spot for _name, spot in named_points(book, link)]
        for spot in spots:
            if spot.place == place:
                return NOWHERE if spot.fixed else spot.velocity
        return spots[0].velocity + (place - spots[0].place).perp.times(book.omega(link))

    def _bias(self, name: str, link: str) -> Term:
        part, unit, bent = self.book.mechanism.links[link], self.units[name], self.bent
        n, found = self.book.numbers[link], ZERO
        if part.mass:
            spot, rush = unit.spot(link, "@centre"), bent.spot(link, "@centre").acceleration
            found = found - symbol(f"m{n}", part.mass) * rush.dot(spot.velocity)
        if part.inertia and not (spin := bent.alpha(link) * unit.omega(link)).is_zero:
            found = found - symbol(f"J{n}", part.inertia) * spin
        return found

    # accelerations ----------------------------------------------------------------------------------------
    def _accelerations(self) -> Step:
        """The linear equations M q'' = Q and their solution."""
        step, translate = self._step(_("Accelerations of the inputs")), self.translate
        for text in self._verdict():
            step.note(translate(text))
        seconds = [self._second(name) for name in self.free]
        rows = [[self.matrix[a, b] for b in self.free] for a in self.free]
        right = [self.right[name] for name in self.free]
        for row, goal in zip(rows, right, strict=True):
            step.relate(total([each * second for each, second in zip(row, seconds, strict=True)]), goal)
        determinant = None
        if len(rows) == 2:
            (a, b), (c, d) = rows
            determinant = step.define("det M", a * d - b * c, "")
        units = ["rad/s²" if self.equation.rotary[name] else "m/s²" for name in self.free]
        solve(step, self.book, System(rows, determinant), seconds, right, units)
        return step

    def _second(self, name: str) -> Term:
        mark = "" if len(self.equation.names) == 1 else f"_{name}"
        return symbol(f"q''{mark}", self.release.accelerations[name], look=f"q̈{mark}")

    def _verdict(self) -> list[Message]:
        """What friction decides."""
        release = self.release
        texts = [release.verdict] if release.outcome != "moves" else []
        if self.equation.rubs and release.outcome == "moves":
            texts.append(_("Friction goes by the joints' forces of the motion that follows; they agree."))
        return texts

    def _moving(self) -> Step:
        """Accelerations of links and points from those of the inputs."""
        step, book = self._step(_("Accelerations of links and points")), self.book
        step.note(self.translate(_("What moves per unit rate, times q'', and what the rates make of it:")))
        seconds = {name: self._second(name) for name in self.free}
        for link in book.mechanism.links:
            alpha = book.alpha(link)
            formula = total([self.units[name].omega(link) * second for name, second in seconds.items()])
            formula = formula + self.bent.alpha(link) if self.bends else formula
            if not alpha.is_zero:
                step.find(alpha, formula, Output("angular_acceleration", link))
        written: set[str] = set()
        for link in book.mechanism.links:
            for point, spot in named_points(book, link):
                if spot.fixed or spot.key in written:
                    continue
                written.add(spot.key)
                self._rush(step, link, point, spot, seconds)
        return step

    def _rush(self, step: Step, link: str, point: str, spot: PointState, seconds: Mapping[str, Term]) -> None:
        whole = NOWHERE
        for name, second in seconds.items():
            whole = whole + self.units[name].spot(link, point).velocity.times(second)
        if self.bends:
            whole = whole + self.bent.spot(link, point).acceleration
        for axis, term, part in (("x", spot.acceleration.x, whole.x), ("y", spot.acceleration.y, whole.y)):
            step.find(term, part, Output("acceleration", spot.key, axis))

    # reactions --------------------------------------------------------------------------------------------
    def _reactions(self, known: KnownForces) -> Iterator[Step]:
        """Inertia forces, then the forces of joints, group by group in reverse order."""
        loads = known.steps(self.number + 1)[2]
        if any(acts != before for acts, before in zip(known.acting, self.before, strict=True)):
            self.number += 1
            yield replace(loads, number=str(self.number), title=self.translate(_("Loads at these accelerations")))
        head = self._step(_("Inertia forces: I = -m a_G, M_J = -J α"))
        self._add_inertia(head, known)
        yield head
        reactions = Reactions(self.release.forces, self.book, known)
        for group in reversed(self.release.motion.structure.groups):
            self.number += 1
            yield from reactions.group(group, self.number)
        if passive := self.release.motion.structure.passive:
            self.number += 1
            yield reactions.passive(passive, self.number)
        if (shares := reactions.shares(self.number + 1)) is not None:
            self.number += 1
            yield shares

    def _add_inertia(self, step: Step, known: KnownForces) -> None:
        book = self.book
        for link, part in book.mechanism.links.items():
            n = book.numbers[link]
            if part.mass:
                spot, mass = book.spot(link, "@centre"), symbol(f"m{n}", part.mass)
                force = Pair(
                    *(
                        step.define(f"I_{n}{axis}", -(mass * rush), "N")
                        for axis, rush in (("x", spot.acceleration.x), ("y", spot.acceleration.y))
                    )
                )
                known.on[link].append(Known(force, spot.place, spot.velocity))
            if part.inertia and not (alpha := book.alpha(link)).is_zero:
                couple = step.define(f"M_J{n}", -(symbol(f"J{n}", part.inertia) * alpha), "N·m")
                known.on[link].append(Known(NOWHERE, NOWHERE, NOWHERE, couple))

    def _check(self) -> Step:
        step, forces = self._step(_("Check")), self.release.forces
        step.note(
            self.translate(
                _(
                    "Nothing drives the free inputs: their torque or force came out as zero. Put together from these "
                    "results, forces and inertia balance on every link within {residual} N.",
                    residual=f"{float(forces.balance_residual[0]):.1e}",
                )
            )
        )
        return step


#: What moves with a unit rate, and how inertia is reduced: with one input, with several.
_UNIT_NOTES = (
    _("Rate q' = 1; what then moves is a ratio to that rate."),
    _("Rate of {name} q' = 1, all others 0; what then moves is a ratio to that rate."),
)
_INERTIA_NOTES = (
    _("M = Σ (m ν_G² + J i²) over all links, twice the kinetic energy per unit of q'²."),
    _("M = Σ (m ν_G·ν_G + J i i) over all links, ν and i of one input and of the other."),
)


def _part(step: Step) -> int:
    """1 positions, 2 velocities, 3 accelerations, 0 the head of a group."""
    return int(step.number.partition(".")[2] or 0)
