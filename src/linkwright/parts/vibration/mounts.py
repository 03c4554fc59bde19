"""A machine on elastic mounts, shaken by the inertia forces of its mechanism."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, ClassVar

import numpy as np

from linkwright.errors import Finding, LinkwrightError, ModelError
from linkwright.kinetostatics.forces import Forces, solve_forces
from linkwright.model.fields import Quantity
from linkwright.model.mechanism import Mechanism
from linkwright.parts.base import Block, Floats, Result, Row, fault
from linkwright.parts.display import number
from linkwright.parts.fields import Whole
from linkwright.parts.mechanism_field import MECHANISM, OfMechanism
from linkwright.parts.steps import put
from linkwright.parts.vibration.linear import Complexes
from linkwright.words import Say
from linkwright.worked.page import Step

#: Harmonics below this share of the largest are not listed.
SMALL = 1e-3


@dataclass(frozen=True)
class Mounts(OfMechanism):
    """A machine of ``mass`` (kg, frame and moving links) on mounts of ``stiffness_x``, ``stiffness_y`` (N/m).

    ``damping_ratio`` ζ of both directions. x and y are those of the mechanism's frame; the machine does not rock.
    """

    kind: ClassVar[str] = "mounts"
    fields: ClassVar[Mapping[str, Any]] = {
        "mechanism": MECHANISM,
        "mass": Quantity("mass", required=True, above=0.0, doc="mass of the whole machine"),
        "stiffness_x": Quantity("stiffness", required=True, above=0.0, doc="of all mounts along x"),
        "stiffness_y": Quantity("stiffness", required=True, above=0.0, doc="of all mounts along y"),
        "damping_ratio": Quantity("dimensionless", minimum=0.0, doc="damping ratio ζ, 0 unless given"),
        "steps": Whole(8, doc="positions over the cycle, 360 unless given"),
    }
    mechanism: Mechanism
    mass: float
    stiffness_x: float
    stiffness_y: float
    damping_ratio: float = 0.0
    steps: int = 360
    name: str = ""
    source: str = ""

    @cached_property
    def forces(self) -> Forces:
        """Forces over the cycle; raises LinkwrightError."""
        return solve_forces(self.mechanism, steps=self.steps)

    def findings(self) -> list[Finding]:
        try:
            time = self.forces.motion.time
        except LinkwrightError as error:
            return [fault("vibration.not_passed", "mechanism", why=error.sentence)]
        gaps = np.diff(time)
        even = len(gaps) and np.ptp(gaps) < 1e-9 * abs(gaps[0]) and self.forces.motion.positions.closed
        found = [] if even else [fault("vibration.uneven", "mechanism")]
        moving = sum(link.mass for link in self.mechanism.links.values())
        if self.mass < moving:
            found.append(fault("vibration.too_light", "mass", moving=moving))
        return found

    def solve(self) -> Shaken:
        """The machine's vibration. Raises ModelError with all findings, also for a resonance without damping."""
        self.require()
        shaken = Shaken(self)
        if not self.damping_ratio:
            for axis, own in zip("xy", shaken.frequencies, strict=True):
                order = own / shaken.speed
                near = abs(order - round(order)) < 1e-9 and round(order) > 0
                if near and abs(shaken.harmonics[round(order), "xy".index(axis)]) > 0:
                    hertz = own / (2 * math.pi)
                    raise ModelError([fault("vibration.resonance", f"stiffness_{axis}", hertz=hertz)])
        return shaken


@dataclass(frozen=True, repr=False)
class Shaken(Result):
    """Steady vibration of a machine on its mounts under the mechanism's shaking force, harmonic by harmonic.

    X_k = F_k/(K − m (kω)² + i kω c); the ground gets (K + i kω c) X_k. ``harmonics`` F_k (h, 2) N of the force
    Σ Re F_k e^(ikωt); ``moved``, ``passed`` in the same way.
    """

    area: ClassVar[str] = "vibration"
    problem: Mounts

    @property
    def title(self) -> str:
        return self.problem.name

    @property
    def period(self) -> float:
        """Time of a cycle, s."""
        time = self.problem.forces.motion.time
        return float((time[1] - time[0]) * len(time))

    @property
    def speed(self) -> float:
        """Basic angular frequency of the cycle, rad/s."""
        return 2 * math.pi / self.period

    @property
    def stiffness(self) -> Floats:
        """Of the mounts along x and y, (2,) N/m."""
        return np.array([self.problem.stiffness_x, self.problem.stiffness_y])

    @property
    def frequencies(self) -> Floats:
        """Natural frequencies along x and y, (2,) rad/s."""
        return np.asarray(np.sqrt(self.stiffness / self.problem.mass))

    @cached_property
    def harmonics(self) -> Complexes:
        """Amplitudes F_k of the shaking force, (h, 2) N, k = 0 the mean."""
        force = self.problem.forces.shaking_force
        found = np.fft.rfft(force, axis=0) * 2 / len(force)
        found[0] /= 2
        return np.asarray(np.where(np.abs(found) < 1e-12 * np.abs(found).max(), 0.0, found))

    @property
    def orders(self) -> Floats:
        """Angular frequencies of the harmonics, (h,) rad/s."""
        return np.asarray(np.arange(len(self.harmonics)) * self.speed, dtype=float)

    @property
    def _rates(self) -> Floats:
        return 2 * self.problem.damping_ratio * np.sqrt(self.stiffness * self.problem.mass)

    @cached_property
    def moved(self) -> Complexes:
        """Amplitudes of the machine's motion, (h, 2) m."""
        w = self.orders[:, None]
        return np.asarray(self.harmonics / (self.stiffness - self.problem.mass * w**2 + 1j * w * self._rates))

    @property
    def passed(self) -> Complexes:
        """Amplitudes of the force on the ground, (h, 2) N."""
        return np.asarray((self.stiffness + 1j * self.orders[:, None] * self._rates) * self.moved)

    def _curve(self, amplitudes: Complexes) -> Floats:
        n = len(self.problem.forces.motion.time)
        whole = amplitudes * n / 2
        whole[0] *= 2
        return np.asarray(np.fft.irfft(whole, n, axis=0))

    def columns(self) -> dict[str, Floats]:
        moved, passed = self._curve(self.moved), self._curve(self.passed)
        force = self.problem.forces.shaking_force
        found = {"time [s]": self.problem.forces.motion.time}
        for i, axis in enumerate("xy"):
            found[f"shaking force {axis} [N]"] = force[:, i]
            found[f"machine {axis} [m]"] = moved[:, i]
            found[f"force on ground {axis} [N]"] = passed[:, i]
        return found

    def blocks(self, say: Say) -> list[Block]:
        columns, rows = self.columns(), []
        for i, axis in enumerate("xy"):
            rows.append(
                Row(
                    f"own_{axis}",
                    self.frequencies[i] / (2 * math.pi),
                    "frequency",
                    say("vibration.own", axis=axis),
                )
            )
            for key, name, dimension in (("shaking", f"shaking force {axis} [N]", "force"),
                                         ("machine", f"machine {axis} [m]", "length"),
                                         ("ground", f"force on ground {axis} [N]", "force")):  # fmt: skip
                largest = float(np.abs(columns[name]).max())
                rows.append(Row(f"{key}_{axis}", largest, dimension, say(f"vibration.{key}", axis=axis)))
        found = [Block("mounts", say("vibration.largest_values"), rows)]
        listed = []
        for k in self.listed():
            for i, axis in enumerate("xy"):
                label = say(
                    "vibration.harmonic",
                    order=k,
                    axis=axis,
                    hertz=number(float(self.orders[k]) / (2 * math.pi)),
                )
                moved, passed = (
                    number(float(abs(each[k, i])), d)
                    for each, d in ((self.moved, "length"), (self.passed, ""))
                )
                note = f"→ {moved} mm, {passed} N"
                listed.append(
                    Row(f"force_{k}_{axis}", float(abs(self.harmonics[k, i])), "force", label, note)
                )
        return [*found, Block("harmonics", say("vibration.harmonics"), listed)]

    def listed(self) -> list[int]:
        """Harmonics that matter, k from 1."""
        size = np.abs(self.harmonics[1:]).max(axis=1)
        return [k + 1 for k in range(len(size)) if size[k] > SMALL * size.max()][:12]

    def steps(self, say: Say) -> list[Step]:
        own, each = Step("1", say("vibration.step_mounts")), Step("2", say("vibration.harmonics"))
        put(own, "ω", "2π/T", self.speed, "angular_velocity")
        for i, axis in enumerate("xy"):
            put(own, f"ω{axis}", f"√(K{axis}/m)", float(self.frequencies[i]), "angular_velocity")
        for i, axis in enumerate("xy"):
            speeds = ", ".join(
                number(60 * float(self.frequencies[i]) / (2 * math.pi) / k, digits=4)
                for k in self.listed()[:4]
            )
            own.say(say("vibration.critical", axis=axis, speeds=speeds))
        each.say("  X_k = F_k/(K − m·(kω)² + i·kω·c),  G_k = (K + i·kω·c)·X_k")
        for k in self.listed():
            for i, axis in enumerate("xy"):
                put(each, f"F{k}{axis}", "", float(abs(self.harmonics[k, i])), "force")
                put(each, f"X{k}{axis}", "", float(abs(self.moved[k, i])), "length")
                put(each, f"G{k}{axis}", "", float(abs(self.passed[k, i])), "force")
        return [own, each]
