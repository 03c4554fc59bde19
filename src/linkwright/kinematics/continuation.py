"""Groups without closed form, followed from the drawing through all positions."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from linkwright.core.arrays import Flags, Floats, Indices
from linkwright.core.inputs import driven
from linkwright.core.outputs import row_name, row_names
from linkwright.engine.scalar_backend import ScalarProgram
from linkwright.kinematics.angles import geared, turn_state
from linkwright.kinematics.assembly import AssemblyError
from linkwright.kinematics.branch import Branch, Way, follow, lawful, straight
from linkwright.kinematics.certificate import distance_to_others
from linkwright.kinematics.closed_loops import ClosedLoops, counted
from linkwright.kinematics.drawn_assembly import nearest_assembly
from linkwright.kinematics.followed_way import Followed, Stop
from linkwright.kinematics.groups import iterated, state_name
from linkwright.kinematics.positions import Positions, coordinate_text, off_law, rotary

if TYPE_CHECKING:
    from linkwright.kinematics.design import Design
    from linkwright.kinematics.solver import MotionSolver

#: What a drawing may leave open (share of the size) to count as exact.
EXACT = 1e-13
#: What may be left open where Newton's method cannot close it, as everything is singular.
SINGULAR = 1e-9
#: Dyads this near (rad, or share of the size) to where their modes put them are in these modes.
SAME = 1e-6


class Follower:
    """Follows the closed loops of one design of a mechanism."""

    def __init__(self, solver: MotionSolver, design: Design) -> None:
        self.solver = solver
        self.design = design
        self.mechanism = design.mechanism
        self.loops = ClosedLoops(self.mechanism, solver.structure)
        self.groups = iterated(solver.structure)
        self.counted = counted(solver.structure, self.mechanism)
        rotary = [
            solver.mechanism.joints[d.joint].coordinate == "turn" for d in self.mechanism.drivers.values()
        ]
        lifts = self.loops.lifts
        self.rotary = np.array([*rotary, *[False] * len(lifts)], dtype=bool)
        own = np.where(self.rotary[: len(rotary)], 1.0, self.loops.size)
        self.unit = np.append(own, [lift.unit for lift in lifts])

    # states -----------------------------------------------------------------------------------
    def states(self, coordinates: Floats, inputs: Floats) -> dict[str, Floats]:
        """Chain coordinates by name (m,) from unknowns of the loops (m, n) and what is driven (m, d)."""
        y = np.concatenate([coordinates, inputs], axis=1)
        found: dict[str, Floats] = {}
        for group in self.groups:
            for step in group.unknowns:
                name = state_name(group, step)
                if step.slides:
                    found[f"{name}.s"] = self.loops.value(("slide", step.joint), y)
                    continue
                angle = self.loops.value(("turn", step.child), y)
                if geared(group):
                    found[f"{name}.angle"] = angle
                else:
                    found[f"{name}.x"], found[f"{name}.y"] = np.cos(angle), np.sin(angle)
        for link in self.counted:
            found[turn_state(link)] = self.loops.value(("turn", link), y)
        return found

    # the drawing --------------------------------------------------------------------------------
    @property
    def drawn(self) -> Floats:
        """Unknowns (n,) of the assembled mechanism that the drawing shows, at the inputs ``drawn_inputs``.

        Raises:
            AssemblyError: the drawing is too far from any assembly.
        """
        return self._drawn[: self.loops.n]

    @property
    def drawn_inputs(self) -> Floats:
        """Coordinates (d,) of drivers and lifts of the assembled mechanism that the drawing shows."""
        return self._drawn[self.loops.n :]

    @cached_property
    def _drawn(self) -> Floats:
        """Coordinates (n + d,) of the assembly that the drawing shows: of the nearest one where it does not close."""
        loops, assembly = self.loops, self.solver.assembly
        inputs = np.array([assembly.inputs[name] for name in loops.drivers])
        rough = np.concatenate([self._rough(inputs), self.driven(inputs[None, :])[0]])
        gap, found = self._open(rough), None
        if gap <= EXACT:
            found = self._closed(rough)
        elif math.isfinite(gap):
            found = self._nearest(rough)
        if found is None:
            turns = rotary(self.mechanism)
            known = zip(loops.drivers, inputs.tolist(), strict=True)
            said = tuple(coordinate_text(name, q, turns[name]) for name, q in known)
            raise AssemblyError("motion.not_near_drawing", name=self.mechanism.name, inputs=said)
        return found

    def _open(self, y: Floats) -> float:
        """What coordinates (n + d,) leave open, as share of the size."""
        return float(np.abs(self.loops.gap(self.loops.turned(y))).max(initial=0.0)) / self.loops.size

    def _closed(self, y: Floats) -> Floats | None:
        """The root at coordinates that nearly close; these themselves where the loops are singular there."""
        root = self.loops.newton(y, 40)
        return y if root is None and self._open(y) < SINGULAR else root

    def _nearest(self, rough: Floats) -> Floats | None:
        """The assembly nearest to the drawing, if its dyads are in their modes there."""
        loops, drawing = self.loops, self.solver.assembly.drawing
        places = {
            (link, point): complex(*at)
            for link in loops.links
            for point in self.mechanism.link(link).points
            if (at := drawing.drawn(link, point)) is not None
        }
        drawn = [drawing.driver(name) is not None and not loops.lifts for name in loops.drivers]
        free = np.array([*[True] * loops.n, *drawn, *[False] * len(loops.lifts)], dtype=bool)
        scale = np.concatenate([loops.scale, self.unit])
        found = nearest_assembly(loops, loops.to_places(places), rough, scale, free)
        root = None if found is None else self._closed(found)
        if root is None:
            return None
        own = {group.name for group in self.groups}
        again = self._rough(root[loops.n :][: len(loops.drivers)])
        gone = self.nearest_way(again - root[: loops.n]) / loops.scale
        same = [abs(gap) < SAME for gap, group in zip(gone, loops.groups, strict=True) if group not in own]
        return root if all(same) else None

    def _rough(self, drawn_inputs: Floats) -> Floats:
        """The unknowns as drawn; those of dyads by their closed form, where it has them in reach."""
        solver, loops, drawing = self.solver, self.loops, self.solver.assembly.drawing
        own = {link for group in self.groups for link in group.links}
        names = tuple(
            each for n in loops.links if n not in ("frame", *own) for each in row_names("direction", n)
        )
        slides = [key for kind, key in loops.unknowns if kind == "slide" and not self._drawn_slide(key)]
        program = solver.program((*names, *(row_name("displacement", key) for key in slides))).program
        inputs = _named(
            dict(zip(loops.drivers, drawn_inputs, strict=True)), self.rotary[: len(loops.drivers)]
        )
        parameters, drawn = self.design.parameters, solver.assembly.states
        outputs, _ = ScalarProgram(program).step(
            [parameters[name] for name in program.parameters],
            [inputs[name] for name in program.positions],
            [drawn[name] for name in program.states],
        )
        value = dict(zip((*names, *slides), map(float, outputs), strict=True))
        rough = []
        for (kind, key), group in zip(loops.unknowns, loops.groups, strict=True):
            if kind == "slide":
                at = self._drawn_slide(key)
                own_slide = value[key] if at is None else drawn[at]
                shown = drawing.slide(self.mechanism.guides[key]) if math.isnan(own_slide) else own_slide
                rough.append(math.nan if shown is None else shown)
            elif key in own:
                rough.append(self._angle(drawn, group, key))
            else:
                x, y = (value[each] for each in row_names("direction", key))
                angle, drawn_angle = math.atan2(y, x), drawing.angle(key)
                near = angle if drawn_angle is None else drawn_angle
                off = 0.0 if math.isnan(angle) else math.remainder(angle - near, 2.0 * math.pi)
                rough.append(near + off)
        return np.array(rough)

    def _drawn_slide(self, joint: str) -> str | None:
        for group in self.groups:
            for step in group.unknowns:
                if step.joint == joint:
                    return f"{state_name(group, step)}.s"
        return None

    def _angle(self, drawn: Mapping[str, float], name: str, child: str) -> float:
        group = next(group for group in self.groups if group.name == name)
        state = state_name(group, next(step for step in group.unknowns if step.child == child))
        if geared(group):
            return drawn[f"{state}.angle"]
        return math.atan2(drawn[f"{state}.y"], drawn[f"{state}.x"])

    # ways ---------------------------------------------------------------------------------------
    def follow(self, positions: Positions, apart: bool = False) -> Followed:
        """The way through all positions, from the drawing on; ``apart``: they are no cycle, but each for itself."""
        return _Journey(self, positions, apart).followed()

    def between(self, begin: Floats, end: Floats, start: Floats) -> Branch:
        """The straight way from driver coordinates (d,) to others, from the unknowns ``start`` (n,)."""
        return follow(self.loops, straight(self.loops, begin, end, self.unit), start)

    def driven(self, q: Floats) -> Floats:
        """Coordinates of the drivers (m, drivers), and behind them those of lifts (m, d)."""
        return self.loops.driven(q, np.zeros_like(q), np.zeros_like(q))[0]

    def nearest_drive(self, way: Floats) -> Floats:
        """Differences of driver coordinates (…, d) without whole turns."""
        return np.asarray(way - np.where(self.rotary, _turns(way), 0.0))

    def nearest_way(self, way: Floats) -> Floats:
        """Differences of coordinates (…, n + d), or of the unknowns (…, n), without whole turns."""
        turning = np.append([kind == "turn" for kind, _ in self.loops.unknowns], self.rotary)[: way.shape[-1]]
        return np.asarray(way - np.where(turning, _turns(way), 0.0))

    def lawful(self, begin: float, end: float, times: Floats, shift: float) -> Way:
        """The way by the drivers' laws, see :func:`branch.lawful`."""
        laws = [driver.law for driver in self.mechanism.drivers.values()]
        return lawful(self.loops, laws, self.unit, begin, end, times, shift)

    def moved(self, unknowns: Floats, start: float, time: Floats) -> dict[str, Floats]:
        """States at some times (m,), s, followed by the drivers' laws from the unknowns (n,) at the time ``start``;
        NaN where the way is barred."""
        found = np.full((len(time), self.loops.n), math.nan)
        q = np.empty((len(time), self.loops.d))
        for sense in (1.0, -1.0):
            these = np.flatnonzero(time >= start if sense > 0.0 else time < start)
            if len(these):
                order = these[np.argsort(sense * time[these], kind="stable")]
                way = self.lawful(start, float(time[order[-1]]), time[order], 0.0)
                branch = follow(self.loops, way, unknowns)
                found[order[: len(branch.found)]] = branch.found[:, : self.loops.n]
                q[order] = way.drive(way.places)[0]
        return self.states(found, q)


def _turns(way: Floats) -> Floats:
    """Whole turns in angles, rad."""
    return np.asarray(2.0 * np.pi * np.round(way / (2.0 * np.pi)))


def _named(inputs: Mapping[str, float], rotary: Sequence[bool] | Flags) -> dict[str, float]:
    values: dict[str, float] = {}
    for (name, q), turns in zip(inputs.items(), rotary, strict=True):
        values |= driven(name, bool(turns), (q, 0.0, 0.0), math.cos, math.sin)
    return values


class _Journey:
    """The ways from the drawing through all positions, and what was found on them."""

    def __init__(self, follower: Follower, positions: Positions, apart: bool) -> None:
        self.follower, self.positions, self.apart = follower, positions, apart
        loops = follower.loops
        n = positions.count
        rows = [positions.coordinates[name][0] for name in loops.drivers]
        self.q = follower.driven(np.stack(rows, axis=1) if rows else np.zeros((n, 0)))
        self.coordinates = np.full((n, loops.n), math.nan)
        self.certified = np.zeros(n, dtype=bool)
        self.stops: list[Stop] = []
        self.stop_of = np.full(n, -1)
        self.returns: bool | None = None
        self.breaks: list[int] = []

    def followed(self) -> Followed:
        self._all()
        follower, y = self.follower, np.concatenate([self.coordinates, self.q], axis=1)
        margin = np.full(len(y), math.nan)
        good = np.isfinite(self.coordinates).all(axis=1)
        if good.any():
            margin[good] = distance_to_others(follower.loops, y[good])
        states = follower.states(self.coordinates, self.q)
        stops = tuple(self.stops)
        return Followed(
            follower,
            self.q,
            states,
            self.coordinates,
            self.certified,
            margin,
            stops,
            self.stop_of,
            frozenset(self.breaks),
            self.positions.closed,
            self.returns,
            self.positions if self.positions.cycle and self.lawful else None,
        )

    def _all(self) -> None:
        follower = self.follower
        start = self._leg(follower.drawn_inputs, follower.drawn, np.array([0]), True)
        if start is not None and self.positions.count > 1 and self.lawful:
            self._along_laws(start)
        elif start is not None and self._in_line():
            self._along_line(start)
        elif start is not None or self.apart:
            self._apart(start, 1)

    @cached_property
    def lawful(self) -> bool:
        """Whether the positions follow each other in time by the drivers' laws."""
        time = self.positions.time
        steps = np.diff(time)
        if not ((steps > 0.0).all() or (steps < 0.0).all()):
            return False
        return off_law(self.follower.mechanism, self.positions) is None

    def _in_line(self) -> bool:
        """Whether the drivers' coordinates follow each other on one straight line."""
        if self.positions.count < 3 or self.positions.closed:
            return False
        share, q = self._shares(), self.q[:, : len(self.follower.loops.drivers)]
        on_line = q[0] + share[:, None] * (q[-1] - q[0])
        return bool((np.diff(share) > 0.0).all() and np.allclose(on_line, q, rtol=1e-14, atol=1e-14))

    def _shares(self) -> Floats:
        way, count = self.q[-1] - self.q[0], len(self.follower.loops.drivers)
        lead = int(np.argmax(np.abs(way / self.follower.unit)[:count]))
        return np.asarray((self.q[:, lead] - self.q[0, lead]) / (way[lead] or 1.0))

    def _along_line(self, start: tuple[Floats, bool]) -> None:
        follower, n = self.follower, self.positions.count
        way = straight(follower.loops, self.q[0], self.q[-1], follower.unit)
        branch = follow(follower.loops, replace(way, places=self._shares()), start[0])
        k = len(branch.found)
        self.coordinates[:k] = branch.found[:, : follower.loops.n]
        self.certified[:k] = branch.certified & start[1]
        if not branch.complete and k < n:
            self._stopped(branch, np.arange(k, n))
            if self.apart:
                self._apart((self.coordinates[k - 1], bool(self.certified[k - 1])), k)

    # one leg ------------------------------------------------------------------------------------
    def _leg(self, begin: Floats, start: Floats, index: Indices, proved: bool) -> tuple[Floats, bool] | None:
        """The straight way to one position; turning drivers go the shorter way, or else the other way round."""
        follower, goal = self.follower, self.q[index[0]]
        turn = np.where(follower.rotary, _turns(goal - begin), 0.0)
        ways = [goal - turn]
        if follower.rotary.sum() == 1:
            there = goal - turn - begin
            ways.append(
                goal - turn - np.where(follower.rotary, 2 * np.pi * np.where(there < 0, -1.0, 1.0), 0.0)
            )
        first: Branch | None = None
        for end in ways:
            branch = follower.between(begin, end, start)
            first = first or branch
            if branch.complete:
                n = follower.loops.n
                self.coordinates[index[0]] = branch.last[:n]
                self.certified[index[0]] = proved and bool(branch.certified.all())
                return branch.last[:n], bool(self.certified[index[0]])
        assert first is not None
        self._stopped(first, index)
        return None

    def _apart(self, here: tuple[Floats, bool] | None, first: int) -> None:
        """Positions one after the other, each from the last one that was reached."""
        follower = self.follower
        begin = self.q[first - 1] if here is not None else follower.drawn_inputs
        state = here if here is not None else (follower.drawn, True)
        for i in range(first, self.positions.count):
            moved = self._leg(begin, state[0], np.array([i]), state[1])
            if moved is not None:
                begin, state = self.q[i], moved

    def _stopped(self, branch: Branch, index: Indices) -> None:
        loops = self.follower.loops
        last = branch.last
        known = np.isfinite(last).all()
        group = loops.weakest_group(last) if known else loops.groups[-1]
        inputs = last[loops.n :] if known else self.q[index[0]]
        self.stops.append(Stop(inputs[: len(loops.drivers)], group))
        self.stop_of[index] = len(self.stops) - 1

    # a way by the laws -----------------------------------------------------------------------------
    def _along_laws(self, start: tuple[Floats, bool]) -> None:
        positions = self.positions
        time, n = positions.time, positions.count
        around = positions.period
        branch = self._way(start, time, time[0] + around if around else time[-1], np.arange(n), 0.0)
        reached = int(np.isfinite(self.coordinates).all(axis=1).sum())
        if branch.complete:
            if around:
                self.returns = self._same(branch.last, start[0])
            return
        rest = np.arange(reached, n)
        self._stopped(branch, rest)
        self.breaks.append(reached - 1)
        if self.apart and not positions.is_way:
            self._apart((self.coordinates[reached - 1], bool(self.certified[reached - 1])), reached)
        elif around and len(rest):
            back = self._way(start, time - around, time[rest[0]] - around, np.append(rest, 0)[::-1], around)
            behind = rest[~np.isfinite(self.coordinates[rest]).all(axis=1)]
            if not back.complete and len(behind):
                self._stopped(back, behind[-1:])

    def _way(
        self, start: tuple[Floats, bool], time: Floats, end: float, order: Indices, shift: float
    ) -> Branch:
        """From the first of the positions in ``order``, at their times, to the time ``end``."""
        begin, follower = float(self.positions.time[0]), self.follower
        way = follower.lawful(begin, end, np.where(order == 0, begin, time[order]), shift)
        branch = follow(follower.loops, way, start[0])
        found = order[: len(branch.found)]
        self.coordinates[found] = branch.found[:, : follower.loops.n]
        self.certified[found] = branch.certified & start[1]
        return branch

    def _same(self, last: Floats, first: Floats) -> bool:
        """Whether a cycle ends in the assembly in which it began."""
        loops = self.follower.loops
        turning = np.array([kind == "turn" for kind, _ in loops.unknowns])
        gap = last[: loops.n] - first
        gap = np.where(turning, 2.0 * np.sin(gap / 2.0), gap / loops.scale)
        return bool(np.abs(gap).max() < 1e-6)
