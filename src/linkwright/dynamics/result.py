"""What a run gives: its events, and the motion and forces over time."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from linkwright.core.arguments import STEPS
from linkwright.core.attached import PlotMixin, attached
from linkwright.core.data import locked
from linkwright.dynamics.equation import EquationOfMotion
from linkwright.dynamics.integration import Piece
from linkwright.dynamics.samples import Samples
from linkwright.dynamics.states import FoundForces, FoundMotion, forces_at, motion_at
from linkwright.errors import RequestError
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import Message, _, pgettext

#: What may happen in a run, in words.
KINDS: Mapping[str, Message] = {
    "impact": _("impact at stop {name}"),
    "leave": _("stop {name} is left"),
    "reversal": pgettext("run", "at rest for a moment, or reversal"),
    "sticks": _("held at rest: {name}"),
    "slips": _("gives way: {name}"),
    "switch": _("switches: {name}"),
    "rest": _("at rest"),
    "steady": _("steady: a turn is as the one before"),
    "turns": _("the turns are made"),
    "dead_point": _("near a dead point of the driver: another joint's coordinate leads on"),
    "change_point": _("at a change point, through which it goes on smoothly"),
}


@dataclass(frozen=True)
class Happening:
    """An event of a run at ``time``, s: its ``kind``, what it happens to, ``value`` (of an impact the impulse, N·s or
    N·m·s), and the free coordinates there, rad or m."""

    time: float
    kind: str
    name: str
    value: float
    coordinates: tuple[float, ...]

    def __str__(self) -> str:
        return str(KINDS[self.kind].format(name=self.name))


@dataclass(eq=False)
class Run(PlotMixin):
    """The motion of a machine under forces.

    ``events`` in the order of time; ``residual``: what the kinetic energy less the work of all forces gains or loses,
    J, at most, ``largest``: the largest of these energies, J; ``note``: why it ended before it was to.
    """

    mechanism: Mechanism
    equation: EquationOfMotion
    pieces: tuple[Piece, ...]
    events: tuple[Happening, ...]
    residual: float
    largest: float
    note: Message | None = None
    #: The times that were asked for last: motion, forces and each driver's course are often wanted at the same ones.
    _sampled: Samples | None = field(default=None, init=False, repr=False, compare=False)

    @property
    def end(self) -> float:
        """Time at which it ends, s."""
        return self.pieces[-1].end if self.pieces else 0.0

    @property
    def energy_residual(self) -> float:
        """The residual as share of the largest energy; 0 where nothing moves."""
        return self.residual / self.largest if self.largest else 0.0

    @property
    def coordinates(self) -> tuple[str, ...]:
        """Names of the drivers whose coordinates were free."""
        return tuple(self.equation.free)

    @cached_property
    def end_state(self) -> dict[str, tuple[float, float]]:
        """Coordinate (rad or m) and rate of every driver at the end."""
        course = self.samples([self.end]).course
        return {name: (float(q[0]), float(w[0])) for name, (q, w, _second) in course.items()}

    def samples(self, times: ArrayLike) -> Samples:
        """The run at times from 0 to its end, s, that do not decrease."""
        time = np.atleast_1d(np.asarray(times, dtype=float))
        if len(time) and (time[0] < 0.0 or time[-1] > self.end * (1.0 + 1e-12) or (np.diff(time) < 0.0).any()):
            raise RequestError(
                _("times of a run go from 0 to {end:.6g} s and do not decrease", code="dynamics.times", end=self.end)
            )
        within = locked(np.minimum(time, self.end))
        if self._sampled is None or not np.array_equal(self._sampled.time, within):
            self._sampled = Samples.of(self.equation, self.pieces, within)
        return self._sampled

    def motion(self, steps: int = STEPS, times: ArrayLike | None = None) -> FoundMotion:
        """The motion at equal steps of the time, or at ``times``, s."""
        return motion_at(self.samples(np.linspace(0.0, self.end, steps + 1) if times is None else times))

    def joint_forces(self, steps: int = STEPS, times: ArrayLike | None = None) -> FoundForces:
        """The forces at the same times."""
        return forces_at(self.motion(steps, times))

    @attached
    def as_driven(self) -> Mechanism:
        """The mechanism whose drivers move as in the run and supply what its actuators did, for all that shows a
        prescribed motion: living pages, reports, sheets."""
        raise NotImplementedError

    def __repr__(self) -> str:
        return f"Run({self.mechanism.name!r}: {self.end:.6g} s, {len(self.events)} events)"
