"""Groups of higher pairs alone: rotations and displacements from their rows or own formulas, and their forces."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from functools import singledispatch
from typing import Protocol

import numpy as np

from linkwright.core.outputs import Output
from linkwright.elements import Connection, Group, TreeJoint
from linkwright.equations.steps import Step
from linkwright.equations.terms import TWO, ZERO, Pair, Term, cosine, number, sine, size, symbol, tangent, total
from linkwright.joints.base import Joint
from linkwright.joints.cam import CamJoint
from linkwright.words import _
from linkwright.worked_solutions.cams import cam_pair
from linkwright.worked_solutions.higher_pairs import (
    Contact,
    PairClosure,
    Slid,
    Turned,
    contact_of,
    lever,
    one_by_one,
    pair_closures,
)
from linkwright.worked_solutions.places import Places
from linkwright.worked_solutions.symbols import SymbolTable


class OwnForm(Protocol):
    """A pair with formulas of its own, which determines its group alone."""

    @property
    def title(self) -> str:
        """Heading of what :meth:`shape` writes."""

    def place(self, step: Step, places: Places) -> None:
        """How it places its first link."""

    def rate(self, step: Step, *, second: bool) -> None:
        """Velocity or acceleration of the unknown."""

    def effort(self, step: Step, right: Term) -> Term:
        """What multiplies its row, from the known forces on the unknown."""

    def contact(self, step: Step, force: Term) -> tuple[Pair, Pair, Term]:
        """Force on its first link, where it acts, and its couple there."""

    def shape(self, step: Step) -> None:
        """What else is asked of it in this position."""


@singledispatch
def own_form(joint: Joint, book: SymbolTable) -> OwnForm | None:
    """The formulas of a pair that determines its group alone; None where ``sums`` and the contact say all."""
    return None


@own_form.register
def _cam_joint(joint: CamJoint, book: SymbolTable) -> OwnForm:
    return cam_pair(joint, book)


class Wheels:
    """Writes the positions, rates and forces of such groups."""

    def __init__(self, book: SymbolTable) -> None:
        self.book = book
        self._own: dict[str, OwnForm | None] = {}

    def own(self, joint: str) -> OwnForm | None:
        """A pair's own formulas, where it has some."""
        if joint not in self._own:
            self._own[joint] = own_form(self.book.mechanism.joints[joint], self.book)
        return self._own[joint]

    def alone(self, group: Group) -> OwnForm | None:
        """Those of the only pair of a group."""
        return self.own(group.cuts[0].joint) if len(group.cuts) == 1 else None

    def shapes(self, group: Group, number: int) -> list[Step]:
        """What else is asked of a pair of its own."""
        own = self.alone(group)
        if own is None:
            return []
        step = Step(f"{number}.4", own.title, group.name)
        own.shape(step)
        return [step]

    def positions(self, step: Step, places: Places, group: Group) -> None:
        """Rotations and displacements, as the pairs add them up."""
        book = self.book
        if (own := self.alone(group)) is not None:
            own.place(step, places)
            return
        step.note(
            book.translate(
                _(
                    "The pairs {joints} add the rotations up, counted with their turns (i: ratio to each "
                    "link, r: lever arm; β, c: from the drawing or the file):",
                    joints=_names(group),
                )
            )
        )
        for joint in group.unknowns:
            if joint.slides:
                places.guide(step, joint.joint)
        rows = pair_closures(book, group, ())
        solved = list(one_by_one(group, rows))
        for row, target in solved:
            row.give(step, target)
            formula = row.solved_for(target, book.rotation, lambda guide: book.slide(guide).s)
            if isinstance(target, Slid):
                places.displacement(step, book.slide(target.guide), formula)
            else:
                places.angle(step, target.link, formula)
        if not solved:
            places.give(step, group)
            places.check_pairs(step, rows)

    def rates(self, step: Step, group: Group, *, second: bool) -> None:
        """Velocities or accelerations of the unknowns: every row is linear in them."""
        book = self.book
        if (own := self.alone(group)) is not None:
            own.rate(step, second=second)
            return
        rows = pair_closures(book, group, ())
        rate = book.alpha if second else book.omega
        speed = self._second if second else self._speed
        solved = [(row, target, row.rate_of(target, rate, speed)) for row, target in one_by_one(group, rows)]
        if solved:
            if any(not formula.is_zero for *_unused, formula in solved):
                step.note(book.translate(_("The rows of {joints}, differentiated:", joints=_names(group))))
            for _unused, target, formula in solved:
                name, output = self._rate(target, second)
                if not name.is_zero:
                    step.find(name, formula, output)
            return
        step.note(book.translate(_("The rows of {joints}, differentiated:", joints=_names(group))))
        self._together(step, group, rows, second=second)

    def _together(self, step: Step, group: Group, rows: Sequence[PairClosure], *, second: bool) -> None:
        """Unknowns that no row gives alone, with every row put in."""
        book = self.book
        names = [self._rate(joint, second) for joint in group.unknowns]
        for row in rows:
            row.give(step, None)
        for name, output in names:
            if not name.is_zero:
                step.give(name, output)
        for row in rows:
            known = row.known_seconds(book, _no_chain)[0] if second else row.known_rates(book)[0]
            left = [
                row.column(joint)[0] * name for joint, (name, *_unused) in zip(group.unknowns, names, strict=True)
            ]
            formula = total([*left, known])
            if not formula.is_zero:
                step.find(symbol("0", 0.0), formula, "")

    def _speed(self, guide: str) -> Term:
        return self.book.slide(guide).rate

    def _second(self, guide: str) -> Term:
        return self.book.slide(guide).second

    def _rate(self, of: Turned | Slid | TreeJoint, second: bool) -> tuple[Term, Output]:
        joint = of if isinstance(of, TreeJoint) else of.source
        assert joint is not None
        if joint.slides:
            rate = self._second(joint.joint) if second else self._speed(joint.joint)
            return rate, Output("displacement", joint.joint).course[1 + second]
        turned = self.book.alpha(joint.child) if second else self.book.omega(joint.child)
        return turned, Output("angle", joint.child).course[1 + second]

    # forces -----------------------------------------------------------------------------------
    def multipliers(self, step: Step, group: Group, right: list[Term]) -> list[Term]:
        """The tangential force of every pair, from the moments on the unknowns."""
        if (own := self.alone(group)) is not None:
            return [own.effort(step, right[0])]
        rows = pair_closures(self.book, group, ())
        for row in rows:
            row.give(step, None)
        entries = [[row.column(joint)[0] for row in rows] for joint in group.unknowns]
        matrix = np.array([[entry.value for entry in line] for line in entries])
        values = np.linalg.solve(matrix, np.array([term.value for term in right]))
        named = [tangential(row.cut, float(value)) for row, value in zip(rows, values, strict=True)]
        if len(rows) == 1:
            if right[0].is_zero:
                step.give(named[0], "N")
            else:
                step.find(named[0], right[0] / entries[0][0], "N")
            return named
        for term in named:
            step.give(term, "N")
        for line, goal in zip(entries, right, strict=True):
            left = total([entry * force for entry, force in zip(line, named, strict=True)])
            step.find(symbol("0", 0.0) if goal.is_zero else goal, left, "")
        return named

    def contact(self, step: Step, cut: Connection, force: Term) -> tuple[Pair, Pair, Term]:
        """Force on the pair's first link, where it acts, and its couple there, from the tangential force."""
        if (own := self.own(cut.joint)) is not None:
            return own.contact(step, force)
        book = self.book
        contact = contact_of(book.mechanism.joints[cut.joint], book.mechanism)
        along = self._along(step, cut, contact)
        link, point = contact.at
        place = book.spot(link, point).place
        across, pressed = self._parts(step, cut, contact, force)
        pushed = along.perp.times(across)
        if not pressed.is_zero:
            pushed = pushed + along.times(step.define(f"S_{cut.joint}", pressed, "N"))
        arm = self._arm(step, cut, contact)
        if contact.strands:
            return pushed, place, arm * force
        return pushed, place + along.times(arm), ZERO

    def _arm(self, step: Step, cut: Connection, contact: Contact) -> Term:
        """The lever arm of the pair's first link, m."""
        book = self.book
        joint = book.mechanism.joints[cut.joint]
        first, rotations = joint.joined[0], joint.sums(book.mechanism)[0]
        arm = lever(book, cut.joint, first, contact.scale * rotations[first])
        if arm.plain not in book.introduced:
            book.introduced.add(arm.plain)
            step.give(arm, "m")
        return arm

    def _parts(self, step: Step, cut: Connection, contact: Contact, force: Term) -> tuple[Term, Term]:
        """The force square to e and along it."""
        lean = ZERO
        if contact.lean:
            name = symbol(f"{'ψ' if contact.strands else 'α'}_{cut.joint}", 0.0)
            lean = step.give(replace(name, amount=math.degrees(contact.lean), degrees=True), "°")
        press = {0.0: ZERO, 1.0: size(force), -1.0: -size(force)}[contact.press]
        if not contact.strands:
            return force, press * tangent(lean)
        if contact.pull:
            pull = symbol(f"F0_{cut.joint}", contact.pull)
            press = press + TWO * step.give(pull, "N")
        return force * sine(lean), press * cosine(lean)

    def _along(self, step: Step, cut: Connection, contact: Contact) -> Pair:
        """Unit vector along the line of centres, or square to a rack, away from which S presses."""
        own = self.book.degrees(contact.angle)
        turn = self.book.turn(contact.link) + own
        if turn.is_zero or turn.op == "symbol":
            return Pair(cosine(turn), sine(turn))
        value = (turn.value + 180.0) % 360.0 - 180.0
        name = symbol(f"γ_{cut.joint}", value, degrees=True)
        if own == turn:
            step.give(name, "°")
        else:
            rounds = number(turn.value - value, degrees=True)
            step.find(name, turn - rounds, "°")
        return Pair(cosine(name), sine(name))


def tangential(cut: Connection, value: float) -> Term:
    """T, the tangential force of a pair."""
    return symbol(f"T_{cut.joint}", value)


def _names(group: Group) -> str:
    return ", ".join(cut.joint for cut in group.cuts)


def _no_chain(closure: object) -> Pair:
    raise AssertionError("a group without other cuts")
