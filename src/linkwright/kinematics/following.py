"""Drivers that follow a path: their coordinates from the same machine driven at the point that is on it.

The point is pinned to a carriage on two guides, whose displacements are the path's coordinates over time; the drivers
without a law are free in that machine. Its Assur groups give their coordinates with exact rates, in closed form
wherever the groups have one.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.outputs import SLIDE, row_name, row_names
from linkwright.core.quantity import shown
from linkwright.drivers.base import LAWS, Driver
from linkwright.drivers.following import Following, Guidance, PathPoint
from linkwright.formula.recently_made import Recent
from linkwright.joints.base import JOINTS, implied_joint
from linkwright.kinematics.motion import Motion, PositionError
from linkwright.kinematics.positions import CycleError, Positions, at_times, rotary
from linkwright.kinematics.solve import MotionRun, with_times
from linkwright.kinematics.solver import MotionSolver
from linkwright.mechanism.drawing import Drawing
from linkwright.mechanism.link import Link
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import _

#: Positions of the path once, by which drivers are tracked; the time of a law that has none, s.
STEPS, WHILE = 720, 1.0
#: Share of the largest speed along the path at which a corner is passed at rest.
AT_REST = 1e-6
#: Names of the carriage: the frame's origin, the part that moves along x, the one that moves along y as well.
ORIGIN, CROSS, CARRIAGE = "@origin", "@cross", "@carriage"

Rows = tuple[Floats, Floats, Floats]


def driven_at_point(guidance: Guidance) -> Mechanism:
    """The machine whose point is moved along its path by two guides, the drivers without a law left out."""
    machine: Mechanism = guidance.machine
    path, point = guidance.path, guidance.path.point
    frame = replace(machine.frame, points={**machine.frame.points, ORIGIN: (0.0, 0.0)})
    held = machine.links[point.link]
    links = {
        **machine.links,
        point.link: replace(held, points={**held.points, CARRIAGE: held.points[point.point]}),
        CROSS: Link(CROSS, "point", {CROSS: (0.0, 0.0)}),
        CARRIAGE: Link(CARRIAGE, "point", {CARRIAGE: (0.0, 0.0)}),
    }
    guide: Any = JOINTS["prismatic"]
    joints = {
        **machine.joints,
        CARRIAGE: implied_joint(CARRIAGE, (point.link, CARRIAGE)),
        "@x": guide("@x", "frame", ORIGIN, 0.0, None, CROSS, CROSS),
        "@y": guide("@y", CROSS, CROSS, 0.5 * math.pi, None, CARRIAGE, CARRIAGE),
    }
    drivers = {
        "@x": Driver("@x", "@x", CROSS, "frame", PathPoint(path, 0)),
        "@y": Driver("@y", "@y", CARRIAGE, CROSS, PathPoint(path, 1)),
        **{name: each for name, each in machine.drivers.items() if not isinstance(each.law, Following)},
    }
    place = Drawing(machine).place(point.link, point.point)
    drawn = {} if place is None else {CARRIAGE: place, CROSS: (place[0], 0.0)}
    return replace(
        machine,
        frame=frame,
        links=links,
        joints=joints,
        drivers=drivers,
        drawing={**machine.drawing, **drawn},
        loads={},
        actuators={},
        stops={},
        run=None,
        outputs={},
        cycle=None,
        expressions={},
        path=None,
    )


def as_put_together(mechanism: Mechanism) -> Mechanism:
    """The machine to which words of assembly and the drawing belong: of one that follows a path the one driven at the
    point, else itself."""
    return mechanism if mechanism.guidance is None else driven_at_point(mechanism.guidance)


class _Course:
    """The coordinates of the drivers that follow, from a motion along the path to which further times are added."""

    def __init__(self, guidance: Guidance) -> None:
        self.guidance = guidance
        machine = self.machine = driven_at_point(guidance)
        self.solver = MotionSolver(machine)
        given: Mechanism = guidance.machine
        self.drivers = [each for each in given.drivers.values() if isinstance(each.law, Following)]
        names = [name for each in self.drivers for name in self._names(each)]
        self.names = (*dict.fromkeys(names), "outcome")
        first, last = guidance.span()
        begin = max(first, 0.0)
        cycle = given.cycle and given.cycle.duration
        end = begin + (guidance.path.natural_duration() or cycle or WHILE)
        self.begin, self.unit = begin, min(end, last) - begin
        self.motion = self._along(begin, min(end, last))
        self._refuse_corners()
        self._tracked = self._unwrapped()
        self._refuse_singular()

    def _along(self, begin: float, end: float) -> Motion:
        """The motion from one time to another, with a step of a share of the path."""
        count = max(2, math.ceil(STEPS * (end - begin) / self.unit - 1e-9))
        time = np.linspace(begin, end, count + 1)
        positions = replace(at_times(self.machine, time), cycle=True)
        motion = MotionRun(self.solver, positions).solve("mark")
        if not motion.ok.all() or motion.modes:
            self._refuse(motion)
        return motion

    def at(self, t: Floats) -> dict[str, Rows]:
        """Coordinates and rates (n,) by driver at times t (n,), s."""
        if not len(t):
            return {each.name: (t, t, t) for each in self.drivers}
        first, last = self.motion.time[0], self.motion.time[-1]
        slack = 1e-9 * self.unit
        if t.min() < first - slack or t.max() > last + slack:
            self.motion = self._along(min(first, t.min()), max(last, t.max()))
            self._tracked = self._unwrapped()
        values = self._evaluated(t)
        found = {}
        for driver in self.drivers:
            q, rate, second = self._rows(driver, values)
            if driver.law.rotary:
                near = np.interp(t, self.motion.time, self._tracked[driver.name])
                q = near + np.remainder(q - near + math.pi, 2.0 * math.pi) - math.pi
            found[driver.name] = q, rate, second
        return found

    def _evaluated(self, t: Floats) -> dict[str, Floats]:
        """The rows of the outputs at times."""
        if self.motion.states:
            motion, places = with_times(self.motion, t)
            if not motion.ok[places].all():
                self._refuse(motion)
            return {name: row[places] for name, row in self._values(motion).items()}
        positions = at_times(self.machine, t)
        rows = self.solver.evaluate(self.names, positions, {}, {})
        values = dict(zip(self.names, rows, strict=True))
        if values["outcome"].any():
            self._refuse(MotionRun(self.solver, positions, single=True).solve("mark"))
        return values

    def _values(self, motion: Motion) -> dict[str, Floats]:
        """The rows of the outputs along a motion."""
        rows = motion.solver.evaluate(self.names, motion.positions, motion.states, motion.modes)
        return dict(zip(self.names, rows, strict=True))

    @staticmethod
    def _names(driver: Driver) -> list[str]:
        if not driver.law.rotary:
            return [row_name(kind, driver.joint) for kind in SLIDE]
        links = [each for each in (driver.link, driver.relative_to) if each != "frame"]
        kinds = ("angular_velocity", "angular_acceleration")
        return [
            name
            for link in links
            for name in (*row_names("direction", link), *(row_name(each, link) for each in kinds))
        ]

    def _rows(self, driver: Driver, values: dict[str, Floats]) -> Rows:
        """A driver's coordinate and rates, an angle in (-π, π]."""
        if not driver.law.rotary:
            q, rate, second = (values[name] for name in self._names(driver))
            return q, rate, second
        (c, s, w, g), (c0, s0, w0, g0) = (self._turning(link, values) for link in (driver.link, driver.relative_to))
        return np.arctan2(s * c0 - c * s0, c * c0 + s * s0), w - w0, g - g0

    @staticmethod
    def _turning(link: str, values: dict[str, Floats]) -> tuple[Any, Any, Any, Any]:
        if link == "frame":
            return 1.0, 0.0, 0.0, 0.0
        x, y = (values[name] for name in row_names("direction", link))
        return x, y, values[row_name("angular_velocity", link)], values[row_name("angular_acceleration", link)]

    def _unwrapped(self) -> dict[str, Floats]:
        """The coordinates along the motion with their turns; at its beginning as near as can be to the drawing."""
        values = self._values(self.motion)
        begin = int(np.argmin(np.abs(self.motion.time - self.begin)))
        found = {}
        for driver in self.drivers:
            q = self._rows(driver, values)[0]
            if driver.law.rotary:
                q = np.unwrap(q)
                drawn = Drawing(self.guidance.machine).driver(driver.name) or 0.0
                q = q - 2.0 * math.pi * round((q[begin] - drawn) / (2.0 * math.pi))
            found[driver.name] = q
        return found

    def _courses(self) -> Iterator[tuple[str, Floats, bool]]:
        """Names, coordinates along the motion, and whether they turn."""
        for driver in self.drivers:
            yield driver.name, self._tracked[driver.name], driver.law.rotary

    def positions(self) -> Positions:
        """Those of the motion for the machine itself."""
        given: Mechanism = self.guidance.machine
        values = self._values(self.motion)
        rows = {each.name: self._rows(each, values) for each in self.drivers}
        time = self.motion.time
        every = {name: rows.get(name) or each.law.coordinate(time) for name, each in given.drivers.items()}
        return Positions(time, every, rotary(given), cycle=True)

    # what is refused ------------------------------------------------------------------------------
    def _where(self, time: float) -> dict[str, object]:
        """Where the point is on its path at a time."""
        x, y = self.guidance.path.at(np.array([time]))[0][0].tolist()
        place = (shown(x, "length"), shown(y, "length"))
        return {"point": self.guidance.path.point, "x": place[0], "y": place[1], "time": round(time, 9)}

    def _refuse(self, motion: Motion) -> None:
        """Refuses a path on which the point cannot be, or only at a limit of its reach."""
        failed = np.flatnonzero(~motion.ok)
        reason: Any = tuple(motion.notes)
        time = float(motion.time[0])
        if len(failed):
            time, reason = float(motion.time[failed[0]]), motion.outcomes[int(failed[0])]
        message = _(
            "{point} cannot follow its path at ({x}, {y}), at {time:g} s: {reason}; move the path into the reach of "
            "the machine, or change the dimensions",
            code="path.unreachable",
            **self._where(time),
            reason=reason,
        )
        if len(failed):
            raise PositionError(message, tuple(int(i) for i in failed), reason)
        raise CycleError(message)

    def _refuse_corners(self) -> None:
        """Refuses corners that are not passed at rest: there accelerations have no bound."""
        path = self.guidance.path
        rates = np.abs(path.distance.coordinate(self.motion.time)[1])
        for length, place in path.route.corners:
            for time in path.passing([length], self.motion.time[0], self.motion.time[-1]).tolist():
                speed = float(np.abs(path.distance.coordinate(np.array([time]))[1][0]))
                if speed > AT_REST * rates.max():
                    raise CycleError(
                        _(
                            "the path of {point} has a corner at ({x}, {y}), which it passes with {speed} at "
                            "{time:g} s, so that the acceleration has no bound; write smooth: true, round the corner "
                            "by an arc, or let the point rest there, as over: 2 s does",
                            code="path.corner",
                            **{**self._where(time), "x": shown(place[0], "length"), "y": shown(place[1], "length")},
                            speed=shown(speed, "velocity"),
                        )
                    )

    def _refuse_singular(self) -> None:
        """Refuses a path that leads through a position in which the drivers do not hold the point."""
        posed, times = self.posed(), tuple(self.motion.time.tolist())
        table: Any = LAWS["table"]
        laws = {name: table(times, tuple(q.tolist()), rotary=rotates) for name, q, rotates in self._courses()}
        drivers = {name: replace(each, law=laws.get(name, each.law)) for name, each in posed.drivers.items()}
        machine = replace(posed, drivers=drivers)
        motion = MotionRun(MotionSolver(machine), self.positions()).solve("mark")
        if motion.ok.all() and not motion.modes:
            return
        failed = np.flatnonzero(~motion.ok)
        time = float(motion.time[failed[0]]) if len(failed) else self._flip(motion)
        reason: Any = motion.outcomes[int(failed[0])] if len(failed) else tuple(motion.notes)
        raise CycleError(
            _(
                "the path of {point} leads at ({x}, {y}), at {time:g} s, through a singular position of the machine, "
                "in which its drivers do not hold the point and their efforts have no bound: {reason}; move the path "
                "or change the dimensions",
                code="path.singular",
                **self._where(time),
                reason=reason,
            )
        )

    def _flip(self, motion: Motion) -> float:
        """Where the first group changes its assembly mode, s."""
        changes = [np.flatnonzero(np.diff(row)) for row in motion.modes.values()]
        first = min((int(each[0]) for each in changes if len(each)), default=0)
        return float(motion.time[first])

    def posed(self) -> Mechanism:
        """The machine drawn as it is at the beginning of the path, so that its assembly modes are seen."""
        given: Mechanism = self.guidance.machine
        index = int(np.argmin(np.abs(self.motion.time - self.begin)))
        own = {point for link in given.links.values() for point in link.points}
        drawn = {}
        for name in self.motion.point_names():
            if name.rpartition(".")[2] in own:
                x, y = self.motion.point(name).position[index].tolist()
                drawn[name] = (x, y)
        return replace(given, drawing=drawn, assembly={})


def coordinates(guidance: Guidance, t: Floats) -> dict[str, Rows]:
    """Coordinates and rates of the drivers that follow a path, (n,) each, at times t (n,), s.

    Raises:
        PositionError: the point cannot be on its path at one of the times.
        LinkwrightError: the path has corners at speed, or leads through a singular position; a law ends before.
    """
    course = _course(guidance)
    key = t.tobytes()
    return _found.get(guidance, key, lambda: course.at(t))


def posed(guidance: Guidance) -> Mechanism:
    """The machine drawn as it is at the beginning of the path."""
    return _course(guidance).posed()


def _course(guidance: Guidance) -> _Course:
    return _courses.get(guidance, None, lambda: _Course(guidance))


_courses: Recent[Guidance, _Course] = Recent(16)
_found: Recent[Guidance, dict[str, Rows]] = Recent(16)
