"""The result of an equilibrium analysis: positions at rest, how stable each one is, how it vibrates and gives way."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.attached import attached
from linkwright.core.table import Table, Tabular
from linkwright.dynamics.displacement import Displacement, displaced, flexibility
from linkwright.dynamics.static_forces import StaticForces
from linkwright.dynamics.vibration import SmallVibrations, Stability
from linkwright.kinematics.input_range import InputRange
from linkwright.mechanism.mechanism import Mechanism
from linkwright.units import si_unit
from linkwright.words import Message


@dataclass(frozen=True)
class Equilibrium:
    """A position in which a machine stays at rest by itself.

    ``inputs``: coordinates of all drivers, rad or m. ``stability``: ``stable``, ``unstable``, ``neutral`` (in a part
    of the range, or in some direction), ``one_sided`` (it comes back from one side and goes away on the other),
    ``held`` by friction or other resistance, ``stopped``: what acts pushes it against the ``stop``, with ``contact``
    N (of an angle N·m).
    ``beyond``: beyond a dead point of the input, in another assembly mode than in the drawing.
    ``low``, ``high``: the part of the range in which it rests, where that is no single position (one free input);
    None else. ``jump``: a load begins or ends to act there.
    ``stiffness`` dS/dq, ``inertia`` and ``damping`` (freedoms, freedoms) along the free inputs (N·m/rad, kg·m²,
    N·m·s/rad, or their mates of inputs that slide); ``shares``: what every load contributes along them, N·m or N.
    ``barriers``: work (J) that takes the machine from here over the next unstable position on the side of smaller and
    of larger coordinates; None where there is none, or several inputs are free.
    """

    inputs: Mapping[str, float]
    stability: Stability
    stiffness: Floats = field(repr=False, compare=False)
    inertia: Floats = field(repr=False, compare=False)
    damping: Floats = field(repr=False, compare=False)
    vibrations: SmallVibrations | None = field(repr=False, compare=False)
    shares: Mapping[str, Floats] = field(repr=False, compare=False)
    forces: StaticForces = field(repr=False, compare=False)
    reach: tuple[float, float] | None = field(default=None, repr=False, compare=False)
    low: float | None = None
    high: float | None = None
    jump: bool = False
    beyond: bool = False
    stop: str = ""
    contact: float = 0.0
    barriers: tuple[float | None, float | None] = (None, None)

    @property
    def place(self) -> Floats:
        """Coordinates of the free inputs, (freedoms,) rad or m."""
        return np.array([self.inputs[name] for name in self.forces.free])

    @property
    def frequencies(self) -> Floats:
        """Natural frequencies of small vibrations without damping, (modes,) Hz; NaN of modes that move away, empty
        where some motion has no inertia, and at a stop."""
        return np.empty(0) if self.vibrations is None or self.stop else self.vibrations.frequencies

    @property
    def damping_ratios(self) -> Floats:
        """Damping ratios of the modes, (modes,); 1 and more: it creeps back without vibrating."""
        return np.empty(0) if self.vibrations is None or self.stop else self.vibrations.damping_ratios

    def point(self, name: str) -> Floats:
        """Place (2,) of a point in this position, m; raises LinkwrightError for an unknown one."""
        return self.forces.point(name, self.place[:, None])[0][:, 0]

    def flexibility(self, point: str) -> Floats:
        """Displacement (2, 2), m/N, of a point by a small force on it: column x by a force along x.

        Raises LinkwrightError for an unknown point, and where the position is not stable.
        """
        return flexibility(self.forces, self.place, self.stiffness, point, self.stability)

    def displaced(self, point: str, force: tuple[float, float]) -> Displacement:
        """Where the machine comes to rest under a further force (N, frame axes) on a point, that grows slowly.

        Raises as :meth:`flexibility`.
        """
        return displaced(self.forces, self.place, self.stiffness, point, force, self.stability, self.reach)


@dataclass(frozen=True)
class Holding:
    """The largest effort that holds the machine over the range, N·m or N, with its sign, and where, rad or m."""

    effort: float
    at: float


@dataclass(frozen=True)
class Equilibria(Tabular, Sequence[Equilibrium]):
    """All positions at rest of a machine, by coordinate.

    ``ranges``: what was searched, rad or m, by free input; ``closed``: the range of the one free input is full turns,
    whose ends are the same position; ``reach``: what ends it, where something does. ``holding``: the
    largest effort that keeps the machine where it is over the range, ``least`` the smallest, of one free input.
    ``starts``: from so many starts positions were sought where several inputs are free; else 0: all were found.
    ``moved``: displacements under the forces that :meth:`pushed` was asked for, with the number of the position.
    """

    forces: StaticForces = field(repr=False)
    positions: tuple[Equilibrium, ...]
    ranges: Mapping[str, tuple[float, float]]
    closed: bool = False
    reach: InputRange | None = field(default=None, repr=False)
    holding: Holding | None = None
    least: Holding | None = None
    work_of_turn: float | None = None
    starts: int = 0
    moved: tuple[tuple[int, Displacement], ...] = field(default=(), repr=False, compare=False)

    @property
    def mechanism(self) -> Mechanism:
        """What was analysed."""
        return self.forces.equation.source

    def __len__(self) -> int:
        return len(self.positions)

    def __getitem__(self, index: Any) -> Any:
        return self.positions[index]

    @property
    def stable(self) -> tuple[Equilibrium, ...]:
        """The stable ones."""
        return tuple(each for each in self.positions if each.stability == "stable")

    @property
    def neutral(self) -> bool:
        """Whether the machine is at rest in every position of the range, to rounding of the forces."""
        if len(self.positions) != 1 or self.positions[0].low is None or self.positions[0].stability != "neutral":
            return False
        ((low, high),) = self.ranges.values()
        return self.positions[0].low <= low and (self.positions[0].high or 0.0) >= high

    def pushed(self, forces: Sequence[tuple[str, tuple[float, float]]]) -> Equilibria:
        """The same with the displacement of every stable position under each force on a point: ``[("B", (10, 0))]``.

        Raises LinkwrightError for an unknown point.
        """
        numbered = [(number, each) for number, each in enumerate(self.positions) if each.stability == "stable"]
        found = [(number, each.displaced(point, force)) for point, force in forces for number, each in numbered]
        return replace(self, moved=tuple(found))

    def dimension_of(self, name: str) -> str:
        """``angle`` or ``length``: of an input."""
        return "angle" if self.forces.equation.rotary[name] else "length"

    def data(self) -> dict[str, Any]:
        """Everything as plain data, SI."""
        names = self.forces.free
        units = {name: si_unit(self.dimension_of(name)) for name in self.forces.equation.names}
        found: dict[str, Any] = {
            "name": self.mechanism.name,
            "inputs": units,
            "ranges": {name: list(each) for name, each in self.ranges.items()},
            "positions": [_data(each, names) for each in self.positions],
            "neutral": self.neutral,
            "starts": self.starts or None,
            "displacements": [
                {
                    "position": number,
                    "point": each.point,
                    "force": each.force.tolist(),
                    "linear": each.linear.tolist(),
                    "exact": each.exact.tolist(),
                    "inputs": dict(zip(names, map(float, each.inputs), strict=True)),
                    "carried": each.carried,
                }
                for number, each in self.moved
            ],
        }
        for key, each in (("largest_holding", self.holding), ("smallest_holding", self.least)):
            found[key] = None if each is None else {"effort": each.effort, "at": each.at}
        return {**found, "remarks": [each.translate("en") for each in self.remarks]}

    def columns(self) -> dict[str, Any]:
        """The positions as columns, SI."""
        found: dict[str, Any] = {}
        for name in self.forces.equation.names:
            found[f"{name} [{si_unit(self.dimension_of(name))}]"] = np.array(
                [each.inputs[name] for each in self.positions]
            )
        found["stability"] = [each.stability for each in self.positions]
        for mode in range(len(self.forces.free)):
            number = "" if len(self.forces.free) == 1 else f"_{mode + 1}"
            found[f"frequency{number} [Hz]"] = np.array([_at(each.frequencies, mode) for each in self])
            found[f"damping_ratio{number}"] = np.array([_at(each.damping_ratios, mode) for each in self])
        return found

    @property
    @attached
    def remarks(self) -> list[Message]:
        """Sentences about the result: what was searched, that nothing is at rest, what friction does."""
        raise NotImplementedError

    @attached
    def tables(self, language: str = "en", *, worked: bool = False) -> Sequence[Table]:
        """The positions in a table with the remarks; ``worked``: with the sums of every position."""
        raise NotImplementedError


def _at(values: Floats, mode: int) -> float:
    return float(values[mode]) if mode < len(values) else float("nan")


def _numbers(values: Floats) -> list[float | None]:
    return [None if np.isnan(each) else float(each) for each in values]


def _data(each: Equilibrium, names: Sequence[str]) -> dict[str, Any]:
    found: dict[str, Any] = {
        "inputs": dict(each.inputs),
        "stability": each.stability,
        "from": each.low,
        "to": each.high,
        "jump": each.jump,
        "beyond_dead_point": each.beyond,
        "stop": each.stop or None,
        "contact": each.contact if each.stop else None,
        "frequencies": _numbers(each.frequencies),
        "damping_ratios": _numbers(each.damping_ratios),
        "barriers": list(each.barriers),
        "stiffness": each.stiffness.tolist(),
        "inertia": each.inertia.tolist(),
        "damping": each.damping.tolist(),
    }
    found["loads"] = {load: dict(zip(names, map(float, row), strict=True)) for load, row in each.shares.items()}
    return found
