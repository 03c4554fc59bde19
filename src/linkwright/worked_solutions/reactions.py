"""Joint forces of the groups, in reverse order: moments and slides first, then the balance of every link."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.outputs import Output
from linkwright.elements import Connection, Group, TreeJoint
from linkwright.equations.steps import Step
from linkwright.equations.terms import NOWHERE, ZERO, Pair, Term, direction, root, symbol, total
from linkwright.kinematics.groups import in_one_step
from linkwright.kinetostatics.forces import Forces
from linkwright.words import _
from linkwright.worked_solutions.applied_forces import Known, KnownForces
from linkwright.worked_solutions.chains import ChainClosure, Closure, attach
from linkwright.worked_solutions.higher_pairs import closures
from linkwright.worked_solutions.rates import System, name_matrix, solve
from linkwright.worked_solutions.symbols import SymbolTable
from linkwright.worked_solutions.wheels import Wheels, tangential

#: Unknowns of a system with their outputs, or units.
Unknowns = list[tuple[Term, "str | Output"]]
#: Share of the largest force up to which two are the same but for rounding.
SAME = 1e-9


@dataclass(frozen=True)
class Found:
    """What a connection exerts on link ``on``."""

    connection: Connection
    on: str
    known: Known

    def acting(self, link: str) -> Known:
        """The same on one of the two links."""
        if link == self.on:
            return self.known
        return Known(-self.known.force, self.known.place, NOWHERE, -self.known.couple)


class Reactions:
    """Writes the joint forces group after group."""

    def __init__(self, forces: Forces, book: SymbolTable, known: KnownForces) -> None:
        self.forces = forces
        self.book = book
        self.known = known
        self.found: list[Found] = []

    # what acts on a link ------------------------------------------------------------------
    def acting(self, link: str) -> list[Known]:
        """All forces on a link that are known by now."""
        joints = [f.acting(link) for f in self.found if link in (f.connection.a, f.connection.b)]
        return [*self.known.on[link], *joints]

    def group(self, group: Group, number: int) -> list[Step]:
        """The steps of one group."""
        book = self.book
        links = ", ".join(f"{book.numbers[link]} {link}" for link in group.links)
        driven = group.assur_class == 1 and group.drivers
        message = _("Forces of the driven link: {links}") if driven else _("Forces of group {signature}: {links}")
        title = book.translate(message.format(signature=group.signature, links=links))
        head = Step(f"{number}", title, group.name)
        if in_one_step(group):
            self._wheels(head, group)
        elif group.cuts:
            self._cuts(head, group)
        for joint in reversed(group.tree):
            self._carry(head, joint)
        return [head]

    # cuts -----------------------------------------------------------------------------------
    def _cuts(self, step: Step, group: Group) -> None:
        """Forces at the cuts, from one equation for every unknown coordinate."""
        book = self.book
        cuts = closures(book, group)
        step.note(
            book.translate(
                _(
                    "The force at {joints} first; the equations are such that no other joint force enters.",
                    joints=", ".join(dict.fromkeys(c.joint for c in group.cuts)),
                )
            )
        )
        if any(cut.higher for cut in group.cuts):
            step.note(
                book.translate(
                    _(
                        "T: tangential force of a pair. S acts along the line of centres (its direction: γ), "
                        "does no work and follows from T: it separates the teeth, |T| tan α with the "
                        "pressure angle α, or is the pull of a belt's strands, which lie at the angle ψ to "
                        "it."
                    )
                )
            )
        right = self._demands(step, group)
        step.note(
            book.translate(_("The arms of the unknown forces form the matrix J of the velocities, read by columns:"))
        )
        system = name_matrix(step, group, cuts)
        values = _transposed(system, right)
        if self._pressed(group, system, values):
            step.note(
                book.translate(
                    _(
                        "The rows of the pairs hold for closed joints. So the pairs' forces T follow from "
                        "these equations, but the multipliers λ of the cut joints lack what the pairs do to "
                        "these:"
                    )
                )
            )
            self._solved(step, system, self._by_rows(group, values), right)
            self._press_all(step, group, values)
            step.note(
                book.translate(
                    _(
                        "With the forces of the pairs among the known ones, the same equations give the "
                        "forces at the cut joints, and nothing more for the pairs (ΔT = 0):"
                    )
                )
            )
            right = self._demands(step, group, "'")
            unknowns = self._multipliers(group, _transposed(system, right), pairs=False)
            self._solved(step, system, unknowns, right)
        else:
            unknowns = self._multipliers(group, values)
            self._solved(step, system, unknowns, right)
            self._press_all(step, group, values)
        self._noted(step, cuts, [term for term, _unused in unknowns], group)

    def _solved(self, step: Step, system: System, unknowns: Unknowns, right: list[Term]) -> None:
        """The equations Jᵀ q = right and their solution."""
        terms = [term for term, _unused in unknowns]
        for column, goal in zip(zip(*system.entries, strict=True), right, strict=True):
            step.relate(total([e * u for e, u in zip(column, terms, strict=True)]), goal)
        solve(step, self.book, system, terms, right, [output for _unused, output in unknowns], transposed=True)

    def _noted(self, step: Step, cuts: Sequence[Closure], unknowns: list[Term], group: Group) -> None:
        """The forces at the cuts of chains as what acts on the links."""
        place = 0
        for closure in cuts:
            cut = closure.cut
            if not isinstance(closure, ChainClosure):
                place += 1
                continue
            if cut.turns:
                force, on = Pair(unknowns[place], unknowns[place + 1]), cut.a
                place += 2
                if on not in group.links:
                    on, force = cut.b, self._reversed(step, cut, force)
                self._size(step, cut, on, force)
            else:
                assert closure.across is not None
                force, on = self._normal(step, cut, unknowns[place], closure.across.along), cut.b
                place += 1
            self.found.append(Found(cut, on, Known(force, closure.tip.place, NOWHERE)))

    def _pressed(self, group: Group, system: System, values: Floats) -> bool:
        """Whether pairs act on joints that are cut: what their rows leave there is not the complete force."""
        if not any(cut.higher for cut in group.cuts):
            return False
        aside, known = Step("", ""), len(self.found)
        self._press_all(aside, group, values)
        again = _transposed(system, self._demands(aside, group))
        del self.found[known:]
        chains = [not cut.higher for cut, _unused in _rows(group)]
        return bool(np.abs(again - values)[chains].max() > SAME * np.abs(values).max())

    def _press_all(self, step: Step, group: Group, values: Floats) -> None:
        """The forces of all higher pairs of a group, from the tangential ones."""
        for place, (cut, _unused) in enumerate(_rows(group)):
            if cut.higher:
                self._press(step, cut, tangential(cut, float(values[place])))

    def _demands(self, step: Step, group: Group, mark: str = "") -> list[Term]:
        """The right sides of all equations."""
        return [self._demand(step, group, joint, f"{i}{mark}") for i, joint in enumerate(group.unknowns, 1)]

    def _wheels(self, step: Step, group: Group) -> None:
        """Tooth forces, pulls of belts and forces of cams, from what acts on wheels and followers."""
        book, wheels = self.book, Wheels(self.book)
        if wheels.alone(group) is None:
            step.note(
                book.translate(
                    _(
                        "Moments about the wheels' centres give T, the tangential force of each of {joints}. "
                        "S acts along the line of centres (direction: γ): it separates the teeth, |T| tan α "
                        "with the pressure angle α, or is the pull of a belt's strands, which lie at the "
                        "angle ψ to it.",
                        joints=", ".join(cut.joint for cut in group.cuts),
                    )
                )
            )
        right = self._demands(step, group)
        for cut, force in zip(group.cuts, wheels.multipliers(step, group, right), strict=True):
            self._press(step, cut, force)

    def _press(self, step: Step, cut: Connection, tangential: Term) -> None:
        """The force of a higher pair, from its tangential force."""
        formula, place, couple = Wheels(self.book).contact(step, cut, tangential)
        on = cut.a if cut.a != "frame" else cut.b
        if on != cut.a:
            formula, couple = -formula, -couple
        name, output = self._names(cut, on)
        found = step.find_pair(name, self._solver_force(cut, on, 0j), formula, output)
        self._size(step, cut, on, found)
        self.found.append(Found(cut, on, Known(found, place, NOWHERE, couple)))

    def passive(self, names: tuple[str, ...], number: int) -> Step:
        """Pairs that others make superfluous: how they share the load is not determined; they count as unloaded."""
        step = Step(str(number), self.book.translate(_("Passive pairs {joints}", joints=", ".join(names))))
        step.note(
            self.book.translate(
                _("How they share the load with others is not determined by rigid links; they count as unloaded.")
            )
        )
        for name in names:
            on = next(k for k in self.book.mechanism.joints[name].joined if k != "frame")
            n = self.book.numbers[on]
            step.find_pair(f"F_{name},{n}", 0j, NOWHERE, Output("reaction", name, on=on))
        return step

    def _reversed(self, step: Step, cut: Connection, force: Pair) -> Pair:
        """The force on the group's own link, where the other one was found."""
        name, output = self._names(cut, cut.b)
        return step.find_pair(name, complex(-force.x.amount, -force.y.amount), -force, output)

    def _normal(self, step: Step, cut: Connection, size: Term, along: Pair) -> Pair:
        """Components of the normal force of a guide, on the block."""
        formula = along.perp.times(size)
        name, output = self._names(cut, cut.b)
        return step.find_pair(name, complex(formula.x.value, formula.y.value), formula, output)

    def _multipliers(self, group: Group, values: Floats, *, pairs: bool = True) -> Unknowns:
        """Symbols of the unknown cut forces (on the first link; normal forces on blocks) with their outputs; without
        ``pairs`` what is left for these, which is nothing."""
        found: Unknowns = []
        for place, (cut, axis) in enumerate(_rows(group)):
            value = float(values[place])
            if cut.higher:
                rest = symbol(f"ΔT_{cut.joint}", 0.0)
                found.append((tangential(cut, value) if pairs else rest, "N"))
            elif cut.slides:
                found.append((symbol(f"N_{cut.joint}", value), "N"))
            else:
                name, output = self._names(cut, cut.a)
                force = self._solver_force(cut, cut.a, complex(value, value))
                value = force.real if axis == "x" else force.imag
                term = symbol(f"{name}{axis}", value)
                found.append((term, replace(output, component=axis) if output else "N"))
        return found

    def _by_rows(self, group: Group, values: Floats) -> Unknowns:
        """The same where only the pairs' forces are complete: λ of the rows of the other cuts."""
        found: Unknowns = []
        for (cut, axis), value in zip(_rows(group), values.tolist(), strict=True):
            own = symbol(f"λ_{cut.joint}{axis and ','}{axis}", value)
            found.append((tangential(cut, value) if cut.higher else own, "N"))
        return found

    def _demand(self, step: Step, group: Group, joint: TreeJoint, number: str) -> Term:
        """Right side of one equation: minus what the known forces do on an unknown coordinate."""
        book = self.book
        if joint.slides:
            slide = book.slide(joint.joint)
            moved = list(subtree(group, joint))
            step.note(
                book.translate(
                    _(
                        "Known forces on {links} along {joint}, reversed:",
                        links=self._names_of(moved),
                        joint=joint.joint,
                    )
                )
            )
            force = self._resultant(moved)
            forward = slide.along.dot(force)
            formula = -forward if joint.child == joint.connection.b else forward
            unit = "N"
        else:
            pivot = book.spot(joint.parent, joint.joint)
            own = list(segment(group, joint))
            step.note(
                book.translate(
                    _(
                        "Moments of the known forces on {links} about {point}, reversed:",
                        links=self._names_of(own),
                        point=pivot.label,
                    )
                )
            )
            parts = [each.moment(pivot.place) for link in own for each in self.acting(link)]
            for hung in group.tree:
                if hung.free and hung.turns and hung.parent in own and hung is not joint:
                    at = book.spot(hung.parent, hung.joint)
                    parts.append((at.place - pivot.place).cross(self._resultant(list(subtree(group, hung)))))
            formula, unit = -total(parts), "N·m"
        term = step.define(f"Q{number}", formula, unit)
        return ZERO if formula.is_zero else term

    def _resultant(self, links: list[str]) -> Pair:
        found = NOWHERE
        for link in links:
            for each in self.acting(link):
                found = found + each.force
        return found

    def _names_of(self, links: list[str]) -> str:
        return ", ".join(f"{self.book.numbers[link]} {link}" for link in links)

    # links --------------------------------------------------------------------------------
    def _carry(self, step: Step, joint: TreeJoint) -> None:
        """Balance of a link: the force of the joint that it hangs on, and the couple or the driver's effort."""
        book, link = self.book, joint.child
        acting = self.acting(link)
        step.note(
            book.translate(
                _(
                    "Balance of link {link}, force of {joint} on it:",
                    link=f"{book.numbers[link]} {link}",
                    joint=joint.joint,
                )
            )
        )
        needed = NOWHERE
        for each in acting:
            needed = needed + each.force
        effort = self._push(step, joint, needed)
        name, output = self._names(joint.connection, link)
        formula = -(needed + effort) if effort != NOWHERE else -needed
        parts = self._solver_force(joint.connection, link, complex(formula.x.value, formula.y.value))
        force = step.find_pair(name, parts, formula, output)
        self._size(step, joint.connection, link, force)
        place, couple = self._turning(step, joint, [*acting, *self._pushed(joint, effort)])
        self.found.append(Found(joint.connection, link, Known(force + effort, place, NOWHERE, couple)))

    def _pushed(self, joint: TreeJoint, effort: Pair) -> list[Known]:
        if effort == NOWHERE:
            return []
        return [Known(effort, self._block_point(joint), NOWHERE)]

    def _push(self, step: Step, joint: TreeJoint, needed: Pair) -> Pair:
        """Force of a driver along a guide, on the child."""
        if joint.driver is None or not joint.slides:
            return NOWHERE
        slide = self.book.slide(joint.joint)
        block = joint.child == joint.connection.b
        forward = slide.along.dot(needed)
        term = symbol(f"F_{joint.driver}", self._effort(joint.driver))
        step.find(term, -forward if block else forward, Output("effort", joint.driver, slides=True))
        push = slide.along.times(term)
        return push if block else -push

    def _turning(self, step: Step, joint: TreeJoint, acting: list[Known]) -> tuple[Pair, Term]:
        """Moments about the joint: the driver's torque, or the couple of a guide or a weld."""
        book = self.book
        if joint.turns:
            place = book.spot(joint.parent, joint.joint).place
            if joint.driver is None:
                return place, ZERO
            own = joint.child == book.mechanism.drivers[joint.driver].link
            found = total([each.moment(place) for each in acting])
            term = symbol(f"M_{joint.driver}", self._effort(joint.driver))
            step.note(book.translate(_("Moments about {point}: torque of the driver.", point=joint.joint)))
            step.find(term, -found if own else found, Output("effort", joint.driver))
            return place, term if own else -term
        place = self._block_point(joint)
        formula = -total([each.moment(place) for each in acting])
        n = book.numbers[joint.child]
        value = float(self.forces.couple(joint.joint, on=joint.child)[book.index])
        term = symbol(f"M_{joint.joint},{n}", value)
        step.find(term, formula, Output("couple", joint.joint, on=joint.child))
        return place, ZERO if formula.is_zero else term

    def _block_point(self, joint: TreeJoint) -> Pair:
        """Point about which a couple is counted: the block's point, or the weld."""
        held = self.book.mechanism.guides.get(joint.joint)
        if held is not None:
            return self.book.spot(held.block, held.at).place
        return self.book.spot(joint.child, attach(joint, joint.child, self.book)).place

    def _effort(self, driver: str) -> float:
        return float(self.forces.driver_effort(driver)[self.book.index])

    # names and sizes ----------------------------------------------------------------------
    def _simple(self, connection: Connection) -> bool:
        return len(self.book.mechanism.joints[connection.joint].joined) == 2

    def _names(self, connection: Connection, link: str) -> tuple[str, Output | None]:
        """Symbol of a joint force on a link, and which output it is."""
        joint, n = connection.joint, self.book.numbers[link]
        if self._simple(connection):
            output = None if link == "frame" else Output("reaction", joint, on=link)
            return f"F_{joint},{n}", output
        other = self.book.numbers[connection.other(link)]
        return f"F_{joint},{other}→{n}", None

    def _solver_force(self, connection: Connection, link: str, value: complex) -> complex:
        """The solver's number where the joint has two links."""
        if not self._simple(connection):
            return value
        return complex(*self.forces.reaction(connection.joint, on=link)[self.book.index])

    def _size(self, step: Step, connection: Connection, link: str, force: Pair) -> None:
        self._polar(step, force, *self._names(connection, link))

    def _polar(self, step: Step, force: Pair, name: str, output: Output | None) -> None:
        """Magnitude and direction of a force that is not zero."""
        size = root(force.x.squared + force.y.squared)
        if force.x.is_zero or force.y.is_zero or not size.value:
            return
        step.define(name, size, output or "N")
        turn = direction(force.y, force.x)
        step.define(f"∠{name}", turn, "°", degrees=True)

    def shares(self, number: int) -> Step | None:
        """What every link carries on pins of several links."""
        book = self.book
        step = Step(str(number), book.translate(_("Pins of several links: share of each link")))
        for name, joint in book.mechanism.joints.items():
            if len(joint.joined) < 3:
                continue
            for link in joint.joined:
                here = [f for f in self.found if f.connection.joint == name]
                mine = [f for f in here if link in (f.connection.a, f.connection.b)]
                if link == "frame" or not mine:
                    continue
                force = NOWHERE
                for each in mine:
                    force = force + each.acting(link).force
                self._share(step, name, link, force)
        return step if step.items else None

    def _share(self, step: Step, joint: str, link: str, formula: Pair) -> None:
        n, output = self.book.numbers[link], Output("reaction", joint, on=link)
        values = self.forces.reaction(joint, on=link)[self.book.index]
        name = f"F_{joint},{n}"
        force = step.find_pair(name, complex(*values), formula, output)
        self._polar(step, force, name, output)


def segment(group: Group, joint: TreeJoint) -> Iterator[str]:
    """Links that turn with a free pin: its child and what guides, welds and drivers hold to it."""
    own = {joint.child}
    yield joint.child
    for step in group.tree:
        if step.parent in own and not (step.free and step.turns):
            own.add(step.child)
            yield step.child


def subtree(group: Group, joint: TreeJoint) -> Iterator[str]:
    """All links that hang on a joint."""
    own = {joint.child}
    yield joint.child
    for step in group.tree:
        if step.parent in own and step.child not in own:
            own.add(step.child)
            yield step.child


def _rows(group: Group) -> list[tuple[Connection, str]]:
    """The cuts by the rows of their equations, of a pin with the axis."""
    return [(cut, axis) for cut in group.cuts for axis in ("xy" if cut.turns else [""])]


def _transposed(system: System, right: list[Term]) -> Floats:
    """The solution of Jᵀ q = right."""
    entries = np.array([[entry.value for entry in row] for row in system.entries], dtype=float)
    return np.asarray(np.linalg.solve(entries.T, np.array([each.value for each in right], dtype=float)))
