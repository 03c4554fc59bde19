"""A cam follower on a spring: the vibration that its motion law excites and leaves behind."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Any, ClassVar

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.expressions import Expression, parse
from linkwright.core.quantity import number
from linkwright.core.table import Block, Row
from linkwright.equations.steps import Step
from linkwright.errors import Finding, QuantityError, RequestError, fault
from linkwright.fields.base import Quantity, file_key
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.fields.nodes import Node
from linkwright.fields.reading import Place, Reader
from linkwright.laws.base import MOTION_LAWS, MotionLaw
from linkwright.laws.fitting import motion_law
from linkwright.laws.program_fields import LawField
from linkwright.laws.residual import residual
from linkwright.parts.base import Problem, Result
from linkwright.parts.vibration.linear import Linear, largest_between
from linkwright.words import Message, Translate, _

#: Points of curves; distance from a break at which a law has the value of its side.
POINTS, SIDE_STEP = 801, 1e-13
#: What the numbers are called.
LABELS: Mapping[str, Message] = {
    "own_frequency": _("natural frequency"),
    "ratio": _("rise time over natural period n"),
    "largest_gap": _("largest difference to the cam during the rise"),
    "left_over": _("largest difference after the rise"),
    "residual": _("residual amplitude without damping"),
    "residual_share": _("its share of the lift"),
}


@dataclass(frozen=True)
class ExpressionLaw(MotionLaw):
    """A rise that is an expression of u, differentiated exactly."""

    key: ClassVar[str] = "expression"
    source: ClassVar[str] = ""
    expression: Expression

    def curves(self, u: Any) -> tuple[Any, Any, Any, Any]:
        with np.errstate(all="ignore"):
            value = self.expression.over({"u": u}) + 0.0 * u
        found = [value, *self.expression.derivatives({"u": u}, "u", 3)]
        s, v, a, j = (np.nan_to_num(each) for each in found)
        return s, v, a, j


@dataclass(frozen=True)
class LawOrExpression(LawField):
    """A motion law by its name or its table, or an expression of u."""

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> Any:
        if isinstance(node, MappingNode):
            return super().read(reader, node, place, siblings)
        return reader.text(node, place)


@dataclass(frozen=True)
class FollowerSpring(Problem):
    """A follower of ``mass`` (kg) driven through a ``stiffness`` (N/m) by a rise of ``lift`` (m) in ``rise_time`` s.

    ``law``: a motion law or its name, or an expression of u from 0 to 1; ``damping_ratio`` ζ.
    """

    kind: ClassVar[str] = "follower"
    mass: float = file_key(Quantity("mass", above=0.0, doc="mass moved by the spring"))
    stiffness: float = file_key(Quantity("stiffness", above=0.0, doc="stiffness between cam and mass"))
    lift: float = file_key(Quantity("length", above=0.0, doc="lift of the rise"))
    rise_time: float = file_key(Quantity("time", above=0.0, doc="time of the rise"))
    law: MotionLaw | str = file_key(LawOrExpression(doc="a motion law, or an expression of u from 0 to 1"))
    damping_ratio: float = file_key(Quantity("dimensionless", minimum=0.0, doc="damping ratio ζ; default: 0"), 0.0)
    name: str = ""
    source: str = ""

    @cached_property
    def motion(self) -> MotionLaw:
        """The law; raises QuantityError for what is no expression, RequestError for a law that needs values."""
        if not isinstance(self.law, str):
            return self.law
        return motion_law(self.law) if self.law in MOTION_LAWS else ExpressionLaw(parse(self.law, ("u",)))

    @property
    def law_name(self) -> str:
        """The law as worked solutions name it."""
        return self.law if isinstance(self.law, str) else self.law.key

    def findings(self) -> list[Finding]:
        known = ", ".join(MOTION_LAWS)
        try:
            law = self.motion
            if isinstance(law, ExpressionLaw):
                ends = [law.expression.evaluate({"u": u}) for u in (0.0, 1.0)]
            else:
                ends = np.asarray(law.curves(np.array([0.0, 1.0]))[0], dtype=float).tolist()
        except QuantityError as error:
            return [
                fault(
                    "law",
                    "law",
                    _('the law "{law}" cannot be read: {why}'),
                    _("use one of {known}, or an expression of u such as 3*u^2 - 2*u^3"),
                    law=self.law,
                    why=error.message,
                    known=known,
                )
            ]
        except RequestError as error:
            return [
                fault(
                    "law",
                    "law",
                    _('the law "{law}" cannot be read: {why}'),
                    _("use one of {known}, or an expression of u such as 3*u^2 - 2*u^3"),
                    law=self.law,
                    why=error.sentence,
                    known=known,
                )
            ]
        if abs(ends[0]) > 1e-9 or abs(ends[1] - 1.0) > 1e-9:
            return [
                fault(
                    "law_ends",
                    "law",
                    _("the law goes from {first} to {last}"),
                    _("a rise goes from 0 at u = 0 to 1 at u = 1"),
                    first=ends[0],
                    last=ends[1],
                )
            ]
        return (
            [
                fault(
                    "overdamped",
                    "damping_ratio",
                    _("a damping ratio of 1 or more leaves no vibration"),
                    _("give a value below 1"),
                )
            ]
            if self.damping_ratio >= 1.0
            else []
        )

    def solve(self) -> FollowerVibration:
        """The vibration. Raises ModelError with all findings."""
        self.require()
        return FollowerVibration(self)


@dataclass(frozen=True, repr=False)
class FollowerVibration(Result):
    """What the follower does against its cam: z = x − s with z̈ + 2ζω ż + ω² z = −s̈.

    After the rise it swings with the ``residual`` amplitude |∫ s̈ e^(iωt) dt|/ω (without damping), steps of the
    velocity at the ends included; over n = T/T_n it is the residual spectrum of the law.
    """

    labels: ClassVar[Mapping[str, Message]] = LABELS
    problem: FollowerSpring

    @property
    def frequency(self) -> float:
        """Natural frequency ω, rad/s."""
        return math.sqrt(self.problem.stiffness / self.problem.mass)

    @property
    def ratio(self) -> float:
        """Rise time over the natural period, n = ωT/(2π)."""
        return self.frequency * self.problem.rise_time / (2 * math.pi)

    def residual(self, ratio: Floats | float | None = None) -> Floats:
        """Residual amplitude (m) without damping at ratios n (k,), at its own unless given."""
        ratios = np.asarray(self.ratio if ratio is None else ratio, dtype=float)
        return self.problem.lift * residual(self.problem.motion, ratios)

    def _law(self, order: int, u: Floats) -> Floats:
        return np.asarray(self.problem.motion.curves(u)[order], dtype=float)

    @cached_property
    def _swing(self) -> tuple[Floats, Floats, Floats, Floats]:
        """Times (t,) over the rise and after it, lift of the cam, z = x − s and its rate; jumps stand twice."""
        own, span = self.problem, self.problem.rise_time
        count = 8 * POINTS * min(max(1.0, self.ratio / 100), 30.0)
        after = max(1.0, 1.0 / self.ratio)
        pieces = [
            np.linspace(a, b, max(2, math.ceil(count * (b - a)))) for a, b in pairwise([0.0, *own.motion.breaks, 1.0])
        ]
        later = np.linspace(1.0, 1.0 + after, math.ceil(count))
        u = np.concatenate([*pieces, later])
        inner = np.concatenate([np.clip(each, each[0] + SIDE_STEP, each[-1] - SIDE_STEP) for each in pieces])
        pull = np.append(own.lift / span**2 * self._law(2, inner), np.zeros(len(later)))
        first, last = (own.lift / span * self._law(1, np.array([0.0, 1.0]))).tolist()
        w, zeta, one = self.frequency, own.damping_ratio, np.ones((1, 1))
        blows = {0: np.array([-first]), len(inner): np.array([last])}
        gap, rate = Linear(one, 2 * zeta * w * one, w * w * one).in_time(
            span * u, -pull[:, None], np.zeros(1), np.zeros(1), blows
        )
        return span * u, own.lift * self._law(0, np.minimum(u, 1.0)), gap[:, 0], rate[:, 0]

    @property
    def curves(self) -> tuple[Floats, Floats, Floats]:
        """Times (t,) over the rise and after it, lift s of the cam and of the follower, m."""
        time, cam, gap, _unused = self._swing
        return time, cam, cam + gap

    def _largest_gap(self, after: bool) -> float:
        """Largest size of z during the rise or after it, m."""
        time, _unused, gap, rate = self._swing
        left = int(np.searchsorted(time, self.problem.rise_time, side="right")) - 1
        part = slice(left, None) if after else slice(0, left)
        return abs(largest_between(time[part], gap[part], rate[part])[1])

    def columns(self) -> dict[str, Floats]:
        time, cam, follower = self.curves
        return {"time [s]": time, "cam [m]": cam, "follower [m]": follower, "difference [m]": follower - cam}

    def blocks(self, translate: Translate) -> list[Block]:
        rows = [
            Row("own_frequency", self.frequency / (2 * math.pi), "frequency"),
            Row("ratio", self.ratio),
            Row("largest_gap", self._largest_gap(after=False), "length"),
            Row("left_over", self._largest_gap(after=True), "length"),
            Row("residual", float(self.residual()[0]), "length"),
            Row("residual_share", float(self.residual()[0]) / self.problem.lift),
        ]
        return [Block("follower", "", rows)]

    def steps(self, translate: Translate) -> list[Step]:
        step = Step("1", translate(_("A mass driven through a spring")))
        step.note(translate(_("Rise s(u) = h·f(u) with u = t/T; law f: {law}.", law=self.problem.law_name)))
        step.law("z = x − s; z̈ + 2·ζ·ω·ż + ω²·z = −s̈")
        of = {"k": (self.problem.stiffness, "stiffness"), "m": (self.problem.mass, "mass")}
        step.put("ω", "√(k/m)", self.frequency, "angular_velocity", of=of)
        step.put("n", "ω·T/(2·π)", self.ratio, of={"T": (self.problem.rise_time, "time")})
        step.put("A", "|∫ s̈·e^(i·ω·t) dt|/ω", float(self.residual()[0]), "length")
        quiet = self._quiet()
        if quiet:
            step.note(
                translate(
                    _(
                        "hardly any vibration is left at n = {ratios}",
                        ratios=", ".join(number(n, digits=4) for n in quiet),
                    )
                )
            )
        return [step]

    def _quiet(self) -> list[float]:
        """Ratios n below 6 at which hardly any vibration is left."""
        n = np.linspace(0.2, 6.0, 2901)
        left = self.residual(n) / self.problem.lift
        low = (left[1:-1] < left[:-2]) & (left[1:-1] < left[2:]) & (left[1:-1] < 1e-3)
        return [float(each) for each in n[1:-1][low]]
