"""What a diagram is drawn from: a motion, its forces, the axis of its input, and the outputs it is about."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cached_property, partial
from typing import Any, Literal, TypeAlias, TypeVar, cast

import numpy as np

from linkwright.analysis.analysis import Analysis, Kind
from linkwright.analysis.outputs import free_points, mechanism_outputs, output_link
from linkwright.core.arguments import CURVE_STEPS
from linkwright.core.arrays import Floats, largest
from linkwright.core.outputs import RESIDUALS, Output
from linkwright.core.search import first_largest
from linkwright.cycle.summaries import SummaryValue
from linkwright.errors import LinkwrightError, RequestError
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.names import canonical
from linkwright.kinematics.positions import at_times
from linkwright.kinematics.solve import solve_motion
from linkwright.kinetostatics.forces import Forces, reaction_pairs
from linkwright.kinetostatics.run import solve_forces
from linkwright.kinetostatics.table import results_of
from linkwright.machine.running import SteadyRunning, steady_running
from linkwright.mechanism.mechanism import Mechanism
from linkwright.plotting.diagrams.axes import SYMBOLS, InputAxis, unit_of
from linkwright.words import Translate, _
from linkwright.words.characters import one_line
from linkwright.words.message import LocalizedText

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

    def place_text(self, motion: Motion, translate: Translate) -> str:
        """Where the one position of a motion is: ``φ = 30°``."""
        dimension = self.input_dimension
        if not self.mechanism.drivers:
            return translate(_("at rest"))
        value = float(motion.time[0] if dimension == "time" else motion.input[0])
        return f"{SYMBOLS[dimension]}\u00a0=\u00a0{unit_of(dimension).text(value, 6)}"

    def extremes(self, signal: Callable[[Any], Floats], of: str = "motion") -> Extremes:
        """Extremes over the cycle of a signal of the motion, or of the forces, as the metrics have them."""
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


def main_output(motion: Motion) -> Output:
    """The output that matters most: the last in solving order on the frame, else a free point, else a link; wheels
    that turn in a fixed ratio to a driver only where there is nothing else."""
    mechanism = motion.mechanism
    points = free_points(mechanism)
    if len(mechanism.drivers) > 1 and points:
        return Output("position", points[-1])
    outputs = mechanism_outputs(mechanism)
    order = [link for group in motion.structure.groups for link in group.links]
    slides, geared = [each for each in outputs if each.kind == "displacement"], _geared(motion)
    for found in (slides, [each for each in outputs if output_link(mechanism, each) not in geared]):
        if found:
            return max(found, key=lambda each: order.index(output_link(mechanism, each)))
    if free := free_points(mechanism, geared):
        return Output("position", free[-1])
    moving = [link for link in reversed(order) if largest(motion.link(link).angular_velocity) > 1e-9]
    moving.sort(key=lambda link: link in geared)
    return Output("angle", moving[0]) if moving else Output("angle", order[-1])


def main_outputs(motion: Motion) -> list[Output]:
    """The main output, among the last one on the frame of every group that moves no other group."""
    main, mechanism, geared = main_output(motion), motion.mechanism, _geared(motion)
    groups, found = motion.structure.groups, dict[int, Output]()
    place = {link: number for number, group in enumerate(groups) for link in group.links}
    moving = {
        place[link]
        for number, group in enumerate(groups)
        for each in group.joints
        for link in mechanism.joints[each.joint].joined
        if link != "frame" and place[link] < number
    }
    for output in mechanism_outputs(mechanism):
        link = output_link(mechanism, output)
        if place[link] not in moving and link not in geared:
            found[place[link]] = output
    return list(found.values()) if main in found.values() else [main]


def _geared(motion: Motion) -> set[str]:
    """Driven links, and the wheels that turn in a fixed ratio to one."""
    found = {driver.link for driver in motion.mechanism.drivers.values()}
    for train in motion.structure.trains:
        if not train.planetary and found & train.ratios.keys():
            found |= train.ratios.keys()
    return found


def turning_links(motion: Motion) -> list[str]:
    """Links that turn and are not driven against the frame, in solving order; the driven ones where no other does."""
    driven = {d.link if d.link != "frame" else d.relative_to for d in motion.mechanism.drivers.values()}
    order = [link for group in motion.structure.groups for link in group.links]
    fastest = max((largest(motion.link(link).angular_velocity) for link in order), default=0.0)
    turning = [link for link in order if largest(motion.link(link).angular_velocity) > 1e-9 * fastest]
    return [link for link in turning if link not in driven] or turning


def known_link(mechanism: Mechanism, name: str) -> str:
    """The name of a link; raises LinkwrightError with the nearest one where there is none."""
    return mechanism.link(name).name


def traced_points(mechanism: Mechanism) -> list[str]:
    """Points whose paths are worth drawing: free points, else pins between moving links."""
    free = list(free_points(mechanism))
    if free:
        return free
    pins = [
        name
        for name, joint in mechanism.joints.items()
        if joint.coordinate == "turn" and mechanism.grounded.isdisjoint(joint.joined)
    ]
    return pins or [canonical(mechanism, link.name, p) for link in mechanism.links.values() for p in link.points][:1]


def joint_and_link(forces: Forces, joint: str | None, on: str | None) -> tuple[str, str]:
    """The joint asked for with its link, else the one on the frame that carries most.

    Raises LinkwrightError for unknown names.
    """
    mechanism = forces.mechanism
    if joint is None:
        pairs = reaction_pairs(mechanism)
        driven = {driver.joint for driver in mechanism.drivers.values()}
        held = {name for name, each in mechanism.joints.items() if mechanism.grounded & {*each.joined}} - driven
        on_frame = [pair for pair in pairs if pair[0] in held and pair[1] not in mechanism.grounded]
        if on is not None:
            on_frame = pairs = [p for p in pairs if p[1] == known_link(mechanism, on)]
        if not pairs:
            raise RequestError(
                _(
                    '"{name}" has no joint that carries a force there; name another joint',
                    code="picture.no_force_there",
                    name=mechanism.name,
                )
            )
        pairs = on_frame or pairs
        return pairs[first_largest(np.array([largest(forces.reaction(name, on=on)) for name, on in pairs]))]
    if on is None and joint in mechanism.joints:
        on = [link for link in mechanism.joints[joint].joined if link != "frame"][-1]
    forces.reaction(joint, on=on)
    assert on is not None
    return joint, on


def loaded(forces: Forces) -> bool:
    """Whether any joint carries a force."""
    pairs = reaction_pairs(forces.mechanism)
    return any(np.nan_to_num(largest(forces.reaction(joint, on=link))) > 1e-9 for joint, link in pairs)
