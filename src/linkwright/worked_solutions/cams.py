"""Cams in worked solutions: the lift and its rates, the follower's place, pressure angle, profile, contact force.

With the cam's angle θ, the lift S(θ) and σ = ±1 for the turn in which the program runs on. A guided follower: d the
height of its point above the cam's centre at the base circle, e its offset to the right of the way. An oscillating
one: c the distance of the axes, l the arm, ψ₀ its angle to the line of axes at the base circle, ± its side of it.
Profile and pressure angle as in Norton, Cam Design and Manufacturing Handbook, ch. 7.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from linkwright.core.outputs import Output
from linkwright.equations.steps import Step
from linkwright.equations.terms import FOUR, NOWHERE, ONE, TWO, ZERO, Pair, Term, cosine, direction, root, sine
from linkwright.joints.cam import CamJoint
from linkwright.words import _
from linkwright.worked_solutions.lifts import Lift, LiftWriter
from linkwright.worked_solutions.places import Places
from linkwright.worked_solutions.symbols import SymbolTable


def cam_pair(joint: CamJoint, book: SymbolTable) -> CamPair:
    """The cam of a joint."""
    return Swinging(book, joint) if joint.side else Guided(book, joint)


@dataclass(frozen=True)
class CamPair(ABC):
    """What both kinds have in common."""

    book: SymbolTable
    joint: CamJoint

    @cached_property
    def lifts(self) -> LiftWriter:
        """Symbols of the lift."""
        return LiftWriter(self.book, self.joint)

    @property
    def lift(self) -> Lift:
        """θ, S, S', S'' in this position."""
        return self.lifts.now

    def signed(self, term: Term) -> Term:
        """σ times a term."""
        return term if self.joint.sense > 0 else -term

    def _of(self, name: str, value: float, *, degrees: bool = False) -> Term:
        return self.lifts.named(name, value, degrees=degrees)

    def _found(self, step: Step, name: str, formula: Term, unit: str, *, degrees: bool = False) -> Term:
        """A quantity of the cam's own with its formula; a plain zero stays one."""
        if formula.is_zero:
            return ZERO
        return step.find(self._of(name, formula.value, degrees=degrees), formula, unit)

    @cached_property
    def base(self) -> Term:
        """Radius of the base circle."""
        return self._of("r_b", self.joint.base_radius)

    @cached_property
    def roller(self) -> Term:
        """Radius of the roller; nothing without one."""
        return self._of("r_r", self.joint.roller_radius) if self.joint.touch == "roller" else ZERO

    def _radii(self, step: Step) -> Term:
        """Notes the radii; their sum."""
        for term in (self.base, self.roller):
            if not term.is_zero:
                step.give(term, "m")
        return self.base + self.roller

    def _lifted(self, *, second: bool) -> Term:
        """The lift's rate in time, S' θ', or its second derivative S'' θ'² + S' θ''."""
        book, lift = self.book, self.lift
        spin = book.omega(self.joint.cam) - book.omega(self.joint.carrier)
        if not second:
            return self.signed(lift.first) * spin
        turned = book.alpha(self.joint.cam) - book.alpha(self.joint.carrier)
        return lift.second * spin.squared + self.signed(lift.first) * turned

    def rate(self, step: Step, *, second: bool) -> None:
        if not self._lifted(second=second).is_zero:
            step.note(
                self.book.translate(
                    _(
                        "The lift of {joint} differentiated, with the angular velocity and acceleration of "
                        "the cam against its carrier:",
                        joint=self.joint.name,
                    )
                )
            )
        name, formula, output = self._rate(second=second)
        if not name.is_zero:
            step.find(name, formula, output)

    @abstractmethod
    def place(self, step: Step, places: Places) -> None:
        """Writes the lift and the follower's coordinate."""

    @abstractmethod
    def effort(self, step: Step, right: Term) -> Term:
        """What multiplies its row, from the known forces on the follower."""

    @abstractmethod
    def contact(self, step: Step, force: Term) -> tuple[Pair, Pair, Term]:
        """Force on the follower, where it acts, and its couple there."""

    @abstractmethod
    def shape(self, step: Step) -> None:
        """Pressure angle, profile and curvature."""

    @abstractmethod
    def _rate(self, *, second: bool) -> tuple[Term, Term, Output]:
        """The unknown rate, its formula, and which output it is."""

    @property
    def title(self) -> str:
        return self.book.translate(_("Cam {joint}: pressure angle and profile", joint=self.joint.name))

    def _profile(self, step: Step, place: Pair, normal: Pair) -> None:
        """Pitch curve and profile in the cam's axes, from the point and the normal that leads away from the cam."""
        if self.roller.is_zero:
            point = place
        else:
            step.note(self.book.translate(_("Pitch curve in the cam's axes:")))
            point = Pair(self._found(step, "x_p", place.x, "m"), self._found(step, "y_p", place.y, "m"))
        step.note(self.book.translate(_("Profile in the cam's axes:")))
        point = point - normal.times(self.roller)
        self._found(step, "x_n", point.x, "m")
        self._found(step, "y_n", point.y, "m")

    def _radius(self, step: Step, square: Term, turn: Term) -> None:
        """Radius of curvature of pitch curve and profile, from |p'|² and p' × p''."""
        step.note(self.book.translate(_("Radius of curvature (positive: convex):")))
        q = self._found(step, "q", square, "m²")
        k = self._found(step, "k", turn, "m²")
        if not k.value:
            return
        curve = q * root(q) / k
        if self.roller.is_zero:
            self._found(step, "ρ", curve, "m")
            return
        pitch = self._found(step, "ρ_p", curve, "m")
        self._found(step, "ρ", pitch - self.roller, "m")


class Guided(CamPair):
    """A follower on a guide."""

    @cached_property
    def _geometry(self) -> tuple[float, float, float, float]:
        """Angle of the way in the carrier's axes, d, e to the right, and where the point is at displacement 0."""
        found = self.joint.geometry(self.book.mechanism)
        return found.along, found.start, -found.aside, found.ahead

    @property
    def offset(self) -> Term:
        """e, nothing for a follower through the cam's centre and for a flat face."""
        e = self._geometry[2]
        return ZERO if abs(e) < 1e-15 or self.joint.touch == "flat" else self._of("e", e)

    @property
    def start(self) -> Term:
        """d; of a flat face the base circle's radius."""
        return self.base if self.joint.touch == "flat" else self._of("d", self._geometry[1])

    @property
    def height(self) -> Term:
        """Of the follower's point above the cam's centre."""
        return self.start + self.lift.value

    def place(self, step: Step, places: Places) -> None:
        book, name = self.book, self.joint.holder
        self.lifts.write(step)
        step.note(
            book.translate(
                _(
                    "Height of {point} above the cam's centre, along {guide}: d + S. b: where {point} is "
                    "along it when the displacement is 0.",
                    point=self.joint.at,
                    guide=name,
                )
            )
        )
        radius = self._radii(step)
        if not self.offset.is_zero:
            step.give(self.offset, "m")
        if self.joint.touch != "flat":
            formula = radius if self.offset.is_zero else root(radius.squared - self.offset.squared)
            step.find(self.start, formula, "m")
        ahead = self._of("b", self._geometry[3])
        behind = ZERO if abs(ahead.amount) < 1e-15 else step.give(ahead, "m")
        slide = places.guide(step, name)
        places.displacement(step, slide, self.height - behind)

    def _rate(self, *, second: bool) -> tuple[Term, Term, Output]:
        slide = self.book.slide(self.joint.holder)
        name = slide.second if second else slide.rate
        return name, self._lifted(second=second), Output("displacement", slide.joint).course[1 + second]

    def effort(self, step: Step, right: Term) -> Term:
        """V, the force along the follower's way."""
        step.note(
            self.book.translate(
                _(
                    "V: what {joint} exerts along the follower's way; across it V tan α, by the "
                    "direction of the normal.",
                    joint=self.joint.name,
                )
            )
        )
        force = self._of("V", right.value)
        return step.give(force, "N") if right.is_zero else step.find(force, right, "N")

    def shape(self, step: Step) -> None:
        book, lift, flat = self.book, self.lift, self.joint.touch == "flat"
        step.note(book.translate(_("Direction of the follower's way in the cam's axes:")))
        along = book.turn(self.joint.carrier) + book.degrees(self._geometry[0]) - book.turn(self.joint.cam)
        heading = self._found(step, "ν", along, "°", degrees=True)
        c, s, first = cosine(heading), sine(heading), self.signed(lift.first)
        n, aside = Pair(c, s), Pair(-s, c)
        if flat:
            self._profile(step, n.times(self.height) - aside.times(first), NOWHERE)
            step.note(book.translate(_("Radius of curvature (positive: convex):")))
            self._found(step, "ρ", self.height + lift.second, "m")
            return
        step.note(book.translate(_("Pressure angle, between the normal and the velocity of the follower:")))
        alpha = self._found(step, "α", direction(first - self.offset, self.height), "°", degrees=True)
        place = n.times(self.height) - aside.times(self.offset)
        self._profile(step, place, Pair(cosine(heading + alpha), sine(heading + alpha)))
        a, g = self.height, lift.first - self.signed(self.offset)
        self._radius(
            step, a.squared + g.squared, a * (a - lift.second) + g * (TWO * lift.first - self.signed(self.offset))
        )

    def contact(self, step: Step, force: Term) -> tuple[Pair, Pair, Term]:
        joint, book = self.joint, self.book
        slide = book.slide(joint.holder)
        outward = book.mechanism.guides[joint.holder].block == joint.follower
        n, first = slide.along if outward else -slide.along, self.signed(self.lift.first)
        if joint.touch == "flat":
            return n.times(force), book.spot(joint.cam, joint.centre).place, first * force
        lean = first - self.offset
        found = n.times(force)
        if not lean.is_zero:
            found = found + n.perp.times(lean * force / self.height)
        return found, book.spot(joint.follower, joint.at).place, ZERO


class Swinging(CamPair):
    """A follower on a pivot."""

    @property
    def side(self) -> int:
        """1 left, -1 right of the line from the pivot to the cam's centre."""
        return 1 if self.joint.side == "left" else -1

    def sided(self, term: Term) -> Term:
        """± a term, by the side."""
        return term if self.side > 0 else -term

    @cached_property
    def _angles(self) -> tuple[Term, Term, float]:
        """Directions of the line of axes in the carrier's and of the arm in the follower's axes, and ψ₀, °."""
        found = self.joint.geometry(self.book.mechanism)
        return self.book.degrees(found.along), self.book.degrees(found.own), math.degrees(found.start)

    @cached_property
    def sizes(self) -> tuple[Term, Term]:
        """Distance of the axes and length of the arm."""
        carrier = self.book.mechanism.link(self.joint.carrier).points
        own = self.book.mechanism.link(self.joint.follower).points
        line = np.subtract(carrier[self.joint.centre], carrier[self.joint.holder])
        arm = np.subtract(own[self.joint.at], own[self.joint.holder])
        return self._of("c", float(np.hypot(*line))), self._of("l", float(np.hypot(*arm)))

    @property
    def psi(self) -> Term:
        """ψ₀ + S."""
        return self._of("ψ0", self._angles[2], degrees=True) + self.lift.value

    def place(self, step: Step, places: Places) -> None:
        book = self.book
        self.lifts.write(step)
        step.note(
            book.translate(
                _("Angle of the arm to the line from {pivot} to the cam's centre: ψ0 + S.", pivot=self.joint.holder)
            )
        )
        c, length = self.sizes
        radius = self._radii(step)
        step.give(c, "m")
        if self.joint.touch == "flat":
            start = direction(radius, root(c.squared - radius.squared))
        else:
            step.give(length, "m")
            part = c.squared + length.squared - radius.squared
            k = step.find(self._of("k0", part.value), part, "m²")
            start = direction(root(FOUR * c.squared * length.squared - k.squared), k)
        step.find(self._of("ψ0", start.value, degrees=True), start, "°")
        line, own, _unused = self._angles
        turned = book.turn(self.joint.carrier) + line - own
        psi = self.psi
        places.angle(step, self.joint.follower, turned + psi if self.side > 0 else turned - psi)

    def _rate(self, *, second: bool) -> tuple[Term, Term, Output]:
        book, link = self.book, self.joint.follower
        rate = book.alpha if second else book.omega
        lifted = self._lifted(second=second)
        formula = rate(self.joint.carrier) + lifted if self.side > 0 else rate(self.joint.carrier) - lifted
        return rate(link), formula, Output("angle", link).course[1 + second]

    def effort(self, step: Step, right: Term) -> Term:
        """M, the moment about the pivot, positive where it lifts."""
        step.note(
            self.book.translate(
                _(
                    "M: moment of {joint} about the follower's pivot; the contact force follows from the "
                    "direction of the normal.",
                    joint=self.joint.name,
                )
            )
        )
        moment = self._of("M", self.side * right.value)
        return step.give(moment, "N·m") if right.is_zero else step.find(moment, self.sided(right), "N·m")

    def shape(self, step: Step) -> None:
        book, joint = self.book, self.joint
        step.note(
            book.translate(
                _("Directions of the arm and of the line of axes in the cam's axes, and the angle between them:")
            )
        )
        line, own, _unused = self._angles
        arm_at = book.turn(joint.follower) + own - book.turn(joint.cam)
        line_at = book.turn(joint.carrier) + line - book.turn(joint.cam)
        arm_at = self._found(step, "ν", arm_at, "°", degrees=True)
        line_at = self._found(step, "κ", line_at, "°", degrees=True)
        psi = self._found(step, "ψ", self.psi, "°", degrees=True)
        arm, axes = Pair(cosine(arm_at), sine(arm_at)), Pair(cosine(line_at), sine(line_at))
        (self._flat if joint.touch == "flat" else self._round)(step, arm, axes, psi)

    def _round(self, step: Step, arm: Pair, axes: Pair, psi: Term) -> None:
        """Roller or edge: |p'|² and p' × p'' in the axes of the arm."""
        c, length = self.sizes
        lift, first = self.lift, self.sided(self.signed(self.lift.first))
        one = length * (ONE - first) - c * cosine(psi)
        two = c * sine(psi)
        step.note(self.book.translate(_("Normal of the pitch curve along the arm and across it:")))
        one = self._found(step, "m_1", one, "m")
        two = self._found(step, "m_2", two, "m")
        step.note(self.book.translate(_("Pressure angle, between the normal and the velocity of the follower:")))
        alpha = self._found(step, "α", direction(one, two), "°", degrees=True)
        normal = arm.times(sine(alpha)) + arm.perp.times(self.sided(cosine(alpha)))
        self._profile(step, arm.times(length) - axes.times(c), normal)
        square = one.squared + two.squared
        self._radius(step, square, square - length * (one * first * (ONE - first) + two * lift.second))

    def _flat(self, step: Step, arm: Pair, axes: Pair, psi: Term) -> None:
        """A face through the pivot: the contact lies under the instant centre of follower and cam."""
        c, lift = self.sizes[0], self.lift
        w = self._found(step, "w", ONE - self.sided(self.signed(lift.first)), "")
        reach = self._found(step, "t_f", c * cosine(psi) / w, "m")
        self._profile(step, arm.times(reach) - axes.times(c), NOWHERE)
        step.note(self.book.translate(_("Radius of curvature (positive: convex):")))
        bent = c * cosine(psi) * lift.second - c * sine(psi) * lift.first.squared * w
        self._found(step, "ρ", c * sine(psi) + bent / (w * w.squared), "m")

    def contact(self, step: Step, force: Term) -> tuple[Pair, Pair, Term]:
        joint, book = self.joint, self.book
        pivot = book.spot(joint.follower, joint.holder).place
        centre = book.spot(joint.cam, joint.centre).place
        driven = self.signed(self.lift.first)
        if joint.touch == "flat":
            turn = book.turn(joint.follower) + self._angles[1]
            n = Pair(-sine(turn), cosine(turn))
            n = n if self.side > 0 else -n
            arm = (centre - pivot).cross(n)
            return n.times((self.sided(ONE) - driven) * force / arm), pivot, self.sided(force)
        at = book.spot(joint.follower, joint.at).place
        a, b = at - pivot, at - centre
        area = step.find(self._of("A", a.cross(b).value), a.cross(b), "m²")
        moment = (b if self.side > 0 else -b) - a.times(driven)
        return moment.times(force / area), at, ZERO
