"""The lift of a cam in one position, from the law of its segment or from the polynomial between two points."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from linkwright.equations.steps import Step
from linkwright.equations.terms import ZERO, Term, number, symbol
from linkwright.joints.cam import CamJoint
from linkwright.laws.base import LABELS
from linkwright.laws.program import MotionProgram
from linkwright.words import _
from linkwright.worked_solutions.symbols import SymbolTable


@dataclass(frozen=True)
class Lift:
    """θ (°), S (m, of an oscillating follower °), S' and S'' (over rad)."""

    angle: Term
    value: Term
    first: Term
    second: Term


class LiftWriter:
    """Symbols of a cam's lift, and the way to them; ``joint`` gives the only index where there are several cams."""

    def __init__(self, book: SymbolTable, joint: CamJoint) -> None:
        self.book = book
        self.joint = joint
        cams = [each for each in book.mechanism.joints.values() if type(each) is type(joint)]
        self.sub = joint.name if len(cams) > 1 else ""
        self.factor = math.degrees(1.0) if joint.side else 1.0
        self.unit = "°" if joint.side else "m"

    def named(self, name: str, value: float, *, degrees: bool = False) -> Term:
        """A symbol of this cam."""
        if self.sub:
            name = f"{name},{self.sub}" if "_" in name else f"{name}_{self.sub}"
        return symbol(name, value, degrees=degrees)

    @cached_property
    def turned(self) -> float:
        """θ, rad, 0 to a turn."""
        joint, book = self.joint, self.book
        measured = math.radians(book.angle_of(joint.cam) - book.angle_of(joint.carrier)) - joint.phase
        return (joint.sense * measured) % (2 * math.pi)

    @cached_property
    def now(self) -> Lift:
        """The symbols with their values; nothing for rates of a rest."""
        value, first, second = (float(each[0]) for each in self.joint.lift.curves(np.array([self.turned])))
        swings = bool(self.joint.side)
        rest = self._law_at[1] is None if self.joint.program is not None else not self._row[1:].any()
        return Lift(
            self.named("θ", math.degrees(self.turned), degrees=True),
            self.named("S", self.factor * value, degrees=swings),
            ZERO if rest else self.named("S'", first),
            ZERO if rest else self.named("S''", second),
        )

    @cached_property
    def _law_at(self) -> tuple[int, object]:
        """Number of the program's segment, and its law; None for a rest."""
        program = self.joint.program
        assert program is not None
        k = int(np.clip(np.searchsorted(program.edges, self.turned, side="right") - 1, 0, len(program.edges) - 2))
        return k, program.moved_by[k][0]

    @cached_property
    def _piece(self) -> int:
        edges = self.joint.lift.edges
        return int(np.clip(np.searchsorted(edges, self.turned, side="right") - 1, 0, len(edges) - 2))

    @property
    def _row(self) -> np.ndarray:
        return np.asarray(self.joint.lift.coefficients[self._piece])

    def write(self, step: Step) -> None:
        """θ, then S, S' and S''."""
        book, joint, theta = self.book, self.joint, self.now.angle
        step.note(
            book.translate(
                _("Angle of {cam} in the program of {joint}, and the lift there:", cam=joint.cam, joint=joint.name)
            )
        )
        formula = book.turn(joint.cam) - book.turn(joint.carrier)
        formula = formula - book.degrees(joint.phase)
        formula = formula if joint.sense > 0 else -formula
        rounds = round((theta.amount - formula.value) / 360.0)
        if rounds:
            turns = number(360.0 * abs(rounds), degrees=True)
            formula = formula + turns if rounds > 0 else formula - turns
        step.find(theta, formula, "°")
        if joint.program is not None:
            self._of_law(step, joint.program)
        else:
            self._of_table(step)

    def _of_law(self, step: Step, program: MotionProgram) -> None:
        translate, swings = self.book.translate, bool(self.joint.side)
        k, law = self._law_at
        start = self.factor * float(program.lift_at_edges[k])
        if law is None:
            step.note(translate(_("Segment {number}: dwell, the lift does not change.", number=k + 1)))
            step.give(self.now.value, self.unit)
            return
        law, scale = program.moved_by[k]
        assert law is not None
        step.note(
            translate(
                _("Segment {number}: {law}; u runs from 0 to 1.", number=k + 1, law=LABELS.get(law.key, law.key))
            )
        )
        low, width = float(program.edges[k]), float(program.edges[k + 1] - program.edges[k])
        begin = step.give(self.named("θ_a", math.degrees(low), degrees=True), "°")
        over = step.give(self.named("β", math.degrees(width), degrees=True), "°")
        arc = step.give(self.named("β_r", width), "rad")
        base = self.named("S_a", start, degrees=swings)
        rise = step.give(self.named("h", self.factor * scale, degrees=swings), self.unit)
        base = step.give(base, self.unit) if start else ZERO
        u_is = (self.now.angle - begin) / over
        u = step.find(self.named("u", u_is.value), u_is, "")
        if law.formula:
            step.relate(symbol("s(u)", 0.0), symbol(law.formula, 0.0))
        s, v, a, _unused = (float(each[0]) for each in law.curves(np.array([u.amount])))
        names = ("s(u)", "s'(u)", "s''(u)")
        shape = [step.give(self.named(name, value), "") for name, value in zip(names, (s, v, a), strict=True)]
        step.find(self.now.value, base + rise * shape[0], self.unit)
        lift = self.named("h_r", scale) if swings else rise
        if swings:
            step.give(lift, "rad")
        step.find(self.now.first, lift * shape[1] / arc, "" if swings else "m/rad")
        step.find(self.now.second, lift * shape[2] / arc.squared, "1/rad" if swings else "m/rad²")

    def _of_table(self, step: Step) -> None:
        translate, lift = self.book.translate, self.joint.lift
        low, high = (float(lift.edges[self._piece + k]) for k in (0, 1))
        row = [float(each) for each in self._row]
        ends = {key: f"{math.degrees(value):.9g}" for key, value in (("low", low), ("high", high))}
        if not any(row[1:]):
            step.note(
                translate(_("From {low}° to {high}° the table rests: the lift does not change.").format(**ends))
            )
            step.give(self.now.value, "m")
            return
        step.note(
            translate(
                _(
                    "Between the points of the table at {low}° and {high}° the lift is a polynomial of t "
                    "from -1 to 1:"
                ).format(**ends)
            )
        )
        middle, half = 0.5 * (low + high), 0.5 * (high - low)
        centre = step.give(self.named("θ_m", math.degrees(middle), degrees=True), "°")
        wide = step.give(self.named("δ", math.degrees(half), degrees=True), "°")
        arc = step.give(self.named("δ_r", half), "rad")
        factors = [step.give(self.named(f"c_{k}", 1e3 * each), "mm") for k, each in enumerate(row)]
        t_is = (self.now.angle - centre) / wide
        t = step.find(self.named("t", t_is.value), t_is, "")
        once = [number(float(k)) * each if k > 1 else each for k, each in enumerate(factors)][1:]
        twice = [number(float(k * (k - 1))) * each for k, each in enumerate(factors)][2:]
        thousand = number(1000.0)
        parts = [_powers(factors, t), _powers(once, t), _powers(twice, t)]
        found = [
            step.find(self.named(name, part.value), part, "mm")
            for name, part in zip(("P", "P'", "P''"), parts, strict=True)
        ]
        step.find(self.now.value, found[0] / thousand, "m")
        step.find(self.now.first, found[1] / (thousand * arc), "m/rad")
        step.find(self.now.second, found[2] / (thousand * arc.squared), "m/rad²")


def _powers(factors: list[Term], t: Term) -> Term:
    """c₀ + c₁ t + c₂ t² + …, which a line may break at every sign."""
    found, power = factors[0], t
    for each in factors[1:]:
        found = found + each * power
        power = t.squared if power == t else power * t
    return found
