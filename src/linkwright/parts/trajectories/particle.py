"""A particle thrown in a vertical plane, with drag; also from a point of a mechanism."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any, ClassVar

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.table import Block, Row
from linkwright.equations.steps import Step
from linkwright.errors import Finding, LinkwrightError, ModelError, fault
from linkwright.fields.base import FileKeys, Quantity, Text, file_key
from linkwright.kinematics.solve import solve_motion
from linkwright.mechanism.mechanism import Mechanism
from linkwright.parts.base import Problem, Result
from linkwright.parts.fields import load_referenced
from linkwright.units import GRAVITY
from linkwright.words import Message, Translate, _, pgettext

#: Accuracy of the integration with quadratic drag, and points of the curve.
ACCURACY, POINTS = 1e-11, 401
#: Times in which drag stops the particle, within the flight, above which its equation is stiff.
STIFF = 1e4
#: What the numbers are called.
LABELS: Mapping[str, Message] = {
    "speed": _("speed at the start"),
    "angle": _("direction at the start"),
    "duration": _("time of flight"),
    "distance": pgettext("trajectory", "distance"),
    "top": _("maximum height"),
    "impact_speed": _("speed at the ground"),
    "impact_angle": _("direction at the ground"),
}


@dataclass(frozen=True)
class Particle(Problem):
    """A ``mass`` (kg) thrown with ``speed`` (m/s) under an ``angle`` (rad) from the ``height`` (m) over the ground.

    Drag −b v with ``linear`` b (N·s/m), ``−k |v| v`` with ``quadratic`` k (kg/m); k = ½ ρ c_w A from
    ``drag_coefficient``, ``area`` and ``density`` (of air unless given).
    """

    kind: ClassVar[str] = "trajectory"
    fields = FileKeys(
        {
            "drag_coefficient": Quantity("dimensionless", minimum=0.0, doc="c_w, for k = ½ ρ c_w A"),
            "area": Quantity("area", above=0.0, doc="cross section A"),
            "density": Quantity("density", above=0.0, doc="density of the medium; default: air"),
            "mechanism": Text(doc="model file of a mechanism that throws, in place of speed, angle and height"),
            "point": Text(doc="the point of the mechanism that lets go, such as bucket.P"),
            "at": Quantity("angle", doc="angle of the input at which it lets go"),
            "ground": Quantity("length", doc="height of the ground in the mechanism's axes; default: 0"),
        }
    )
    speed: float | None = file_key(Quantity("velocity", minimum=0.0, doc="speed at the start"), None)
    angle: float | None = file_key(Quantity("angle", doc="direction of the throw above the horizontal"), None)
    height: float = file_key(
        Quantity("length", minimum=0.0, doc="height of the start above the ground; default: 0"), 0.0
    )
    mass: float = file_key(Quantity("mass", above=0.0, doc="mass, needed with drag"), 1.0)
    linear: float = file_key(Quantity("damping", minimum=0.0, doc="linear drag b"), 0.0)
    quadratic: float = file_key(Quantity("linear_density", minimum=0.0, doc="quadratic drag k"), 0.0)
    gravity: float = file_key(Quantity("acceleration", above=0.0, doc="9.80665 m/s² unless given"), GRAVITY)
    start: float = 0.0
    name: str = ""
    source: str = ""

    @classmethod
    def of_file(cls, values: Mapping[str, Any], folder: Path) -> Particle:
        own = dict(values)
        medium = {key: own.pop(key, None) for key in ("drag_coefficient", "area", "density")}
        thrower = {key: own.pop(key, None) for key in ("mechanism", "point", "at", "ground")}
        found = []
        if any(v is not None for v in medium.values()):
            if medium["drag_coefficient"] is None or medium["area"] is None or own.get("quadratic") is not None:
                found.append(
                    fault(
                        "drag_form",
                        "drag_coefficient",
                        _("the drag is neither complete nor unique"),
                        _("give quadratic, or drag_coefficient with area"),
                    )
                )
            else:
                own["quadratic"] = 0.5 * (medium["density"] or 1.225) * medium["drag_coefficient"] * medium["area"]
        if (own.get("quadratic") or own.get("linear")) and own.get("mass") is None:
            found.append(
                fault("mass_needed", "mass", _("drag acts on a mass, and there is none"), _("give the mass"))
            )
        if found:
            raise ModelError(found)
        if thrower["mechanism"] is None:
            return cls(**own)
        return cls.thrown(load_referenced(thrower["mechanism"], folder), thrower, own)

    @classmethod
    def thrown(cls, mechanism: Mechanism, by: Mapping[str, Any], own: Mapping[str, Any]) -> Particle:
        """Thrown by the ``point`` of a mechanism when its input is ``at`` an angle, above the ``ground``."""
        if by.get("point") is None or by.get("at") is None or "speed" in own or "angle" in own:
            raise ModelError(
                [
                    fault(
                        "thrower_form",
                        "mechanism",
                        _("a throw by a mechanism needs point and at, and neither speed nor angle"),
                        _("write mechanism: FILE, point: bucket.P, at: 40 deg"),
                    )
                ]
            )
        try:
            motion = solve_motion(mechanism, at=[by["at"]])
            place, velocity = motion.point(by["point"]).position[0], motion.point(by["point"]).velocity[0]
        except LinkwrightError as error:
            raise ModelError(
                [
                    fault(
                        "thrower",
                        "mechanism",
                        _("the mechanism cannot be solved: {why}"),
                        _("mend the model or the names (linkwright check)"),
                        why=error.sentence,
                    )
                ]
            ) from None
        speed = float(np.hypot(*velocity))
        angle = math.atan2(velocity[1], velocity[0]) if speed else 0.0
        height = float(place[1]) - (by.get("ground") or 0.0)
        return cls(**{**own, "speed": speed, "angle": angle, "height": height, "start": float(place[0])})

    def findings(self) -> list[Finding]:
        found = []
        if self.speed is None or self.angle is None:
            found.append(
                fault(
                    "start",
                    "speed",
                    _("the throw has no start"),
                    _("give speed and angle, or a mechanism with point and at"),
                )
            )
        if self.height < 0:
            found.append(
                fault(
                    "below",
                    "height",
                    _("the start lies {height} m below the ground"),
                    _("give a height of zero or more, or another ground"),
                    height=self.height,
                )
            )
        if self.linear and self.quadratic:
            found.append(fault("one_drag", "linear", _("there are two kinds of drag"), _("give linear or quadratic")))
        return found

    def solve(self) -> Flight:
        """The flight until the ground. Raises ModelError with all findings."""
        self.require()
        return Flight(self)


def _decayed(x: Floats) -> tuple[Floats, Floats, Floats]:
    """e^(−x), (1 − e^(−x))/x and (x − 1 + e^(−x))/x² at x (n,), by its series where x is small."""
    small = np.abs(x) < 0.05
    far = np.where(small, 1.0, x)
    once, twice = np.ones_like(x), np.full_like(x, 0.5)
    for k in range(12, 0, -1):
        once, twice = 1 - x / (k + 1) * once, 0.5 - x / (k + 2) * twice
    exact = -np.expm1(-far) / far
    return np.exp(-x), np.where(small, once, exact), np.where(small, twice, (1 - exact) / far)


@dataclass(frozen=True, repr=False)
class Flight(Result):
    """A flight from the start to the ground, x from the start's, y from the ground; SI.

    Without drag and with linear drag in closed form (Symon, Mechanics, ch. 3), with quadratic drag integrated to a
    relative accuracy of 1e-11.
    """

    labels: ClassVar[Mapping[str, Message]] = LABELS
    particle: Particle

    @property
    def first(self) -> tuple[float, float]:
        """Velocity at the start, m/s."""
        speed, angle = self.particle.speed or 0.0, self.particle.angle or 0.0
        return speed * math.cos(angle), speed * math.sin(angle)

    def state(self, time: Floats) -> Floats:
        """x, y, velocities (4, t) at times (t,)."""
        p, (u, v) = self.particle, self.first
        if p.quadratic:
            return np.asarray(self._integrated.sol(time))
        if p.linear:
            e, once, twice = _decayed(p.linear / p.mass * time)
            return np.array(
                [
                    p.start + u * time * once,
                    p.height + time * (v * once - p.gravity * time * twice),
                    u * e,
                    v * e - p.gravity * time * once,
                ]
            )
        return np.array(
            [p.start + u * time, p.height + v * time - p.gravity * time**2 / 2, u + 0 * time, v - p.gravity * time]
        )

    @cached_property
    def _integrated(self) -> Any:
        from scipy.integrate import solve_ivp

        p = self.particle

        def rate(_: float, s: Floats) -> list[float]:
            drag = p.quadratic / p.mass * math.hypot(s[2], s[3])
            return [s[2], s[3], -drag * s[2], -p.gravity - drag * s[3]]

        longest = 2 * (abs(self.first[1]) + math.sqrt(2 * p.gravity * p.height)) / p.gravity
        longest += p.height * math.sqrt(p.quadratic / (p.mass * p.gravity)) * 2
        start, end = [p.start, p.height, *self.first], max(longest, 1e-9)
        fastest = max(math.hypot(*self.first), math.sqrt(p.mass * p.gravity / p.quadratic))
        while True:
            stiff = p.quadratic / p.mass * fastest * end > STIFF
            method, share = ("LSODA", 1e-13) if stiff else ("DOP853", ACCURACY)
            found = solve_ivp(rate, (0.0, end), start, method, rtol=share, atol=share, dense_output=True)
            if found.y[1, -1] <= 0:
                return found
            end *= 2

    @cached_property
    def duration(self) -> float:
        """Time until the ground, s."""
        from scipy.optimize import brentq

        p, (_unused, v) = self.particle, self.first
        if not p.quadratic and not p.linear:
            return (v + math.sqrt(v * v + 2 * p.gravity * p.height)) / p.gravity
        if p.height == 0.0 and v <= 0.0:
            return 0.0
        top, fall = self.top_time, math.sqrt(2 * self.top / p.gravity)
        while top + fall < self._latest and self._height(top + fall) > 0:
            fall *= 2
        end = min(top + fall, self._latest)
        if self._height(end) >= 0.0:  # it lands there but for rounding
            return end
        return float(brentq(self._height, top, end, xtol=1e-14, rtol=1e-14))

    @property
    def _latest(self) -> float:
        """A time by which it has landed, as far as it is integrated, s."""
        return float(self._integrated.t[-1]) if self.particle.quadratic else math.inf

    def _rate(self, time: float) -> float:
        """Vertical velocity, m/s."""
        return float(self.state(np.array([time]))[3, 0])

    def _height(self, time: float) -> float:
        return float(self.state(np.array([time]))[1, 0])

    @cached_property
    def top_time(self) -> float:
        """Time of the highest place, s; 0 for a throw downwards."""
        from scipy.optimize import brentq

        p, (_unused, v) = self.particle, self.first
        if v <= 0.0:
            return 0.0
        if not p.quadratic and not p.linear:
            return v / p.gravity
        latest = v / p.gravity
        if self._rate(latest) >= 0.0:  # the drag is below rounding
            return latest
        return float(brentq(self._rate, 0.0, latest, xtol=1e-14))

    @property
    def range(self) -> float:
        """Horizontal distance from the start to the place of impact, m."""
        return float(self.state(np.array([self.duration]))[0, 0]) - self.particle.start

    @property
    def top(self) -> float:
        """Maximum height above the ground, m."""
        return float(self.state(np.array([self.top_time]))[1, 0])

    @property
    def impact(self) -> tuple[float, float]:
        """Speed (m/s) and direction (rad) at the ground."""
        _unused, _unused2, u, v = self.state(np.array([self.duration]))[:, 0]
        return math.hypot(u, v), math.atan2(v, u)

    def columns(self) -> dict[str, Floats]:
        time = np.linspace(0.0, self.duration, POINTS)
        x, y, u, v = self.state(time)
        return {"time [s]": time, "x [m]": x, "y [m]": y, "vx [m/s]": u, "vy [m/s]": v}

    def blocks(self, translate: Translate) -> list[Block]:
        speed, angle = self.impact
        rows = [
            Row("speed", self.particle.speed or 0.0, "velocity"),
            Row("angle", self.particle.angle or 0.0, "angle"),
            Row("duration", self.duration, "time"),
            Row("distance", self.range, "distance"),
            Row("top", self.top, "distance"),
            Row("impact_speed", speed, "velocity"),
            Row("impact_angle", angle, "angle"),
        ]
        return [Block("flight", "", rows)]

    def steps(self, translate: Translate) -> list[Step]:
        p, step = self.particle, Step("1", translate(_("Equations of motion and their solution")))
        if p.quadratic:
            step.law("m·v̇_x = −k·v·v_x; m·v̇_y = −m·g − k·v·v_y; v = √(v_x² + v_y²)")
            of = {"m": (p.mass, "mass"), "g": (p.gravity, "acceleration"), "k": (p.quadratic, "linear_density")}
            step.put("v∞", "√(m·g/k)", math.sqrt(p.mass * p.gravity / p.quadratic), "velocity", of=of)
        elif p.linear:
            step.law("m·v̇_x = −b·v_x; m·v̇_y = −m·g − b·v_y")
            step.law("x = v_x·τ·(1 − e^(−t/τ)); y = h + (v_y + g·τ)·τ·(1 − e^(−t/τ)) − g·τ·t")
            step.put("τ", "m/b", p.mass / p.linear, "time", of={"m": (p.mass, "mass"), "b": (p.linear, "damping")})
        else:
            step.law("x = v_x·t; y = h + v_y·t − g·t²/2")
        step.known |= {
            "v": (p.speed or 0.0, "velocity"),
            "α": (p.angle or 0.0, "angle"),
            "h": (p.height, "distance"),
            "g": (p.gravity, "acceleration"),
        }
        step.put("v_x", "v·cos α", self.first[0], "velocity")
        step.put("v_y", "v·sin α", self.first[1], "velocity")
        free = not (p.linear or p.quadratic)
        step.put("T", "(v_y + √(v_y² + 2·g·h))/g" if free else "", self.duration, "time")
        step.put("x(T)", "v_x·T" if free else "", self.range, "distance")
        top = "h + v_y²/(2·g)" if free and self.first[1] > 0 else ""
        step.put("y_max", top, self.top, "distance")
        return [step]
