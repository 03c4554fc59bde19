"""One description of a machine in motion: its coordinates, and what its programs take besides."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.inputs import mode_inputs
from linkwright.drivers.base import Driver
from linkwright.dynamics.equation import EquationOfMotion
from linkwright.dynamics.site import coordinate_of, near_name
from linkwright.formula.linear_algebra import ZERO
from linkwright.formula.numpy_backend import NumpyProgram
from linkwright.formula.program import Program
from linkwright.formula.trace import Scalar, angle
from linkwright.kinematics.positions import Positions
from linkwright.kinematics.trace import MotionOutputs

#: Newton's steps of groups without closed form at a position, and the change that ends them.
CLOSING_STEPS, CLOSED = 24, 1e-13


@dataclass(frozen=True)
class Place:
    """A position with its rates, whichever coordinates it was found in.

    ``links``: of each the place of its origin (m) and its direction; ``angles`` (rad) with turns where these are
    known, else nearest to zero; ``slides`` (m) of guides.
    """

    links: Mapping[str, tuple[float, float, float, float]]
    angles: Mapping[str, float]
    slides: Mapping[str, float]


@dataclass
class Description:
    """An equation of motion with what its programs take besides coordinates, rates, time and switches.

    ``modes``: signs of the assembly modes by group; ``states``: where Newton's steps of groups without closed form
    begin; ``near``: angles of the model's drivers near which they are found where they are no coordinates.
    """

    equation: EquationOfMotion
    modes: dict[str, float]
    states: dict[str, float]
    near: dict[str, float] = field(default_factory=dict)
    _programs: dict[tuple[str, ...], NumpyProgram] = field(default_factory=dict, repr=False)

    @classmethod
    def of(cls, equation: EquationOfMotion) -> Description:
        """The machine as it is drawn, or as the words of its file say."""
        signs = equation.solver.assembly.modes
        return cls(equation, {name: signs[name] for name in equation.modes}, dict(equation.states))

    @property
    def names(self) -> list[str]:
        """The drivers whose coordinates it is described in."""
        return self.equation.names

    @property
    def held(self) -> dict[str, float]:
        """Inputs of the programs that stay between events, by name."""
        near = {near_name(name): each for name, each in self.near.items()}
        return {**mode_inputs(self.modes), **self.states, **near}

    # values of the motion at a position -----------------------------------------------------------------
    def motion(
        self, outputs: Mapping[str, Scalar], q: Floats, w: Floats, other: Mapping[str, Floats] | None = None
    ) -> dict[str, Floats]:
        """Traced values of the motion, (n,) each, at coordinates and rates (drivers, n); ``other`` held inputs."""
        key, equation, count = tuple(outputs), self.equation, q.shape[1]
        if key not in self._programs:
            self._programs[key] = NumpyProgram(Program.of(equation.solver.motion.trace, outputs))
        program = self._programs[key]
        given: dict[str, Floats] = {name: np.full(count, each) for name, each in self.held.items()}
        courses = {name: (at, rate, 0.0 * rate) for name, at, rate in zip(self.names, q, w, strict=True)}
        given |= {**(other or {}), **Positions(np.zeros(count), courses, equation.rotary).arrays}
        numbers = [equation.numbers[name] for name in program.program.parameters]
        arrays = {name: given[name] for name in program.program.positions}
        fields = {name: given[name] for name in program.program.fields}
        found = np.asarray(program.run(numbers, arrays, fields, length=count))
        return dict(zip(outputs, found, strict=True))

    def _motion(
        self, outputs: Mapping[str, Scalar], q: Floats, w: Floats, other: Mapping[str, Floats] | None = None
    ) -> dict[str, float]:
        """The same at one position, (drivers,)."""
        return {name: float(row[0]) for name, row in self.motion(outputs, q[:, None], w[:, None], other).items()}

    @cached_property
    def _placed(self) -> dict[str, Scalar]:
        """Outputs that make a :class:`Place`, and chain coordinates that Newton's steps find."""
        motion = self.equation.solver.motion
        out: dict[str, Scalar] = {}
        outputs = MotionOutputs(motion)
        for link in motion.mechanism.links:
            place, e = motion.poses[link].point(ZERO), motion.poses[link].direction
            turned = motion.angles(link) if motion.angles.counts(link) else angle(e.y, e.x)
            out |= {
                f"{k}:{link}": v
                for k, v in zip(("x", "y", "c", "s", "angle"), (place.x, place.y, e.x, e.y, turned), strict=True)
            }
        out |= {f"slid:{name}": outputs.slide(name)[0] for name in motion.mechanism.guides}
        return out | {f"next:{name}": value for name, value in motion.next_states.items()}

    def place(self, q: Floats, w: Floats) -> Place:
        """Where all links are. Groups without closed form are closed by Newton's steps from their states."""
        found: dict[str, float] = {}
        for _step in range(CLOSING_STEPS if self.states else 1):
            found = self._motion(self._placed, q, w)
            ahead = {name: found[f"next:{name}"] for name in self.states}
            change = max((abs(ahead[name] - each) for name, each in self.states.items()), default=0.0)
            if not change > CLOSED:
                break
            self.states = ahead
        links = self.equation.mechanism.links
        return Place(
            {link: tuple(found[f"{k}:{link}"] for k in "xycs") for link in links},  # type: ignore[misc]
            {"frame": 0.0, **{link: found[f"angle:{link}"] for link in links}},
            {name: found[f"slid:{name}"] for name in self.equation.mechanism.guides},
        )

    def coordinates(self, drivers: Mapping[str, Driver], q: Floats, w: Floats) -> tuple[Floats, Floats]:
        """Coordinates and rates of joints at such a position; angles that ``near`` does not hold nearest to zero."""
        motion = self.equation.solver.motion
        out: dict[str, Scalar] = {}
        for name, driver in drivers.items():
            out[f"q:{name}"], out[f"qd:{name}"] = coordinate_of(motion, driver)
        found = self._motion(out, q, w, {near_name(name): np.zeros(1) for name in drivers if name not in self.near})
        return np.array([found[f"q:{name}"] for name in drivers]), np.array([found[f"qd:{name}"] for name in drivers])

    def qualities(self, q: Floats) -> Floats:
        """How far its groups are from singular, (groups,); 0 where one is."""
        names = [f"closure:{group}" for group in self.equation.groups]
        given = {**self.held, **{f"q:{name}": each for name, each in zip(self.names, q, strict=True)}}
        return self.equation.evaluate(names, given, 1)[:, 0] if names else np.ones(1)

    def quality(self, q: Floats) -> float:
        """The smallest of these."""
        return float(np.min(self.qualities(q), initial=1.0))
