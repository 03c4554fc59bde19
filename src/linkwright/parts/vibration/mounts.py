"""A machine on elastic mounts, shaken by the inertia forces of its mechanism."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

import numpy as np

from linkwright.core.arguments import STEPS
from linkwright.core.arrays import Complexes, Floats
from linkwright.core.quantity import number, shown
from linkwright.core.table import Block, Row
from linkwright.equations.steps import Step
from linkwright.errors import Finding, LinkwrightError, ModelError, fault
from linkwright.fields.base import Quantities, Quantity, file_key
from linkwright.fields.tables import Integer, Named, Table
from linkwright.kinetostatics.forces import Forces
from linkwright.kinetostatics.run import solve_forces
from linkwright.mechanism.mechanism import Mechanism
from linkwright.parts.base import Result
from linkwright.parts.fields import MECHANISM, OfMechanism
from linkwright.parts.vibration.linear import largest_between
from linkwright.words import Translate, _, pgettext

#: Columns and dimensions of shaking force, motion and force on the ground, by axis.
TITLES = {
    axis: (
        (f"shaking force {axis} [N]", "force"),
        (f"machine {axis} [m]", "length"),
        (f"force on ground {axis} [N]", "force"),
    )
    for axis in "xy"
} | {
    "turn": (
        ("shaking moment [N·m]", "torque"),
        ("machine turn [rad]", "angle"),
        ("moment on ground [N·m]", "torque"),
    )
}
#: Harmonics below this share of the largest are not listed.
SMALL = 1e-3
#: Ways of a machine, and what is largest over the cycle: along an axis, and of its turning.
WAYS = {"x": pgettext("vibration", "x"), "y": pgettext("vibration", "y"), "turn": _("turning")}
LARGEST = {
    "shaking": (_("shaking force along {axis}"), _("shaking moment about the mass centre")),
    "machine": (_("motion of the machine along {axis}"), _("turning of the machine")),
    "ground": (_("force on the ground along {axis}"), _("moment on the ground about the mass centre")),
}


@dataclass(frozen=True)
class Mount:
    """A mount ``at`` a place of the frame, m, with its stiffnesses, N/m."""

    at: tuple[float, float] = file_key(Quantities("length", ("x", "y"), doc="where it is", form="[0 m, 0 m]"))
    stiffness_x: float = file_key(Quantity("stiffness", above=0.0, doc="stiffness along x"))
    stiffness_y: float = file_key(Quantity("stiffness", above=0.0, doc="stiffness along y"))


@dataclass(frozen=True)
class Mounts(OfMechanism):
    """A machine of ``mass`` (kg, frame and moving links) on mounts.

    Either it does not rock, and its mounts have together ``stiffness_x`` and ``stiffness_y`` (N/m); or ``mounts``
    says where each of them is, and the machine turns about its ``mass_centre`` with ``inertia`` (kg·m²).
    ``damping_ratio`` ζ of every mode. x and y are those of the mechanism's frame.
    """

    kind: ClassVar[str] = "mounts"
    mechanism: Mechanism = file_key(MECHANISM)
    mass: float = file_key(Quantity("mass", above=0.0, doc="mass of the complete machine"))
    stiffness_x: float | None = file_key(
        Quantity("stiffness", above=0.0, doc="of all mounts along x, where the machine does not rock"), None
    )
    stiffness_y: float | None = file_key(
        Quantity("stiffness", above=0.0, doc="of all mounts along y, where the machine does not rock"), None
    )
    damping_ratio: float = file_key(Quantity("dimensionless", minimum=0.0, doc="damping ratio ζ; default: 0"), 0.0)
    steps: int = file_key(Integer(8, doc="positions over the cycle; default: 360"), STEPS)
    mounts: Mapping[str, Mount] = file_key(
        Named(
            Table.of(Mount),
            _("mount"),
            doc="every mount by name: {at: [0 m, 0 m], stiffness_x: 1 MN/m, stiffness_y: 2 MN/m}",
        ),
        dict,
    )
    inertia: float | None = file_key(
        Quantity("inertia", above=0.0, doc="of the complete machine about its mass centre"), None
    )
    mass_centre: tuple[float, float] | None = file_key(
        Quantities(
            "length", ("x", "y"), doc="of the complete machine, in the axes of the frame", form="[0.4 m, 0.3 m]"
        ),
        None,
    )
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
            return [
                fault(
                    "not_passed",
                    "mechanism",
                    _("the mechanism does not pass its cycle: {why}"),
                    _("mend the model first (linkwright check)"),
                    why=error.sentence,
                )
            ]
        gaps = np.diff(time)
        even = len(gaps) and np.ptp(gaps) < 1e-9 * abs(gaps[0]) and self.forces.motion.positions.closed
        found = (
            []
            if even
            else [
                fault(
                    "uneven",
                    "mechanism",
                    _("the cycle is not closed or not even in time"),
                    _("drive the mechanism at constant speed over full turns"),
                )
            ]
        )
        moving = sum(link.mass for link in self.mechanism.links.values())
        if not moving:
            found.append(
                fault(
                    "nothing_shakes",
                    "mechanism",
                    _("no moving link of the mechanism has a mass, so nothing shakes the machine"),
                    _("give the links of the mechanism their masses"),
                )
            )
        if self.mass < moving:
            found.append(
                fault(
                    "too_light",
                    "mass",
                    _("the machine is lighter than its moving links ({moving} kg)"),
                    _("give the mass of the complete machine"),
                    moving=moving,
                )
            )
        together = self.stiffness_x is not None and self.stiffness_y is not None
        if together == bool(self.mounts):
            found.append(
                fault(
                    "one_way",
                    "mounts" if self.mounts else "stiffness_x",
                    _("the mounts are given either together or one by one"),
                    _("give stiffness_x and stiffness_y, or mounts with their places"),
                )
            )
        elif self.mounts and (self.inertia is None or self.mass_centre is None):
            found.append(
                fault(
                    "rocking",
                    "mounts",
                    _("a machine that rocks needs its inertia and mass centre"),
                    _("give inertia: 900 kg·m² and mass_centre: [0.4 m, 0.3 m]"),
                )
            )
        elif self.mounts and np.linalg.eigvalsh(self.stiffness)[0] <= 1e-12 * self.stiffness[2, 2]:
            found.append(
                fault(
                    "tips",
                    "mounts",
                    _("the machine can turn freely on these mounts"),
                    _("give mounts at two places at least"),
                )
            )
        return found

    @cached_property
    def inertias(self) -> Floats:
        """Mass, mass and, of a machine that rocks, inertia about the mass centre."""
        return np.array([self.mass, self.mass, *([self.inertia] if self.mounts else [])], dtype=float)

    @cached_property
    def stiffness(self) -> Floats:
        """Stiffness of the mounts against x, y and turning of the mass centre, (2, 2) or (3, 3)."""
        if not self.mounts:
            return np.diag(np.array([self.stiffness_x, self.stiffness_y], dtype=float))
        total = np.zeros((3, 3))
        for each in self.mounts.values():
            x, y = np.subtract(each.at, self.mass_centre or (0.0, 0.0))
            moved = np.array([[1.0, 0.0, -y], [0.0, 1.0, x]])
            total += moved.T @ np.diag([each.stiffness_x, each.stiffness_y]) @ moved
        return total

    def solve(self) -> Shaken:
        """The machine's vibration. Raises ModelError with all findings, also for a resonance without damping."""
        self.require()
        shaken = Shaken(self)
        if not self.damping_ratio:
            for own, shape in zip(shaken.frequencies, shaken.modes.T, strict=True):
                order = own / shaken.speed
                near = abs(order - round(order)) < 1e-9 and 0 < round(order) < len(shaken.harmonics)
                if near and abs(shaken.harmonics[round(order)] @ shape) > 0:
                    raise ModelError(
                        [
                            fault(
                                "resonance",
                                "mass",
                                _(
                                    "resonance: the excitation has the natural frequency {hertz} Hz, and nothing "
                                    "damps it; the amplitude grows without end"
                                ),
                                _("change the frequency or a stiffness, or give damping"),
                                hertz=own / (2 * math.pi),
                            )
                        ]
                    )
        return shaken


@dataclass(frozen=True, repr=False)
class Shaken(Result):
    """Steady vibration of a machine on its mounts under the mechanism's shaking force, harmonic by harmonic.

    X_k = (K − M (kω)² + i kω C)⁻¹ F_k for x, y and, of a machine that rocks, its turn about the mass centre; the
    ground gets (K + i kω C) X_k. ``harmonics`` F_k of Σ Re F_k e^(ikωt); ``moved``, ``passed`` in the same way.
    """

    problem: Mounts

    @property
    def period(self) -> float:
        """Time of a cycle, s."""
        time = self.problem.forces.motion.time
        return float((time[1] - time[0]) * len(time))

    @property
    def speed(self) -> float:
        """Basic angular frequency of the cycle, rad/s."""
        return 2 * math.pi / self.period

    @cached_property
    def _own(self) -> tuple[Floats, Floats]:
        """Natural frequencies, rad/s, and modes as columns with φᵀ M φ = 1; along x and y where nothing rocks."""
        root = np.sqrt(self.problem.inertias)
        if not self.problem.mounts:
            return np.sqrt(np.diag(self.problem.stiffness)) / root, np.diag(1.0 / root)
        values, vectors = np.linalg.eigh(self.problem.stiffness / np.outer(root, root))
        return np.sqrt(values), vectors / root[:, None]

    @property
    def frequencies(self) -> Floats:
        """Natural frequencies, rad/s: along x and y, or of the three modes of a machine that rocks."""
        return self._own[0]

    @property
    def modes(self) -> Floats:
        """Their modes as columns, x, y and turn."""
        return self._own[1]

    @property
    def axes(self) -> tuple[str, ...]:
        """What moves: x, y and, of a machine that rocks, turn."""
        return ("x", "y", "turn")[: len(self.problem.inertias)]

    @cached_property
    def shaking(self) -> Floats:
        """Shaking force (N) and, of a machine that rocks, its moment about the mass centre (N·m), (n, 2 or 3)."""
        force = self.problem.forces.shaking_force
        if not self.problem.mounts or self.problem.mass_centre is None:
            return force
        x, y = self.problem.mass_centre
        moment = self.problem.forces.shaking_moment - (x * force[:, 1] - y * force[:, 0])
        return np.column_stack([force, moment])

    @cached_property
    def harmonics(self) -> Complexes:
        """Amplitudes F_k of :attr:`shaking`, (h, 2) or (h, 3), k = 0 the mean."""
        force = self.shaking
        found = np.fft.rfft(force, axis=0) * 2 / len(force)
        found[0] /= 2
        return np.asarray(np.where(np.abs(found) < 1e-12 * np.abs(found).max(axis=0), 0.0, found))

    @property
    def orders(self) -> Floats:
        """Angular frequencies of the harmonics, (h,) rad/s."""
        return np.asarray(np.arange(len(self.harmonics)) * self.speed, dtype=float)

    @cached_property
    def _damping(self) -> Floats:
        """Damping matrix with the ratio ζ in every mode: M φ 2ζω φᵀ M."""
        turned = self.problem.inertias[:, None] * self.modes
        return np.asarray(turned * (2 * self.problem.damping_ratio * self.frequencies) @ turned.T)

    @cached_property
    def moved(self) -> Complexes:
        """Amplitudes of the motion of the machine's mass centre, m, and of its turning, rad, as ``harmonics``."""
        w = self.orders[:, None, None]
        dynamic_stiffness = self.problem.stiffness - np.diag(self.problem.inertias) * w**2 + 1j * w * self._damping
        return np.asarray(np.linalg.solve(dynamic_stiffness, self.harmonics[:, :, None])[:, :, 0])

    @property
    def passed(self) -> Complexes:
        """Amplitudes of the force on the ground, N, and of its moment about the mass centre, N·m."""
        held = self.problem.stiffness + 1j * self.orders[:, None, None] * self._damping
        return np.asarray((held @ self.moved[:, :, None])[:, :, 0])

    def _curve(self, amplitudes: Complexes) -> Floats:
        n = len(self.problem.forces.motion.time)
        spectrum = amplitudes * n / 2
        spectrum[0] *= 2
        return np.asarray(np.fft.irfft(spectrum, n, axis=0))

    def _largest(self, amplitudes: Complexes) -> float:
        """Largest size over the cycle of Σ Re A_k e^(ikωt), between its places as well; amplitudes (h,)."""
        n = 16 * len(self.problem.forces.motion.time)
        spectrum = amplitudes * n / 2
        spectrum[0] *= 2
        turn = np.linspace(0.0, 2 * math.pi, n + 1)
        value, rate = (np.fft.irfft(each, n) for each in (spectrum, 1j * np.arange(len(spectrum)) * spectrum))
        return abs(largest_between(turn, np.append(value, value[0]), np.append(rate, rate[0]))[1])

    def columns(self) -> dict[str, Floats]:
        """Over the cycle: shaking force, motion of the machine, force on the ground, by axis."""
        found = {"time [s]": self.problem.forces.motion.time}
        curves = (self.shaking, self._curve(self.moved), self._curve(self.passed))
        for i, axis in enumerate(self.axes):
            found |= {title: each[:, i] for (title, _unused), each in zip(TITLES[axis], curves, strict=True)}
        return found

    def _own_rows(self, translate: Translate) -> list[Row]:
        """Natural frequencies; of a machine that rocks with what moves most, over the radius of gyration."""
        hertz = self.frequencies / (2 * math.pi)
        if not self.problem.mounts:
            return [
                Row(f"own_{axis}", hertz[i], "frequency", _("natural frequency along {axis}", axis=axis))
                for i, axis in enumerate(self.axes)
            ]
        sizes = np.abs(self.modes) * np.sqrt(self.problem.inertias)[:, None]
        most = [self.axes[int(k)] for k in sizes.argmax(axis=0)]
        return [
            Row(
                f"own_{k}",
                hertz[k],
                "frequency",
                _("natural frequency, mode {mode} (mostly {axis})", mode=k + 1, axis=WAYS[most[k]]),
            )
            for k in range(len(hertz))
        ]

    def blocks(self, translate: Translate) -> list[Block]:
        rows = self._own_rows(translate)
        curves = {"shaking": self.harmonics, "machine": self.moved, "ground": self.passed}
        for i, axis in enumerate(self.axes):
            for (key, amplitudes), (_unused, dimension) in zip(curves.items(), TITLES[axis], strict=True):
                largest = self._largest(amplitudes[:, i])
                straight, turning = LARGEST[key]
                label = turning if axis == "turn" else straight.format(axis=axis)
                rows.append(Row(f"{key}_{axis}", largest, dimension, label))
        found = [Block("mounts", _("Largest values over the cycle"), rows)]
        listed = []
        for k in self.listed():
            for i, axis in enumerate(self.axes):
                (_unused2, kind), (_unused3, way), _unused4 = TITLES[axis]
                hertz = number(float(self.orders[k]) / (2 * math.pi))
                label = _("k = {order} ({hertz} Hz) {axis}", order=k, axis=WAYS[axis], hertz=hertz)
                note = f"→ {shown(float(abs(self.moved[k, i])), way)}, {shown(float(abs(self.passed[k, i])), kind)}"
                listed.append(Row(f"force_{k}_{axis}", float(abs(self.harmonics[k, i])), kind, label, note))
        return [*found, Block("harmonics", _("Harmonics: shaking force → motion, force on the ground"), listed)]

    def listed(self) -> list[int]:
        """Harmonics that matter, k from 1."""
        size = np.abs(self.harmonics[1:, :2]).max(axis=1)
        return [k + 1 for k in range(len(size)) if size[k] > SMALL * size.max()][:12]

    def steps(self, translate: Translate) -> list[Step]:
        own, each = (
            Step("1", translate(_("Natural frequencies and speeds to avoid"))),
            Step("2", translate(_("Harmonics: shaking force → motion, force on the ground"))),
        )
        own.put("ω", "2·π/T", self.speed, "angular_velocity", of={"T": (2 * math.pi / self.speed, "time")})
        if self.problem.mounts:
            own.law("det(K − ω²·M) = 0")
        ways = ["1", "2", "3"] if self.problem.mounts else list(self.axes)
        for i, way in enumerate(ways):
            stiffness = float(np.diag(self.problem.stiffness)[i])
            of = {f"k{way}": (stiffness, "stiffness"), "m": (self.problem.mass, "mass")}
            formula = "" if self.problem.mounts else f"√(k{way}/m)"
            own.put(f"ω{way}", formula, float(self.frequencies[i]), "angular_velocity", of=of)
        for i, way in enumerate(ways):
            speeds = ", ".join(
                number(60 * float(self.frequencies[i]) / (2 * math.pi) / k, digits=4) for k in self.listed()[:4]
            )
            own.note(
                translate(
                    _(
                        "speeds at which a harmonic meets the natural frequency along {axis}: {speeds} "
                        "cycles per minute",
                        axis=way,
                        speeds=speeds,
                    )
                )
            )
        each.law("X_k = (K − k²·ω²·M + i·k·ω·C)⁻¹·F_k; G_k = (K + i·k·ω·C)·X_k")
        for k in self.listed():
            for i, axis in enumerate(self.axes):
                (_unused, kind), (_unused2, way), _unused3 = TITLES[axis]
                mark = "θ" if axis == "turn" else axis
                each.put(f"F{k}{mark}", "", float(abs(self.harmonics[k, i])), kind)
                each.put(f"X{k}{mark}", "", float(abs(self.moved[k, i])), way)
                each.put(f"G{k}{mark}", "", float(abs(self.passed[k, i])), kind)
        return [own, each]
