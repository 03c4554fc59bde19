"""Change points: positions where two assembly modes meet and the motion passes from one sign to the other.

Between two positions of a cycle the square under a dyad's root may touch zero without crossing it, as in a
parallelogram on the frame line. The motion goes on smoothly, the sign of the mode changes. The same happens
where the outer pins of a dyad with two equal links meet. Where the square falls below zero the mechanism
cannot pass: what lies beyond is another circuit (Suh & Radcliffe, Kinematics and Mechanisms Design, ch. 4;
Erdman & Sandor, Mechanism Design, ch. 3). On dyads on which groups without closed
form hang, the way ends at a change point, as it does where these are singular themselves.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence, Set
from dataclasses import replace
from functools import cached_property
from math import ceil

import numpy as np

from linkwright.core.arrays import Flags, Floats
from linkwright.core.inputs import mode_inputs
from linkwright.core.outputs import row_name
from linkwright.core.search import edge, ends, lowest
from linkwright.formula.recently_made import Recent
from linkwright.formula.trace import Scalar, minimum
from linkwright.kinematics.groups import upstream
from linkwright.kinematics.passing import FINE, NEAR, ChangePointCrossing, Kind, measures, modal
from linkwright.kinematics.positions import Positions, at_times, off_law
from linkwright.kinematics.solver import MotionSolver
from linkwright.kinematics.trace import MotionTrace
from linkwright.kinematics.tracked_branch import TrackedBranch
from linkwright.topology import Structure

#: A refined minimum of the quality within this distance of zero is a touch; of the squared distance of two pins,
#: as share of the largest one.
TOUCH = 1e-11
MEETING = 1e-18
#: Positions this near to a change point (share of a step) are on it.
ON_IT = 1e-5
#: Samples of laws that are no straight lines in which a cycle is looked through, and the most places looked at.
SAMPLES, MOST = 720, 40_000
#: Into at least so many steps a cycle is divided.
FEWEST = 24
#: Rounds in which change points are sought again: behind what bars the way of one group no other turns its sign.
ROUNDS = 4
#: From so many groups that pass change points on, the signs of all groups are inputs: their motion is traced once.
MANY = 3

Way = Callable[[Floats], Positions]


def crossings(solver: MotionSolver, positions: Positions, tracked: TrackedBranch | None) -> list[ChangePointCrossing]:
    """All places between solved positions where a group's modes or pins meet, or where it cannot pass."""
    if not positions.is_way:
        return []
    count = parts(solver, positions)
    if count == 1:
        return _Search(solver, positions, tracked).found()
    divided = _divided(solver, positions, count)
    tracked = None if tracked is None else solver.track(divided)
    return _Search(solver, divided, tracked, count).found_between()


def outputs_at_crossings(solver: MotionSolver, positions: Positions) -> tuple[str, ...] | None:
    """Names of the outputs that show where :func:`passages` may find something; None where these do not tell."""
    if not positions.is_way or parts(solver, positions) > 1:
        return None
    return _measures.get(solver.motion, None, lambda: _all_measures(solver.motion))


#: Of a motion all :func:`measures`; None where a group's guides may become parallel.
_measures: Recent[MotionTrace, tuple[str, ...] | None] = Recent(64)


def _all_measures(motion: MotionTrace) -> tuple[str, ...] | None:
    if any("sine" in placed.facts for placed in motion.placed.values()):
        return None
    return tuple(name for group in modal(motion) for name in measures(motion, group))


def nearness(solver: MotionSolver) -> Scalar:
    """How near the dyads are to what :func:`passages` finds, traced: the minimum quality, or squared distance of
    outer pins over the size. Above :data:`NEAR` and what it changes by in one step nothing lies between two
    positions."""
    size = solver.mechanism.size
    found: Scalar = 1.0
    for placed in solver.motion.placed.values():
        if placed.dyad is not None:
            found = minimum(found, placed.quality)
        if "distance²" in placed.facts:
            found = minimum(found, placed.facts["distance²"] * (1.0 / size**2))
    return found


def parts(solver: MotionSolver, positions: Positions) -> int:
    """How often the steps of a cycle must be divided, so that no driver moves farther than :data:`FINE` in one, and
    there are :data:`FEWEST` of them, since a small group in a large machine may come and go on a short way."""
    if not positions.cycle or not positions.coordinates:
        return 1
    mechanism, ways = solver.mechanism, positions
    step = _step(positions)
    if any(driver.law.constant_speed is None for driver in mechanism.drivers.values()):
        span = step * positions.steps
        ways = at_times(mechanism, positions.time[0] + span * np.linspace(0.0, 1.0, SAMPLES + 1))
    farthest = max(
        pace * abs(step) / (1.0 if positions.rotary[name] else mechanism.size) for name, pace in ways.paces.items()
    )
    wanted = max(ceil(farthest / FINE - 1e-9), ceil(FEWEST / positions.steps))
    return min(wanted, max(MOST // positions.count, 1))


def _step(positions: Positions) -> float:
    """Time between two positions of a cycle, s."""
    return float(positions.time[1] - positions.time[0]) if positions.count > 1 else positions.period or 0.0


def _divided(solver: MotionSolver, positions: Positions, parts: int) -> Positions:
    count = positions.count * parts if positions.closed else (positions.count - 1) * parts + 1
    time = positions.time[0] + _step(positions) / parts * np.arange(count)
    return replace(at_times(solver.mechanism, time, positions.period), cycle=True)


def way(solver: MotionSolver, positions: Positions) -> Way:
    """Positions at places (fractional numbers of positions), by the drivers' laws if those hold."""
    mechanism, index = solver.mechanism, np.arange(positions.count + 1.0)
    time = np.append(positions.time, positions.time[0] + (positions.period or 0.0))
    if off_law(mechanism, positions) is None and (np.diff(positions.time) != 0.0).all():
        return lambda place: at_times(mechanism, np.interp(place, index, time))

    def mixed(place: Floats) -> Positions:
        between = {
            name: (_at(place, q), _at(place, rate), _at(place, second))
            for name, (q, rate, second) in positions.coordinates.items()
        }
        return Positions(np.zeros(len(place)), between, positions.rotary)

    return mixed


def _at(place: Floats, row: Floats) -> Floats:
    """A row (n,) at numbers of positions, in straight lines."""
    return np.asarray(np.interp(place, np.arange(len(row)), row))


class _Search:
    """Passages of all groups, in solving order, since the sign of one group decides on the next ones."""

    def __init__(
        self, solver: MotionSolver, positions: Positions, tracked: TrackedBranch | None, parts: int = 1
    ) -> None:
        self.base = solver.with_flips(())
        self.solver = self.base
        self.positions = positions
        self.tracked = tracked
        self.parts = parts
        self.beneath = _beneath_tracked(solver)
        self.passing: list[ChangePointCrossing] = []
        self.flipping: dict[str, list[ChangePointCrossing]] = {}
        self.barred: Floats = np.empty(0)

    @cached_property
    def way(self) -> Way:
        return way(self.base, self.positions)

    @property
    def ends(self) -> tuple[float, float]:
        """The first and the last place."""
        return (-np.inf, np.inf) if self.positions.closed else (0.0, self.positions.count - 1.0)

    def found(self) -> list[ChangePointCrossing]:
        """Those of all groups. A sign is turned only as far as the mechanism comes, which other groups decide as
        well: with what bars its way it is sought again."""
        for _ in range(ROUNDS):
            found = self._found()
            if not self.flipping or not self.positions.closed:
                break
            barred = self._barred(found)
            if np.array_equal(barred, self.barred):
                break
            self.barred = barred
        return found

    def _barred(self, found: Sequence[ChangePointCrossing]) -> Floats:
        """Places that cannot be assembled, or cannot be passed."""
        (codes,) = self._evaluate(("outcome",))
        gaps = [*found, *self._stretches()]
        return np.append(np.flatnonzero(~(codes <= 0.0)), [p.place for p in gaps if p.barred])

    def _found(self) -> list[ChangePointCrossing]:
        self.solver, self.passing, self.flipping = self.base, [], {}
        groups = modal(self.base.motion)
        names = tuple(name for group in groups for name in measures(self.base.motion, group))
        if not names:
            return self._poles()
        rows = dict(zip(names, self._evaluate(names), strict=True))
        blocked = np.zeros(self.positions.count, dtype=bool)
        for group in groups:
            blocked = blocked | ~(rows[row_name("quality", group)] > -TOUCH)
            new = [replace(p, flips=self._flips(p, blocked)) for p in self._of_group(group, rows)]
            self.passing += new
            if touching := [p for p in new if p.touches]:
                self.flipping[group] = touching
                many = len(self.flipping) >= MANY
                self.solver = self.base.with_flips(groups if many else self.flipping)
                rows = dict(zip(names, self._evaluate(names), strict=True))
        return self.passing + self._poles()

    def found_between(self) -> list[ChangePointCrossing]:
        """Passages by the numbers of positions of which each step was divided, with stretches out of reach."""
        parts = self.parts
        found = [self._undivided(p) for p in [*self.found(), *self._stretches()]]
        return sorted(
            (replace(p, flips=(p.flips[0] / parts, p.flips[1] / parts)) for p in found), key=lambda p: p.place
        )

    def _undivided(self, p: ChangePointCrossing) -> ChangePointCrossing:
        n = -(-self.positions.count // self.parts)
        place = p.place / self.parts
        before = min(max(int(np.ceil(place)) - 1, 0), n - 1)
        return replace(p, before=before, after=(before + 1) % n, share=place - before)

    def _stretches(self) -> list[ChangePointCrossing]:
        """Where a dyad cannot be assembled though it can at both adjacent positions."""
        (codes,) = self._evaluate(("outcome",))
        asked = codes[:: self.parts] == 0.0
        groups = list(self.base.motion.placed.values())
        found = []
        for i in np.flatnonzero(asked & np.roll(asked, -1)):  # of an open way nothing lies behind the last
            inner = codes[i * self.parts + 1 : (i + 1) * self.parts]
            for k in np.flatnonzero(inner > 0.0)[:1]:
                group = groups[int(inner[k]) - 1]
                if group.dyad is not None:
                    before = float(i * self.parts + k)
                    place = edge(self._assembled, before, before + 1.0)[0]
                    found.append(self._change_point(group.group.name, place, 0.0, "gap"))
        return found

    def _assembled(self, places: Floats) -> Flags:
        return np.asarray(self._evaluate(("outcome",), places)[0] <= 0.0)

    def _poles(self) -> list[ChangePointCrossing]:
        """Where two guides of a group become parallel, and what slides on them goes through infinity."""
        placed = self.base.motion.placed
        slides = {
            name: tuple(row_name("displacement", step.joint) for step in p.group.unknowns)
            for name, p in placed.items()
            if "sine" in p.facts
        }
        if not slides:
            return []
        names = tuple(row_name("fact", name, on="sine") for name in slides)
        size, found = self.base.mechanism.size, []
        for (group, displacements), name, row in zip(slides.items(), names, self._evaluate(names), strict=True):
            for place in self._crossings(name, row):
                around = self._evaluate(displacements, np.array([place - 1e-6, place + 1e-6]))
                if not (np.abs(np.diff(around)) < size).all():
                    found.append(self._change_point(group, place, 0.0, "pole"))
        return found

    def _crossings(self, name: str, row: Floats) -> list[float]:
        """Places where a sine changes its sign, between two positions or, going and coming back, next to one."""
        sign = np.where(np.isfinite(row), np.where(row < 0.0, -1.0, 1.0), 0.0)
        ring = np.append(sign, sign[:1]) if self.positions.closed else sign
        change = np.flatnonzero(ring[:-1] * ring[1:] < 0.0)
        places = [self._crossing(name, float(i), i + 1.0) for i in change]
        within = [
            (low, high)
            for low, high in self._valleys(np.abs(row), NEAR**0.5)
            if not np.isin(np.arange(low, high) % len(row), change).any()
        ]
        signs = np.array([sign[int(low) % len(row)] for low, _ in within])
        for (low, high), (place, smallest) in zip(within, self._lowest(name, within, signs), strict=True):
            if smallest < 0.0:
                places += [self._crossing(name, low, place), self._crossing(name, place, high)]
        return sorted(places)

    def _crossing(self, name: str, low: float, high: float) -> float:
        """The place between two where a value changes its sign."""
        start = np.array([low])
        first = np.sign(self._evaluate((name,), start)[0])
        before = ends(lambda place: np.sign(self._evaluate((name,), place)[0]) == first, start, np.array([high]))
        return float(before[0])

    def _flips(self, p: ChangePointCrossing, blocked: Flags) -> tuple[float, float]:
        """From there on; in a closed cycle that cannot be passed, backwards from its first position."""
        bars = np.append(np.flatnonzero(blocked), self.barred)
        if not self.positions.closed or not len(bars):
            return p.place, np.inf
        first, last = float(bars.min()), float(bars.max())
        return (p.place, first) if p.place < first else (min(last, p.place), p.place)

    def _of_group(self, group: str, rows: Mapping[str, Floats]) -> list[ChangePointCrossing]:
        found = []
        quality, *distance = measures(self.base.motion, group)
        for place, smallest in self._lowest(quality, self._valleys(rows[quality], NEAR)):
            if abs(smallest) <= TOUCH:
                kind: Kind = "end" if group in self.beneath else "change"
                found.append(self._change_point(group, self._centred(quality, place), smallest, kind))
            elif smallest < 0:
                found.append(self._change_point(group, place, smallest, "gap"))
        for name in distance:
            largest = float(np.nanmax(rows[name], initial=0.0))
            near = rows[name] < NEAR * largest
            valleys = self._valleys(rows[name], NEAR * largest) if near.any() else []
            for place, smallest in self._lowest(name, valleys):
                at, *around = self._evaluate((quality,), place + np.array([0.0, -1e-3, 1e-3]))[0]
                if at < -TOUCH and self._alone(place, rows[quality], found):
                    found.append(self._change_point(group, place, float(at), "gap"))
                elif smallest <= MEETING * largest and min(around) > TOUCH:
                    kind = "end" if group in self.beneath else "meeting"
                    found.append(self._change_point(group, place, float(min(around)), kind))
        return sorted(found, key=lambda p: p.place)

    def _alone(self, place: float, quality: Floats, found: Sequence[ChangePointCrossing]) -> bool:
        """Whether a gap lies between two positions that can be assembled, and is not found yet."""
        ends = np.array([np.floor(place), np.ceil(place)], dtype=int) % len(quality)
        known = any(p.barred and abs(p.place - place) < 1.0 for p in found)
        return bool((quality[ends] > -TOUCH).all()) and not known

    def _valleys(self, row: Floats, near: float) -> list[tuple[float, float]]:
        """Stretches around a position with a small, locally smallest value."""
        closed, infinite = self.positions.closed, np.array([np.inf])
        left = np.concatenate([row[-1:] if closed else infinite, row[:-1]])
        right = np.concatenate([row[1:], row[:1] if closed else infinite])
        with np.errstate(invalid="ignore"):
            rises = [np.where(np.isfinite(side), side - row, 0.0) for side in (left, right)]
        small = (row > -TOUCH) & (row < np.maximum(near, np.maximum(*rises)))
        lowest = small & ~(left < row) & ~(right <= row)
        first, last = self.ends
        return [(max(i - 1.0, first), min(i + 1.0, last)) for i in np.flatnonzero(lowest)]

    def _lowest(
        self, name: str, stretches: Sequence[tuple[float, float]], signs: Floats | None = None
    ) -> list[tuple[float, float]]:
        """Places and values of the minima in stretches (k), of the value times ``signs`` (k,)."""
        if not stretches:
            return []
        factor = np.ones(len(stretches)) if signs is None else signs
        low, high = np.array(stretches).T

        def values(places: Floats) -> Floats:
            return np.asarray(factor[:, None] * self._evaluate((name,), places.ravel())[0].reshape(places.shape))

        return list(zip(*(row.tolist() for row in lowest(values, low, high)), strict=True))

    def _centred(self, name: str, place: float) -> float:
        """The zero of the root (which passes through zero in a straight line) from its values on both sides."""
        first, last = self.ends
        for h in (1e-2, 1e-3):
            if first + h <= place <= last - h:
                a, b = np.sqrt(np.maximum(self._evaluate((name,), np.array([place - h, place + h]))[0], 0.0))
                place += float(h * (a - b) / (a + b)) if a + b > 0 else 0.0
        return place

    def _change_point(self, group: str, place: float, quality: float, kind: Kind) -> ChangePointCrossing:
        n = self.positions.count
        if abs(place - round(place)) < ON_IT:
            place = float(round(place))
        if self.positions.closed and place <= 0.0:
            place += n
        before = min(max(int(np.ceil(place)) - 1, 0), n - 1)
        return ChangePointCrossing(group, before, (before + 1) % n, place - before, quality, kind, self._input(place))

    def _input(self, place: float) -> float:
        """The first driver's coordinate at a place."""
        n = self.positions.count
        turn = np.array([place % n if self.positions.closed else place])
        return float(next(iter(self.way(turn).coordinates.values()))[0][0])

    def _evaluate(self, names: tuple[str, ...], places: Floats | None = None) -> Floats:
        """Outputs (names, m) at places (m,), or at all positions."""
        n = self.positions.count
        at = np.arange(float(n)) if places is None else places
        turn = at % n if self.positions.closed else np.clip(at, *self.ends)
        positions = self.positions if places is None else self.way(turn)
        states: Mapping[str, Floats] = {}
        if self.tracked is not None:
            q = np.stack([row[0] for row in positions.coordinates.values()], axis=1)
            states = self.tracked.states if places is None else self.tracked.between(turn, q)
        modes = mode_inputs({group: self._signs(group, turn) for group in self.solver.manner.flipping})
        return self.solver.evaluate(names, positions, states, modes)

    def _signs(self, group: str, place: Floats) -> Floats:
        return _sign(self.flipping.get(group, ()), group, self.base.assembly.modes[group], place)


def _beneath_tracked(solver: MotionSolver) -> frozenset[str]:
    """Names of the groups on which groups without closed form hang, and of these."""
    if not solver.motion.next_states:
        return frozenset()
    return frozenset(group.name for group in upstream(solver.structure, solver.mechanism))


def _sign(passing: Sequence[ChangePointCrossing], group: str, mode: float, place: Floats) -> Floats:
    sign = np.full(len(place), mode)
    for p in passing:
        if p.group == group and p.touches and p.place > 0.0:
            sign = np.where((place > p.flips[0]) & (place < p.flips[1]), -sign, sign)
    return sign


def signs(
    passing: Sequence[ChangePointCrossing], modes: Mapping[str, float], place: Floats | int
) -> dict[str, Floats]:
    """Sign of every flipping group's mode at places (or a count of positions), the first one as the file says."""
    groups = dict.fromkeys(p.group for p in passing if p.touches)
    place = np.arange(float(place)) if isinstance(place, int) else place
    return mode_inputs({group: _sign(passing, group, modes[group], place) for group in groups})


def closes(passing: Sequence[ChangePointCrossing]) -> bool:
    """Whether every group is back in its first mode at the end of a closed cycle."""
    groups = [p.group for p in passing if p.touches and p.flips[1] == np.inf]
    return all(groups.count(group) % 2 == 0 for group in groups)


def cut_off(codes: Floats, positions: Positions, breaks: Set[int] = frozenset()) -> Floats:
    """1 for solved positions that cannot be reached from the first solved one, because a gap or positions out of
    reach lie in between, else 0; (n,). ``codes`` are the outcomes of the positions.

    ``breaks``: positions after which there is no way to the next one. A closed cycle is tracked backwards from its
    first position as well.
    """
    n, good = len(codes), codes == 0
    if not positions.is_way or not good.any():
        return np.zeros(n)
    open_way = codes <= 0
    if open_way.all() and not breaks:
        return np.zeros(n)
    first = int(np.flatnonzero(good)[0])
    reached = np.zeros(n, dtype=bool)
    for step in (1, -1):
        here = first
        while open_way[here] and not (reached[here] and here != first):
            reached[here] = True
            there = here + step
            edge = here if step > 0 else there
            if not positions.closed and not 0 <= there < n:
                break
            here = there % n
            if edge % n in breaks:
                break
    return np.where(good & ~reached, 1.0, 0.0)


def mark_singular(codes: Floats, passing: Sequence[ChangePointCrossing], structure: Structure) -> None:
    """Makes the outcome of positions at which a group's modes or outer pins meet singular, in place."""
    numbers = {group.name: number for number, group in enumerate(structure.groups, 1)}
    for p in passing:
        if p.singular and p.place.is_integer():
            codes[int(p.place) % len(codes)] = -numbers[p.group]
