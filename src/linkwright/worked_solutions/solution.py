"""One position of a mechanism, worked out step by step."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from linkwright.core.arguments import integer, require
from linkwright.core.outputs import Output
from linkwright.elements import Group
from linkwright.equations.reading import of_file, read_name
from linkwright.equations.steps import Solution, Step, Written, page
from linkwright.equations.terms import ZERO, ZERO_TOLERANCE, Term, symbol, total
from linkwright.errors import LinkwrightError, RequestError, require_language, speaker
from linkwright.kinematics.groups import dyad_shape, in_one_step
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.solve import solve_motion
from linkwright.kinetostatics.forces import Forces
from linkwright.kinetostatics.run import solve_forces
from linkwright.words import _, language_of
from linkwright.words.message import link_label, numbered_links
from linkwright.worked_solutions.applied_forces import KnownForces
from linkwright.worked_solutions.higher_pairs import closures
from linkwright.worked_solutions.places import Places
from linkwright.worked_solutions.rates import (
    Movers,
    RateWriter,
    System,
    check_closure,
    cut_displacements,
    place_points,
)
from linkwright.worked_solutions.reactions import Reactions
from linkwright.worked_solutions.symbols import SymbolTable
from linkwright.worked_solutions.wheels import Wheels


def force_steps(forces: Forces, book: SymbolTable, before: int) -> list[Step]:
    """All steps of the forces; ``before``: number of the last step of the motion."""
    number = before + 1
    known = KnownForces(forces, book)
    steps = known.steps(number)
    reactions = Reactions(forces, book, known)
    for group in reversed(forces.motion.structure.groups):
        number += 1
        steps += reactions.group(group, number)
    if passive := forces.motion.structure.passive:
        number += 1
        steps.append(reactions.passive(passive, number))
    shares = reactions.shares(number + 1)
    if shares is not None:
        number += 1
        steps.append(shares)
    if book.mechanism.drivers:
        steps.append(power_step(forces, book, known, number + 1))
    return steps


def named_step(book: SymbolTable, number: int) -> Step:
    """Outputs that the model names: the formula of each, its value and its rates, where it has some."""
    step = Step(str(number), book.translate(_("Outputs that the model names")))
    for name, named in book.mechanism.outputs.items():
        text = of_file(named.expression.text)
        step.items.append(Written(f"{name} = {text}", (read_name(name), read_name(text))))
        for output in named.outputs:
            value = float(book.motion.read(output)[book.index])
            if np.isfinite(value):
                step.give(symbol(output.name, value), output)
    return step


def power_step(forces: Forces, book: SymbolTable, known: KnownForces, number: int) -> Step:
    """Powers of all known forces, of the drivers, and the effort that follows from them."""
    step = Step(str(number), book.translate(_("Check by virtual power")))
    step.note(book.translate(_("Power of weight, inertia and loads of every link:")))
    powers = []
    for link, acting in known.on.items():
        n = book.numbers[link]
        parts = [each.force.dot(each.velocity) + each.couple * book.omega(link) for each in acting]
        formula = total(parts)
        if not formula.is_zero:
            powers.append(step.define(f"P{n}", formula, "W"))
    power = total(powers)
    sum_of = step.define("ΣP", power, "W") if powers else ZERO
    _drivers(step, forces, book, sum_of)
    return step


def _drivers(step: Step, forces: Forces, book: SymbolTable, sum_of: Term) -> None:
    """With one driver its effort from the powers; with several the balance."""
    terms = []
    for name, driver in book.mechanism.drivers.items():
        rate = book.drive(name)[1]
        letter = "F" if book.mechanism.joints[driver.joint].coordinate == "slide" else "M"
        value = float(forces.driver_effort(name)[book.index])
        terms.append((symbol(f"{letter}_{name}", value), rate))
    if len(terms) == 1 and abs(terms[0][1].amount) > ZERO_TOLERANCE and not sum_of.is_zero:
        effort, rate = terms[0]
        step.note(book.translate(_("The driver's power takes the sum to zero, so its effort once more:")))
        unit = "N" if effort.plain.startswith("F") else "N·m"
        step.find(effort, -(sum_of / rate), unit)
        return
    step.note(book.translate(_("With the powers of the drivers the sum is zero:")))
    gap = symbol("ΔP", 0.0)
    step.find(gap, sum_of + total([effort * rate for effort, rate in terms]), "W")


@dataclass(frozen=True)
class Worked(Solution):
    """The worked solution of one position: ``steps`` in the order in which a textbook solves it.

    Every step holds sentences, relations and equations (formula, numbers put in, result); ``text`` prints them,
    ``data`` gives them as plain data with LaTeX forms.
    """

    legend: tuple[str, ...] = ()
    position: int = 0

    def text(self) -> str:
        """Plain text, up to 100 columns wide."""
        return page((self.title, "", *self.legend), self.steps)

    def data(self) -> dict[str, object]:
        """Plain data for programs and reports."""
        return {**super().data(), "legend": list(self.legend), "position": self.position}


def worked(source: Forces | Motion, position: int = 0, *, at: float | None = None, language: str = "en") -> Worked:
    """The worked solution of one position: motion group by group, then forces in reverse order.

    Args:
        source: a motion, or forces (with their motion).
        position: index of the position.
        at: coordinate of the first driver (rad or m) instead; that position is solved anew.
        language: ``en`` or ``zh``.

    Returns:
        The solution. Every result is the solver's number to six significant digits, fewer where the formula
        cancels digits; the numbers put in have as many digits as the result needs.

    Raises:
        LinkwrightError: a position that does not exist or was not reached, an unknown language.
    """
    require(source, Forces, Motion)
    require_language(language)
    if at is not None:
        source, position = _solved_at(source, at), 0
    motion = source.motion if isinstance(source, Forces) else source
    position = integer("position", position)
    _refuse_missing(motion, position)
    index = position % motion.steps
    translate = speaker(language)
    book = SymbolTable(motion, index, translate)
    steps = Kinematics(book).steps()
    if isinstance(source, Forces):
        from linkwright.worked_solutions.solution import force_steps

        steps += force_steps(source, book, len(steps) and int(steps[-1].number.split(".")[0]))
    title = translate(_("{name}: worked solution of one position", name=motion.mechanism.name))
    return Worked(title, tuple(step for step in steps if step.items), tuple(legend(book)), index)


def _solved_at(source: Forces | Motion, at: float) -> Forces | Motion:
    mechanism = source.mechanism
    if not mechanism.drivers:
        raise RequestError(
            _(
                "{name!r} has no driver, so there is no input to set; leave `at` out",
                code="worked.no_input",
                name=mechanism.name,
            )
        )
    motion = solve_motion(mechanism, at=np.array([at]))
    return solve_forces(motion, static=source.static) if isinstance(source, Forces) else motion


def _refuse_missing(motion: Motion, position: int) -> None:
    if not -motion.steps <= position < motion.steps:
        raise RequestError(
            _(
                "there is no position {position}; the motion has {steps}, from 0 to {last}",
                code="worked.no_position",
                position=position,
                steps=motion.steps,
                last=motion.steps - 1,
            )
        )
    if not motion.ok[position]:
        raise LinkwrightError(
            _(
                "position {position} was not reached: {sentence}",
                code="worked.not_reached",
                position=position,
                sentence=motion.outcomes[position].sentence,
            )
        )


def legend(book: SymbolTable) -> list[str]:
    translate = book.translate
    links = ", ".join(numbered_links(book.numbers, language_of(translate)))
    return [
        translate(_("Links: {links}.", links=links)),
        translate(
            _(
                "x to the right, y up, angles and moments counter-clockwise positive; SI units. x_A, "
                "v_Ax, a_Ax: place, velocity, acceleration of point A; φ, ω, α: angle of a link's x "
                "axis and its rates; l, u, w: coordinates of a point in the axes of its link, from "
                "the first point named to the second (l along the x axis); s, s', s'': displacement "
                "of a block and its rates; atan2(y, x): angle of the vector (x, y) in its own "
                "quadrant."
            )
        ),
        translate(
            _(
                "Every line: symbol = formula = numbers put in = result. Numbers put in have as many "
                "digits as the result needs."
            )
        ),
    ]


class Kinematics:
    """Steps of the motion, group by group."""

    def __init__(self, book: SymbolTable) -> None:
        self.book = book
        self.places = Places(book)
        self.movers = Movers(book)
        self.rates = RateWriter(book)
        self.wheels = Wheels(book)

    def steps(self) -> list[Step]:
        found = [self._input()] if self.book.mechanism.drivers else []
        for group in self.book.motion.structure.groups:
            number = len({step.number.split(".")[0] for step in found}) + 1
            found += self.group(group, number)
        if self.book.mechanism.outputs:
            found.append(named_step(self.book, len({step.number.split(".")[0] for step in found}) + 1))
        return found

    def _input(self) -> Step:
        book, translate = self.book, self.book.translate
        step = Step("1", translate(_("Input")))
        for name, driver in book.mechanism.drivers.items():
            turning = book.mechanism.joints[driver.joint].coordinate == "turn"
            message = (
                _("{head}{link} turns against {relative} about {joint}.")
                if turning
                else _("{head}{link} slides on {relative} in {joint}.")
            )
            head = f"{name}: " if len(book.mechanism.drivers) > 1 else ""
            relative = link_label(driver.relative_to, language_of(translate))
            step.note(translate(message.format(head=head, link=driver.link, relative=relative, joint=driver.joint)))
            unit = "rad" if turning else "m"
            measures: tuple[str | Output, ...] = (
                Output("input", name, slides=not turning),
                f"{unit}/s",
                f"{unit}/s²",
            )
            for term, what in zip(book.drive(name), measures, strict=True):
                if term.is_zero:
                    step.note(translate(_("Constant speed: no acceleration of the input.")))
                else:
                    step.give(term, what)
        return step

    def group(self, group: Group, number: int) -> list[Step]:
        translate, name = self.book.translate, group.name
        links = ", ".join(f"{self.book.numbers[link]} {link}" for link in group.links)
        moving = bool(self.book.mechanism.drivers)
        head = Step(str(number), self._title(group, links), name)
        head.note(self._joints(group))
        places = Step(f"{number}.1", translate(_("Positions")), name)
        wheels = in_one_step(group)
        if wheels:
            self.wheels.positions(places, self.places, group)
        self.places.place(places, group)
        place_points(self.book, self.places, places, group)
        cut_displacements(self.book, self.places, places, group)
        if group.unknowns and dyad_shape(group) is None and not wheels:
            check_closure(self.book, self.places, places, group)
        if not moving:
            return [head, places]
        if wheels:
            return [head, places, *self._wheel_rates(group, number), *self.wheels.shapes(group, number)]
        cuts = closures(self.book, group)
        first = Step(f"{number}.2", translate(_("Velocities")), name)
        self.movers.driven_guides(first, group, second=False)
        system: System | None = self.rates.velocities(first, group, cuts)
        self.movers.move(first, group, second=False)
        second = Step(f"{number}.3", translate(_("Accelerations")), name)
        self.movers.driven_guides(second, group, second=True)
        self.rates.accelerations(second, group, cuts, system)
        self.movers.move(second, group, second=True)
        return [head, places, first, second]

    def _wheel_rates(self, group: Group, number: int) -> list[Step]:
        found = []
        for second, title in ((False, _("Velocities")), (True, _("Accelerations"))):
            step = Step(f"{number}.{3 if second else 2}", self.book.translate(title), group.name)
            self.movers.driven_guides(step, group, second=second)
            self.rates.links(step, group, second=second, before=True)
            self.wheels.rates(step, group, second=second)
            self.rates.links(step, group, second=second, before=False)
            self.movers.move(step, group, second=second)
            found.append(step)
        return found

    def _title(self, group: Group, links: str) -> str:
        driven = group.assur_class == 1 and group.drivers
        message = _("Driven link: {links}") if driven else _("Group {signature}: {links}")
        return self.book.translate(message.format(signature=group.signature, links=links, order=group.assur_order))

    def _joints(self, group: Group) -> str:
        outer = ", ".join(dict.fromkeys(c.joint for c in group.outer_joints))
        inner = ", ".join(dict.fromkeys(c.joint for c in group.inner_joints))
        message = _("Outer joints {outer}; inner joints {inner}.") if inner else _("Joints {outer}.")
        return self.book.translate(message.format(outer=outer, inner=inner))
