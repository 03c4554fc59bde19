"""Masses joined by springs and dampers, or discs by shafts: free and forced vibration."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import Any, ClassVar

import numpy as np

from linkwright.core.arrays import Complexes, Floats
from linkwright.core.quantity import number
from linkwright.core.table import Block, Row
from linkwright.equations.matrix import named_matrix
from linkwright.equations.steps import Step
from linkwright.errors import Finding, ModelError, fault
from linkwright.fields.base import FileKeys, Quantity, Text, file_key
from linkwright.fields.tables import Named, Table
from linkwright.parts.base import Problem, Result
from linkwright.parts.fields import AnyQuantity
from linkwright.parts.vibration.components import (
    DAMPER,
    EXCITATION,
    GROUND,
    SPRING,
    START,
    STRAIGHT,
    TURNING,
    Connector,
    Excitation,
    MassesField,
    Start,
    either,
    excitation_of,
    mixed_findings,
    sampled_force,
)
from linkwright.parts.vibration.linear import Linear, largest_between, tuned
from linkwright.units import DIMENSIONS, SMALLEST
from linkwright.words import Message, Translate, _, language_of
from linkwright.words.message import in_language

#: Curves of frequency and time have so many points.
POINTS = 801
#: Times of a response in a period of the fastest mode, and how many at most.
PER_PERIOD, MOST = 64, 40_000
#: A mode without damping this near to the excitation is in resonance, relative.
RESONANCE = 1e-9
#: What the numbers are called.
LABELS: Mapping[str, Message] = {
    "transmissibility": _("transmissibility"),
    "absorber_stiffness": _("stiffness of its spring"),
    "absorber_damping": _("damping of its damper"),
}


@dataclass(frozen=True)
class VibratingSystem(Problem):
    """Masses (kg; or discs with inertias, kg·m², ``turning``) by name, springs and dampers between them.

    ``excitation``; ``start`` of masses for the free response; ``duration`` (s) of responses in time.
    """

    kind: ClassVar[str] = "vibration"
    fields = FileKeys(
        {
            "absorber": Table(
                {
                    "on": Text(required=True, doc="the mass that is to be quieted"),
                    "mass": Quantity("mass", required=True, above=0.0, doc="mass of the absorber"),
                },
                doc="adds the best damped absorber: {on: body, mass: 5 kg}",
            ),
            "inertias": Named(
                AnyQuantity(("inertia",)),
                _("disc"),
                doc="discs on shafts, in place of masses: moments of inertia (kg·m²) by name",
            ),
        }
    )
    masses: Mapping[str, float] = file_key(
        MassesField(AnyQuantity(either("mass")), _("mass"), doc="masses (kg) by name"), dict
    )
    springs: Mapping[str, Connector] = file_key(
        Named(SPRING, _("spring"), doc="springs by name: {between: [ground, body], stiffness: 20 kN/m}"), dict
    )
    dampers: Mapping[str, Connector] = file_key(
        Named(DAMPER, _("damper"), doc="dampers by name: {between: [ground, body], damping: 300 N·s/m}"), dict
    )
    excitation: Excitation | None = file_key(
        Table(EXCITATION, doc="what shakes it: force, unbalance, base or table"), None
    )
    start: Mapping[str, Start] = file_key(
        Named(Table(START), _("mass"), doc="start of the free vibration by mass"), dict
    )
    duration: float | None = file_key(Quantity("time", above=0.0, doc="how long responses in time are shown"), None)
    turning: bool = False
    name: str = ""
    source: str = ""

    @classmethod
    def of_file(cls, values: Mapping[str, Any], folder: Path) -> VibratingSystem:
        data = dict(values)
        discs = data.pop("inertias", None) or {}
        data["masses"] = {**(data.get("masses") or {}), **discs}
        turning = any(kind == DIMENSIONS["inertia"] for _unused, kind in data["masses"].values())
        wrong = mixed_findings(data, dict.fromkeys(discs, "inertias"), turning)
        if wrong:
            raise ModelError(wrong)
        data["masses"] = {name: value for name, (value, _unused) in data["masses"].items()}
        for what in ("springs", "dampers"):
            ties = data.get(what, {})
            data[what] = {name: Connector(tie["between"], tie["rate"][0]) for name, tie in ties.items()}
        starts = data.get("start", {})
        data["start"] = {
            name: Start(**{word: value for word, (value, _unused) in each.items()}) for name, each in starts.items()
        }
        if data.get("excitation") is not None:
            data["excitation"] = excitation_of(data["excitation"])
        absorber = data.pop("absorber", None)
        system = cls(**data, turning=turning)
        if absorber is None or system.findings():
            return system
        return system.quieted(absorber["on"], absorber["mass"])

    def quieted(self, on: str, mass: float) -> VibratingSystem:
        """The system with the best damped absorber on its one mass; raises ModelError for other systems."""
        if list(self.masses) != [on] or self.dampers or self.turning:
            raise ModelError(
                [
                    fault(
                        "absorber_alone",
                        "absorber",
                        _("the best absorber is known for one mass without dampers"),
                        _("give one mass with springs to the ground, or write the absorber as a second mass"),
                    )
                ]
            )
        stiffness = sum(spring.rate for spring in self.springs.values())
        spring, damper = tuned(self.masses[on], stiffness, mass)
        between = (on, "absorber")
        return replace(
            self,
            masses={**self.masses, "absorber": mass},
            springs={**self.springs, "absorber": Connector(between, spring)},
            dampers={"absorber": Connector(between, damper)},
        )

    def findings(self) -> list[Finding]:
        found = (
            []
            if self.masses
            else [fault("no_mass", "masses", _("there is no mass"), _("write masses: {{body: 100 kg}}"))]
        )
        found += [
            fault(
                "mass_above_zero",
                f"masses.{n}",
                _("the mass is not above 1e-12 kg (kg·m²)"),
                _("give a mass above zero"),
            )
            for n, m in self.masses.items()
            if m <= SMALLEST
        ]
        for what, ties in (("springs", self.springs), ("dampers", self.dampers)):
            for name, tie in ties.items():
                found += tie.findings(f"{what}.{name}", self.masses)
        found += [
            fault(
                "no_such_mass",
                f"start.{name}",
                _('there is no mass "{name}"'),
                _("one of: {known}"),
                name=name,
                known=tuple(self.masses),
            )
            for name in self.start
            if name not in self.masses
        ]
        if found or self.excitation is None:
            return found
        return self.excitation.findings(self.masses) or self._resonance(self.excitation)

    def _resonance(self, excitation: Excitation) -> list[Finding]:
        """A finding where the excitation has an undamped natural frequency."""
        linear = self.linear
        for i, own in enumerate(linear.modes[0]):
            near = (
                excitation.frequency is not None
                and abs(own - excitation.frequency) <= RESONANCE * excitation.frequency
            )
            if near and linear.damping_ratios[i] == 0.0:
                return [
                    fault(
                        "resonance",
                        "excitation",
                        _(
                            "resonance: the excitation has the natural frequency {hertz} Hz, and nothing damps "
                            "it; the amplitude grows without end"
                        ),
                        _("change the frequency or a stiffness, or give damping"),
                        hertz=own / (2 * math.pi),
                    )
                ]
        return []

    @cached_property
    def linear(self) -> Linear:
        """The matrices, masses in their order."""
        return Linear(np.diag(list(self.masses.values())), self._matrix(self.dampers), self._matrix(self.springs))

    def _matrix(self, ties: Mapping[str, Connector]) -> Floats:
        place = {name: i for i, name in enumerate(self.masses)}
        found = np.zeros((len(place), len(place)))
        for tie in ties.values():
            ends = [place[end] for end in tie.between if end != GROUND]
            for i in ends:
                found[i, i] += tie.rate
            if len(ends) == 2:
                found[ends[0], ends[1]] -= tie.rate
                found[ends[1], ends[0]] -= tie.rate
        return found

    def to_ground(self, ties: Mapping[str, Connector]) -> Floats:
        """Rates of ties between each mass and the ground, (n,)."""
        names = list(self.masses)
        found = np.zeros(len(names))
        for tie in ties.values():
            if GROUND in tie.between:
                found[names.index(next(end for end in tie.between if end != GROUND))] += tie.rate
        return found

    def solve(self) -> Vibration:
        """Modes and responses. Raises ModelError with all findings."""
        self.require()
        return Vibration(self)


@dataclass(frozen=True, repr=False)
class Vibration(Result):
    """Natural frequencies, modes and damping; amplitudes under the excitation; responses over frequency and time."""

    labels: ClassVar[Mapping[str, Message]] = LABELS
    system: VibratingSystem

    @property
    def linear(self) -> Linear:
        """The matrices M, C, K."""
        return self.system.linear

    @property
    def frequencies(self) -> Floats:
        """Undamped natural frequencies (n,), rad/s."""
        return self.linear.modes[0]

    @property
    def damping_ratios(self) -> Floats:
        """Damping ratios of the modes, (n,)."""
        return self.linear.damping_ratios

    @property
    def shapes(self) -> Floats:
        """Modes in columns, each with its largest part 1, (n, n)."""
        raw = self.linear.modes[1]
        largest = raw[np.abs(raw).argmax(axis=0), range(len(raw))]
        shown = raw / largest
        return np.where(np.abs(shown) < 1e-12, 0.0, shown)

    def forces(self, frequency: Floats) -> Complexes:
        """Amplitudes (f, n) of the exciting forces at angular frequencies (f,)."""
        excitation = self.system.excitation
        names = list(self.system.masses)
        found = np.zeros((len(frequency), len(names)), dtype=complex)
        if excitation is None or excitation.times:
            return found
        if excitation.base is not None:
            spring, damper = (self.system.to_ground(t) for t in (self.system.springs, self.system.dampers))
            return np.asarray((spring + 1j * frequency[:, None] * damper) * excitation.base)
        strength = excitation.force if excitation.force is not None else (excitation.unbalance or 0.0) * frequency**2
        found[:, names.index(excitation.on)] = strength
        return found

    def amplitudes(self, frequency: Floats) -> Complexes:
        """Complex amplitudes (f, n) of the masses at angular frequencies (f,)."""
        return self.linear.response(frequency, self.forces(frequency))

    def transmissibility(self, frequency: Floats) -> Floats:
        """Force on the ground over exciting force; with a moving base the first mass' amplitude over the base's."""
        moved, excitation = self.amplitudes(frequency), self.system.excitation
        if excitation is not None and excitation.base is not None:
            return np.asarray(np.abs(moved[:, 0]) / excitation.base)
        spring, damper = (self.system.to_ground(t) for t in (self.system.springs, self.system.dampers))
        passed = ((spring + 1j * frequency[:, None] * damper) * moved).sum(axis=1)
        return np.asarray(np.abs(passed) / np.abs(self.forces(frequency)).sum(axis=1))

    @property
    def harmonic(self) -> bool:
        """Whether a harmonic excitation is given."""
        return self.system.excitation is not None and not self.system.excitation.times

    @property
    def in_time(self) -> bool:
        """Whether there is a response in time: from a start, or under a measured force."""
        return bool(self.system.start) or (self.system.excitation is not None and bool(self.system.excitation.times))

    def sweep(self) -> tuple[Floats, Complexes]:
        """Angular frequencies around all modes, and the complex amplitudes there; poles without damping avoided."""
        moving = self.frequencies[self.frequencies > 0]
        low, high = (moving[0] / 5, moving[-1] * 4) if len(moving) else (0.1, 10.0)
        grid = np.geomspace(low, high, POINTS)
        near = [f * (1 + d) for f in moving for d in (-1e-3, 1e-3)]
        clear = np.abs(grid[:, None] / moving - 1).min(axis=1, initial=1.0) > 1e-6
        frequency = np.unique(np.concatenate([grid[clear], near]))
        return frequency, self.amplitudes(frequency)

    def response(self) -> tuple[Floats, Floats]:
        """Times (t,) and displacements (t, n) from the start, under a measured force where one is given."""
        return self._response[:2]

    @cached_property
    def _response(self) -> tuple[Floats, Floats, Floats]:
        """Times (t,), displacements and velocities (t, n); a time at which the force jumps is listed twice."""
        system = self.system
        excitation = system.excitation
        last = excitation.times[-1] if excitation is not None and excitation.times else 0.0
        moving = self.frequencies[self.frequencies > 0]
        slow = 2 * math.pi / moving[0] if len(moving) else 1.0
        end = system.duration or max(last, 6 * slow)
        fine = min(float(moving[-1]) / (2 * math.pi) * end * PER_PERIOD, MOST) if len(moving) else 0.0
        time, measured = sampled_force(excitation, end, end / max(fine, 4.0 * POINTS))
        force = np.zeros((len(time), len(system.masses)))
        if excitation is not None and excitation.times:
            force[:, list(system.masses).index(excitation.on)] = measured
        starts = [system.start.get(name, Start()) for name in system.masses]
        first = np.array([s.displacement for s in starts]), np.array([s.velocity for s in starts])
        return time, *self.linear.in_time(time, force, *first)

    def columns(self) -> dict[str, Floats]:
        names, unit = list(self.system.masses), "rad" if self.system.turning else "m"
        if self.in_time:
            time, shown = self.response()
            return {"time [s]": time, **{f"{n} [{unit}]": shown[:, i] for i, n in enumerate(names)}}
        if not self.harmonic:
            return {}
        frequency, moved = self.sweep()
        found = {"frequency [Hz]": frequency / (2 * math.pi)}
        for i, name in enumerate(names):
            found[f"{name} amplitude [{unit}]"] = np.abs(moved[:, i])
            found[f"{name} phase [rad]"] = np.angle(moved[:, i])
        return found

    def blocks(self, translate: Translate) -> list[Block]:
        rows = []
        for i, own in enumerate(self.frequencies):
            mode = ", ".join(
                f"{n} {number(float(s), digits=5)}"
                for n, s in zip(self.system.masses, self.shapes[:, i], strict=True)
            )
            label = translate(_("f{index}", index=i + 1))
            rows.append(
                Row(f"frequency_{i + 1}", own / (2 * math.pi), "frequency", label, _("mode: {mode}", mode=mode))
            )
            rows.append(Row(f"circular_{i + 1}", float(own), "angular_velocity", f"  ω{i + 1}"))
            if self.linear.damping.any():
                rows.append(Row(f"damping_{i + 1}", float(self.damping_ratios[i]), "", f"  ζ{i + 1}"))
        loose = int((self.frequencies == 0).sum())
        remarks = (
            (
                translate(
                    _("{count} of the modes are free motions: nothing ties the system to the ground.", count=loose)
                ),
            )
            if loose
            else ()
        )
        found = [Block("modes", _("Natural frequencies and modes"), rows, remarks)]
        for name in ("absorber",):
            if name in self.system.springs and name in self.system.dampers:
                tied = [
                    Row("absorber_stiffness", self.system.springs[name].rate, "stiffness"),
                    Row("absorber_damping", self.system.dampers[name].rate, "damping"),
                ]
                found.append(Block("absorber", _("Best damped absorber (Den Hartog)"), tied))
        if self.harmonic:
            found.append(self._forced(translate))
        if self.in_time:
            found.append(self._timed(translate))
        return found

    def _forced(self, translate: Translate) -> Block:
        excitation = self.system.excitation
        assert excitation is not None and excitation.frequency is not None
        at = np.array([excitation.frequency])
        moved = self.amplitudes(at)[0]
        length = "angle" if self.system.turning else "length"
        rows = []
        for name, value in zip(self.system.masses, moved, strict=True):
            rows.append(Row(f"{name}.amplitude", float(abs(value)), length, _("amplitude of {name}", name=name)))
            rows.append(Row(f"{name}.phase", float(np.angle(value)), "angle", _("phase of {name}", name=name)))
        rows.append(Row("transmissibility", float(self.transmissibility(at)[0])))
        return Block(
            "forced", _("Forced vibration at {hertz} Hz", hertz=number(excitation.frequency / (2 * math.pi))), rows
        )

    def _timed(self, translate: Translate) -> Block:
        time, moved, rate = self._response
        length = "angle" if self.system.turning else "length"
        rows = []
        for i, name in enumerate(self.system.masses):
            place, value = largest_between(time, moved[:, i], rate[:, i])
            note = _("at t = {time} s", time=number(place))
            rows.append(Row(f"{name}.largest", value, length, _("largest displacement of {name}", name=name), note))
        return Block("response", _("Response in time"), rows)

    def steps(self, translate: Translate) -> list[Step]:
        matrices, modes = (
            Step("1", translate(_("Equations of motion M·ẍ + C·ẋ + K·x = F"))),
            Step("2", translate(_("det(K − ω²M) = 0"))),
        )
        matrices.note(translate(_("in the order {names}, SI units:", names=", ".join(self.system.masses))))
        for symbol, matrix in (("M", self.linear.mass), ("C", self.linear.damping), ("K", self.linear.stiffness)):
            if symbol != "C" or matrix.any():
                matrices.items.append(named_matrix(symbol, matrix))
        one = len(self.frequencies) == 1
        modes.note(translate(_("roots of the characteristic equation, and poles λ of the damped system")))
        modes.law("det(K − ω²·M) = 0")
        if one:
            words = TURNING if self.system.turning else STRAIGHT
            for symbol, what in (("k", "stiffness"), ("m", "mass"), ("c", "damping")):
                modes.known[symbol] = (float(getattr(self.linear, what)[0, 0]), words[what])
        for i, own in enumerate(self.frequencies):
            modes.put(f"ω{i + 1}", "√(k/m)" if one else "", float(own), "angular_velocity")
            modes.put(f"f{i + 1}", f"ω{i + 1}/(2·π)", own / (2 * math.pi), "frequency")
            if self.linear.damping.any():
                modes.put(f"ζ{i + 1}", "c/(2·√(k·m))" if one else "", float(self.damping_ratios[i]))
        if not one:
            for i in range(len(self.frequencies)):
                modes.items.append(named_matrix(f"φ{i + 1}", self.shapes[:, i : i + 1]))
        found = [matrices, modes]
        if self.harmonic:
            forced = Step("3", translate(_("Forced vibration")))
            forced.law("(K − ω²·M + i·ω·C)·X = F")
            for row in self._forced(translate).rows:
                label = in_language(row.label or _("transmissibility"), language_of(translate))
                forced.put(label, "", float(row.value), row.dimension)
            found.append(forced)
        if self.in_time:
            timed = Step(str(len(found) + 1), translate(_("Response in time")))
            timed.law("M·ẍ + C·ẋ + K·x = F(t)")
            for row in self._timed(translate).rows:
                label = in_language(row.label, language_of(translate))
                timed.put(label, "", float(row.value), row.dimension)
            found.append(timed)
        return found
