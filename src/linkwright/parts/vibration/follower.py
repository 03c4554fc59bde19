"""A cam follower on a spring: the vibration that its motion law excites and leaves behind."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, ClassVar

import numpy as np

from linkwright.errors import Finding, QuantityError
from linkwright.model.expressions import Expression, array_functions, parse
from linkwright.model.fields import Quantity, Text
from linkwright.parts.base import Block, Floats, Problem, Result, Row, fault
from linkwright.parts.display import number
from linkwright.parts.steps import put
from linkwright.parts.vibration.linear import Linear
from linkwright.words import Say
from linkwright.worked.page import Step

#: Rises of unit lift over u = t/T from 0 to 1 (Norton, Cam Design and Manufacturing Handbook, ch. 3).
LAWS: Mapping[str, str] = {
    "cycloidal": "u - sin(2*pi*u)/(2*pi)",
    "simple_harmonic": "(1 - cos(pi*u))/2",
    "polynomial_345": "10*u^3 - 15*u^4 + 6*u^5",
    "polynomial_4567": "35*u^4 - 84*u^5 + 70*u^6 - 20*u^7",
    "constant_velocity": "u",
}
#: Gauss points over the rise, and points of curves.
GAUSS, POINTS = 400, 801


@dataclass(frozen=True)
class FollowerSpring(Problem):
    """A follower of ``mass`` (kg) driven through a ``stiffness`` (N/m) by a rise of ``lift`` (m) in ``rise_time`` s.

    ``law``: a name (cycloidal, simple_harmonic, polynomial_345, polynomial_4567, constant_velocity), or an expression
    of u from 0 to 1; ``damping_ratio`` ζ.
    """

    kind: ClassVar[str] = "follower"
    fields: ClassVar[Mapping[str, Any]] = {
        "mass": Quantity("mass", required=True, above=0.0, doc="mass moved by the spring"),
        "stiffness": Quantity("stiffness", required=True, above=0.0, doc="stiffness between cam and mass"),
        "damping_ratio": Quantity("dimensionless", minimum=0.0, doc="damping ratio ζ, 0 unless given"),
        "lift": Quantity("length", required=True, above=0.0, doc="lift of the rise"),
        "rise_time": Quantity("time", required=True, above=0.0, doc="time of the rise"),
        "law": Text(required=True, doc=f"one of {', '.join(LAWS)}, or an expression of u from 0 to 1"),
    }
    mass: float
    stiffness: float
    lift: float
    rise_time: float
    law: str
    damping_ratio: float = 0.0
    name: str = ""
    source: str = ""

    @property
    def expression(self) -> Expression:
        """The law as an expression of u; raises QuantityError."""
        return parse(LAWS.get(self.law, self.law), ("u",))

    def findings(self) -> list[Finding]:
        try:
            law = self.expression
            ends = [law.evaluate({"u": u}) for u in (0.0, 1.0)]
        except QuantityError as error:
            return [fault("vibration.law", "law", law=self.law, why=error.message, known=", ".join(LAWS))]
        if abs(ends[0]) > 1e-9 or abs(ends[1] - 1.0) > 1e-9:
            return [fault("vibration.law_ends", "law", first=ends[0], last=ends[1])]
        return [fault("vibration.overdamped", "damping_ratio")] if self.damping_ratio >= 1.0 else []

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

    area: ClassVar[str] = "vibration"
    problem: FollowerSpring

    @property
    def title(self) -> str:
        return self.problem.name

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
        n = np.atleast_1d(np.asarray(self.ratio if ratio is None else ratio, dtype=float))
        u, weights = np.polynomial.legendre.leggauss(GAUSS)
        u, weights = (u + 1) / 2, weights / 2
        turn = np.exp(2j * math.pi * np.outer(n, u))
        steps = self._law(1, np.array([0.0, 1.0]))
        whole = turn @ (weights * self._law(2, u)) + steps[0] - steps[1] * np.exp(2j * math.pi * n)
        return np.asarray(self.problem.lift * np.abs(whole) / (2 * math.pi * n))

    def _law(self, order: int, u: Floats) -> Floats:
        law = self.problem.expression
        for _ in range(order):
            law = law.diff("u")
        with np.errstate(all="ignore"):
            found = np.asarray(law.evaluate({"u": u}, array_functions()), dtype=float)
        return np.broadcast_to(np.nan_to_num(found), u.shape)

    @cached_property
    def curves(self) -> tuple[Floats, Floats, Floats]:
        """Times (t,) over the rise and as long after it, lift s of the cam and of the follower, m."""
        time = np.linspace(0.0, 2.0 * self.problem.rise_time, 8 * POINTS + 1)
        u = np.minimum(time / self.problem.rise_time, 1.0)
        cam = self.problem.lift * self._law(0, u)
        w, zeta, m = self.frequency, self.problem.damping_ratio, self.problem.mass
        rate = np.where(time <= self.problem.rise_time, self._law(1, u), 0.0)
        force = m * (w * w * cam + 2 * zeta * w * rate * self.problem.lift / self.problem.rise_time)
        linear = Linear(np.array([[m]]), np.array([[2 * zeta * w * m]]), np.array([[w * w * m]]))
        return time, cam, linear.in_time(time, force[:, None], np.zeros(1), np.zeros(1))[:, 0]

    def columns(self) -> dict[str, Floats]:
        time, cam, follower = self.curves
        return {"time [s]": time, "cam [m]": cam, "follower [m]": follower, "difference [m]": follower - cam}

    def blocks(self, say: Say) -> list[Block]:
        time, cam, follower = self.curves
        gap = np.abs(follower - cam)
        rising = time <= self.problem.rise_time
        rows = [
            Row("own_frequency", self.frequency / (2 * math.pi), "frequency"),
            Row("ratio", self.ratio),
            Row("largest_gap", float(gap[rising].max()), "length"),
            Row("left_over", float(gap[~rising].max()), "length"),
            Row("residual", float(self.residual()[0]), "length"),
            Row("residual_share", float(self.residual()[0]) / self.problem.lift),
        ]
        return [Block("follower", "", rows)]

    def steps(self, say: Say) -> list[Step]:
        step = Step("1", say("vibration.step_follower"))
        step.say(f"  s(u) = h·({self.problem.expression.text}), u = t/T")
        step.say("  z = x − s,  z̈ + 2ζω·ż + ω²·z = −s̈")
        put(step, "ω", "√(k/m)", self.frequency, "angular_velocity")
        put(step, "n", "ω·T/(2π)", self.ratio)
        put(step, "A", "|∫ s̈·e^(iωt) dt|/ω", float(self.residual()[0]), "length")
        quiet = self._quiet()
        if quiet:
            step.say(say("vibration.quiet", ratios=", ".join(number(n, digits=4) for n in quiet)))
        return [step]

    def _quiet(self) -> list[float]:
        """Ratios n below 6 at which hardly any vibration is left."""
        n = np.linspace(0.2, 6.0, 2901)
        left = self.residual(n) / self.problem.lift
        low = (left[1:-1] < left[:-2]) & (left[1:-1] < left[2:]) & (left[1:-1] < 1e-3)
        return [float(each) for each in n[1:-1][low]]
