"""What a diagram is drawn from: a motion, its forces, and the axis of its input."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cached_property, partial
from typing import Any, Literal, TypeAlias, TypeVar, cast

import numpy as np

from linkwright.analysis.analysis import Analysis, Kind
from linkwright.core.arguments import CURVE_STEPS
from linkwright.core.arrays import Floats
from linkwright.core.outputs import RESIDUALS, Output
from linkwright.cycle.summary import SummaryValue
from linkwright.errors import LinkwrightError, RequestError
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.positions import at_times
from linkwright.kinematics.solve import solve_motion
from linkwright.kinetostatics.forces import Forces
from linkwright.kinetostatics.run import solve_forces
from linkwright.kinetostatics.table import results_of
from linkwright.machine.running import SteadyRunning, steady_running
from linkwright.mechanism.mechanism import Mechanism
from linkwright.plotting.diagrams.axes import SYMBOLS, InputAxis, unit_of
from linkwright.words import Translate, _
from linkwright.words.characters import one_line
from linkwright.words.sentence import LocalizedText

Result: TypeAlias = Mechanism | Motion | Forces | SteadyRunning
TURN = 2 * np.pi
T = TypeVar("T")
Extremes: TypeAlias = Callable[[Kind], SummaryValue | None]


def _listed(solved: Motion | Forces, output: Output) -> Floats:
    """A result that only tables have, (n,)."""
    motion, forces = (solved, None) if isinstance(solved, Motion) else (solved.motion, solved)
    return results_of(motion, forces)[output]


class PlotInput:
    """One result, with what diagrams need of it; what was not solved yet is solved when it is asked for.

    Arrays over a closed cycle are drawn up to its end: ``closed`` repeats the first position there.
    """

    def __init__(self, result: Result, label: str | None = None, *, static: bool = False) -> None:
        if static and isinstance(result, Forces) and not result.static:
            raise RequestError(
                _("these forces hold inertia forces; give the motion instead", code="picture.with_inertia")
            )
        self.result_running = result if isinstance(result, SteadyRunning) else None
        self._forces = result if isinstance(result, Forces) else None
        self._static = static
        self._result = result
        self._label = label
        self._made: dict[str, object] = {}

    @property
    def label(self) -> str:
        """Its name in the legend."""
        name = self._label or (self.mechanism.name if self.result_running is None else "")
        return name.on_one_line() if isinstance(name, LocalizedText) else one_line(name)

    @property
    def mechanism(self) -> Mechanism:
        """What was solved."""
        return self.motion.mechanism

    @cached_property
    def motion(self) -> Motion:
        """The motion."""
        if isinstance(self._result, SteadyRunning):
            raise RequestError(
                _(
                    "the result of steady running holds no motion; it has the diagrams speed and energy; "
                    "else give forces",
                    code="picture.no_motion",
                )
            )
        if isinstance(self._result, Forces):
            return self._result.motion
        found = (
            self._result
            if isinstance(self._result, Motion)
            else solve_motion(self._result, steps=CURVE_STEPS, failures="mark")
        )
        if not found.ok.any():
            raise LinkwrightError(
                _(
                    '"{name}" reaches no position: {sentence}',
                    code="picture.reaches_none",
                    name=found.mechanism.name,
                    sentence=found.outcomes[0].sentence,
                )
            )
        return found

    @cached_property
    def forces(self) -> Forces:
        """The forces of the motion."""
        return solve_forces(self.motion, static=self._static) if self._forces is None else self._forces

    @property
    def input_dimension(self) -> Literal["angle", "length", "time"]:
        """What says where a position is: the first driver's angle or length, or the time."""
        drivers = self.mechanism.drivers
        if not self.mechanism.steady:
            return "time"
        turning = self.mechanism.joints[next(iter(drivers.values())).joint].coordinate == "turn"
        return "angle" if turning else "length"

    def at(self, place: float | None) -> Motion:
        """The motion at one position: at an input (time), else at the first position that is reached."""
        if place is None or not self.mechanism.drivers:
            first = int(np.flatnonzero(self.motion.ok)[0])
            place = float((self.motion.time if self.input_dimension == "time" else self.motion.input)[first])
        if self.input_dimension == "time":
            return solve_motion(self.mechanism, times=[place])
        return solve_motion(self.mechanism, at=[place])

    def forces_at(self, place: float | None) -> Forces:
        """The forces at one position."""
        static = self._static if self._forces is None else self._forces.static
        return solve_forces(self.at(place), static=static)

    def place_text(self, motion: Motion, say: Translate) -> str:
        """Where the one position of a motion is: ``φ = 30°``."""
        dimension = self.input_dimension
        if not self.mechanism.drivers:
            return say(_("at rest"))
        value = float(motion.time[0] if dimension == "time" else motion.input[0])
        return f"{SYMBOLS[dimension]}\u00a0=\u00a0{unit_of(dimension).text(value, 6)}"

    def extremes(self, signal: Callable[[Any], Floats], of: str = "motion") -> Extremes:
        """Extremes over the cycle of a signal of the motion, or of the forces, as the design numbers have them."""
        loads = of == "forces"
        analysis = Analysis.of(self.forces if loads else self.motion)

        def found(kind: Kind) -> SummaryValue | None:
            extreme = analysis.extreme(signal, kind, of="forces") if loads else analysis.extreme(signal, kind)
            return extreme if extreme is not None and extreme.exact else None

        return found

    def angle_extremes(self, signal: Callable[[Motion], Floats], shown: Floats) -> Extremes | None:
        """The same of an angle, in the turn in which it is ``shown`` (n,); None of one that gains full turns."""
        if not abs(shown[-1] - shown[0]) < TURN / 2:
            return None
        between = self.extremes(signal)

        def found(kind: Kind) -> SummaryValue | None:
            extreme = between(kind)
            if extreme is None:
                return None
            sample = np.nanmax(shown) if kind == "max" else np.nanmin(shown)
            return replace(extreme, value=extreme.value + TURN * float(np.round((sample - extreme.value) / TURN)))

        return found

    def course_of(self, output: Output) -> tuple[Any, Callable[[Any], Floats], str]:
        """The motion or the forces that give an output, how they do, (n,), and which of the two they are."""
        loads = not output.of_motion or self._forces is not None
        solved = self.forces if loads else self.motion
        if output.kind in ("time", "input", *RESIDUALS):
            return solved, partial(_listed, output=output), "forces" if loads else "motion"
        return solved, Analysis.of(solved).signal(output.name), "forces" if loads else "motion"

    @property
    def has_motion(self) -> bool:
        """Whether there is a motion, not only a machine's steady running."""
        return self.result_running is None

    def once(self, name: str, make: Callable[[], T]) -> T:
        """Something costly that several parts of a diagram need, made when it is first asked for."""
        if name not in self._made:
            self._made[name] = make()
        return cast(T, self._made[name])

    def running(self, fluctuation: float) -> SteadyRunning:
        """Steady running with a flywheel for a required fluctuation."""
        return (
            steady_running(self.forces, fluctuation=fluctuation)
            if self.result_running is None
            else self.result_running
        )

    @cached_property
    def axis(self) -> InputAxis:
        """The input, or the time where drivers follow laws of their own, up to the cycle's end."""
        motion = self.motion
        if not motion.mechanism.drivers:
            raise RequestError(
                _(
                    '"{name}" has no driver, so there is no input to draw curves over; draw its '
                    "force_polygon, or add a driver",
                    code="picture.no_input",
                    name=motion.mechanism.name,
                )
            )
        if motion.steps < 2:
            raise RequestError(
                _(
                    '"{name}" is solved at one position only; solve a cycle to draw curves',
                    code="picture.one_position_only",
                    name=motion.mechanism.name,
                )
            )
        name = next(iter(motion.mechanism.drivers))
        if not motion.mechanism.steady:
            end = [] if self._end is None else [self._end]
            return InputAxis("time", np.append(motion.time, end))
        return InputAxis("angle" if motion.positions.rotary[name] else "length", self.input)

    @property
    def input(self) -> Floats:
        """The first driver's coordinate, rad or m, up to the cycle's end."""
        if self._end is None:
            return self.motion.input
        driver = next(iter(self.mechanism.drivers.values()))
        return np.append(self.motion.input, driver.law.coordinate(np.array([self._end]))[0])

    def closed(self, values: Floats, *, turns: bool = False) -> Floats:
        """Values at all positions (n, …), the first one repeated where the cycle ends.

        ``turns``: an angle, which may have gained full turns by then.
        """
        if self._end is None:
            return values
        last = values[:1]
        if turns and np.isfinite(values[[0, -1]]).all():
            last = last + TURN * np.round((values[-1] - last) / TURN)
        return np.concatenate([values, last])

    def ended(self, read: Callable[[Motion], Floats]) -> Floats:
        """What the motion gives at all positions (n,), and where the cycle ends, which need not be as it began."""
        values = read(self.motion)
        if self._end is None:
            return values
        return np.append(values, read(solve_motion(self.mechanism, times=[self._end], failures="mark")))

    @cached_property
    def _end(self) -> float | None:
        """Time at which a closed cycle has returned to its first position, if that is no position already."""
        motion, positions = self.motion, self.motion.positions
        if not positions.closed or positions.repeated or motion.steps < 3:
            return None
        expected = at_times(motion.mechanism, motion.time[-1:])
        same = all(
            np.allclose(expected.coordinates[name][0], rows[0][-1:], atol=1e-9)
            for name, rows in positions.coordinates.items()
        )
        return float(positions.around[-1]) if same else None
