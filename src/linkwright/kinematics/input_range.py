"""The range of a driver that cannot turn fully: tracked from the start in both directions, both ends refined."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from linkwright.core.arguments import require
from linkwright.core.arrays import Floats
from linkwright.core.inputs import mode_groups
from linkwright.core.outputs import row_name
from linkwright.core.quantity import shown
from linkwright.core.search import edge
from linkwright.elements import Group
from linkwright.errors import LinkwrightError, RequestError
from linkwright.kinematics.branch import FLOOR, Branch
from linkwright.kinematics.change_points import crossings, mark_singular, signs
from linkwright.kinematics.cycle import time_span
from linkwright.kinematics.passing import modal
from linkwright.kinematics.positions import CycleError, Positions, at_times
from linkwright.kinematics.rank_of_motion import fold
from linkwright.kinematics.solve import MotionRun
from linkwright.kinematics.solver import MotionSolver
from linkwright.mechanism.mechanism import Mechanism
from linkwright.registry import no_such
from linkwright.words import _, pgettext

#: Step of the search: of a turning driver in rad, of a sliding one as share of the mechanism's size; how far a
#: sliding one is tracked, in sizes.
STEP = math.radians(1.0)
SLIDE_STEP = 1.0 / 100
FARTHEST = 20.0
#: How near (rad, or share of the size) an end is known before its reason is asked for, and before Newton's method.
COARSE = 1e-6
#: What the search leaves: where a square comes to zero, and where continuation stalls near a singular Jacobian.
ROUNDED = 4e-16
CONTINUED = 1e-9
#: How exactly a change point is known, rad or share of the size, and how much less for every unit of the sine (root
#: of the quality) that lengths with roundings leave there.
CHANGED, TOUCHED = 1e-8, 10.0
#: How far before an end Newton's method for it begins, rad or share of the size.
AHEAD = 1e-5


_WAYS = {"low": _("from {low}"), "high": _("to {high}"), "low_high": pgettext("range", "from {low} to {high}")}


@dataclass(frozen=True)
class RangeEnd:
    """One end of a range: ``value`` rad or m; the ``group`` that stops there and ``how`` (``stretched``, …).

    ``precision``: bound of the error of ``value`` that the search left, rad or m.
    """

    value: float
    group: str
    how: str
    precision: float


@dataclass(frozen=True)
class InputRange:
    """Where a driver can go from the starting position without dismantling.

    ``full``: a turning driver turns fully (a sliding one goes at least 20 times the mechanism's size); ``start``
    and ``end`` are then None where no end was found. Angles in rad, displacements in m.
    """

    driver: str
    link: str
    rotary: bool
    low: RangeEnd | None
    high: RangeEnd | None

    @property
    def full(self) -> bool:
        """Whether the driver finds no end."""
        return self.low is None and self.high is None

    @property
    def start(self) -> float | None:
        """The smaller end, rad or m."""
        return None if self.low is None else self.low.value

    @property
    def end(self) -> float | None:
        """The larger end, rad or m."""
        return None if self.high is None else self.high.value

    def explain(self) -> str:
        """The range in a sentence."""
        if self.full:
            full = _("the {link} can turn fully") if self.rotary else _("the {link} can slide without finding an end")
            return full.format(link=self.link)
        ends = {
            side: shown(end.value, "angle" if self.rotary else "length", 7)
            for side, end in (("low", self.low), ("high", self.high))
            if end is not None
        }
        way = _WAYS["_".join(ends)].format(**ends)
        moves = _("the {link} can turn {way}; {ends}") if self.rotary else _("the {link} can slide {way}; {ends}")
        return moves.format(link=self.link, way=way, ends=self._ends())

    def _ends(self) -> str | tuple[str, ...]:
        low, high = self.low, self.high
        if low is not None and high is not None and (low.group, low.how) == (high.group, high.how):
            return _("at both ends {group} {how}", group=low.group, how=low.how)
        return tuple(
            _(
                "at {place} {group} {how}",
                place=shown(end.value, "angle" if self.rotary else "length", 7),
                group=end.group,
                how=end.how,
            )
            for end in (low, high)
            if end is not None
        )


def input_range(mechanism: Mechanism, driver: str | None = None) -> InputRange:
    """The range of a driver's coordinate that can be reached from the starting position on the same circuit.

    The other drivers stay at their starting coordinates. Where a dyad limits, the end is the zero of the square
    under its root, to rounding; where a group without closed form limits, the point at which the Jacobian of
    all joints and drivers becomes singular (a fold), to rounding as well if Newton's method finds it, else as
    far as continuation goes; ``RangeEnd.precision`` says which.

    Raises:
        LinkwrightError: no such driver, or the mechanism cannot be assembled at any starting coordinate.
        StructureError, AssemblyError: the model is not determined or cannot be put together.
    """
    require(mechanism, Mechanism)
    name = driver or next(iter(mechanism.drivers), None)
    if name is None or name not in mechanism.drivers:
        if not driver:
            raise RequestError(_("{name!r} has no driver", code="range.no_driver", name=mechanism.name))
        raise RequestError(no_such(_("driver"), driver, mechanism.drivers))
    search = _Search(mechanism, name)
    high = search.end(1.0)
    low = search.end(-1.0) if high is not None or not search.rotary else None
    return InputRange(name, mechanism.drivers[name].link, search.rotary, low, high)


@dataclass(frozen=True)
class _Stop:
    """Between the coordinates ``good`` and ``bad``; coordinates of the tracked groups (n,), signs of modes at
    ``good``.

    ``group``: the one that becomes singular at ``good``, where that is known; ``change``: the one whose change point
    ``bad`` is, beneath a group without closed form, with its quality there.
    """

    good: float
    bad: float
    modes: Mapping[str, float]
    unknowns: Floats | None = None
    group: str | None = None
    change: str | None = None
    quality: float = 0.0


class _Search:
    def __init__(self, mechanism: Mechanism, driver: str) -> None:
        self.mechanism = mechanism
        self.driver = driver
        self.solver = MotionSolver(mechanism)
        self.base = self._at_start()
        self.rotary = self.base.rotary[driver]
        self.size = mechanism.size
        self.modal = modal(self.solver.motion)
        self.begin = self._beginning()

    # where to begin -------------------------------------------------------------------------------
    def _at_start(self) -> Positions:
        try:
            begin = time_span(self.mechanism)[0]
        except CycleError:
            begin = 0.0
        return at_times(self.mechanism, [begin])

    def positions(self, q: Floats) -> Positions:
        """Positions with the driver at ``q`` and the others at their start."""
        none = np.zeros(len(q))
        rows = {
            name: (q if name == self.driver else np.full(len(q), row[0][0]), none, none)
            for name, row in self.base.coordinates.items()
        }
        return Positions(none, rows, self.base.rotary)

    def _beginning(self) -> float:
        nominal = float(self.base.coordinates[self.driver][0][0])
        drawn = self.solver.assembly.inputs[self.driver]
        near = np.arange(0.0, np.pi, STEP) if self.rotary else np.arange(0.0, 1.0, SLIDE_STEP) * self.size
        tries = [np.array([nominal]), np.array([drawn])]
        if not self.solver.motion.next_states:
            tries.append(np.stack([nominal + near, nominal - near], axis=1).ravel())
        for q in tries:
            positions = self.positions(q)
            tracked = self.solver.track(positions, separate=True)
            states = {} if tracked is None else tracked.states
            codes = self.solver.evaluate(("outcome",), positions, states, {})[0]
            good = np.flatnonzero((codes == 0) & _finite(states, len(q)))
            if len(good):
                return float(q[good[0]])
        raise LinkwrightError(
            _(
                "{name!r} cannot be assembled at any coordinate of driver {driver!r} near {place}, "
                "so it has no range; check the dimensions",
                code="range.not_assembled",
                name=self.mechanism.name,
                driver=self.driver,
                place=shown(nominal, "angle" if self.rotary else "length", 7),
            )
        )

    # one direction --------------------------------------------------------------------------------
    def end(self, direction: float) -> RangeEnd | None:
        """The end in one direction; None if there is none."""
        stop = self._stop(direction)
        if stop is None:
            return None
        unit = 1.0 if self.rotary else self.size
        change, place = stop.change, stop.bad
        stop = self._to_singular(stop)
        reached = stop.good if stop.group else stop.bad
        if change and stop.group in (None, change) and abs(reached - place) < AHEAD * unit:
            group = next(each for each in self.solver.structure.groups if each.name == change)
            precision = (CHANGED + TOUCHED * math.sqrt(abs(stop.quality))) * unit
            return _range_end(
                place,
                group,
                _(
                    "has a change point, through which the groups without closed form cannot be tracked",
                    code="range.change",
                ),
                precision,
            )
        rough = COARSE * unit
        good, bad = (stop.good, stop.bad) if stop.group else self._narrowed(stop, rough)
        group, how = self._reason(stop, good, bad)
        known = None
        if stop.unknowns is not None:
            way = self._towards(stop, good - direction * AHEAD * unit)
            known = fold(MotionRun(self.solver, self.positions(way)).solve("mark"), self.driver)
        if known is not None and min(good, bad) - rough <= known[0] <= max(good, bad) + rough:
            value, precision = known
        elif stop.group:
            value, precision = good, 2.0 * FLOOR * unit
        else:
            good, bad = self._narrowed(replace(stop, good=good, bad=bad, unknowns=self._unknowns(stop, good)), 0.0)
            rounding = ROUNDED if stop.unknowns is None else CONTINUED
            value, precision = good, abs(bad - good) + rounding * (1.0 + abs(good))
        return _range_end(value, group, how, precision)

    def _to_singular(self, stop: _Stop) -> _Stop:
        """Where a tracked group becomes singular before ``bad``: there, unless a dyad ends before."""
        if stop.unknowns is None:
            return stop
        branch = self._branch(stop, stop.bad)
        if branch.complete:
            return stop
        reached = stop.good + branch.reached * (stop.bad - stop.good)
        places = stop.good + np.array([end.x for _unused, end in branch.steps]) * (stop.bad - stop.good)
        fine = self._fine(stop, places)
        if not fine.all():
            return replace(stop, bad=float(places[np.argmin(fine)]))
        beyond = reached + math.copysign(2.0 * FLOOR * (1.0 if self.rotary else self.size), stop.bad - stop.good)
        group = self.solver.tracker().weakest_group(branch)
        return replace(stop, good=reached, bad=beyond, unknowns=branch.last, group=group)

    def _stop(self, direction: float) -> _Stop | None:
        step, span = (STEP, 2 * np.pi) if self.rotary else (SLIDE_STEP * self.size, FARTHEST * self.size)
        q = self.begin + direction * step * np.arange(round(span / step) + 1.0)
        positions = self.positions(q)
        tracked = self.solver.track(positions)
        states = {} if tracked is None else tracked.states
        found = crossings(self.solver, positions, tracked)
        modes = signs(found, self.solver.assembly.modes, len(q))
        codes = self._solver(modes).evaluate(("outcome",), positions, states, modes)[0]
        mark_singular(codes, found, self.solver.structure)
        fine = (codes <= 0) & _finite(states, len(q))
        last = int(np.argmin(fine)) - 1 if not fine.all() else len(q) - 1
        bad = q[last + 1] if last < len(q) - 1 else None
        change, quality = None, 0.0
        for p in found:
            place = float(np.interp(p.place, np.arange(len(q)), q))
            way = abs(place - self.begin)
            if not p.touches and p.before <= last and (bad is None or way <= abs(bad - self.begin)):
                last, bad = p.before, place
                change, quality = (p.group, p.quality) if p.kind == "end" else (None, 0.0)
        if bad is None:
            return None
        unknowns = None if tracked is None else tracked.coordinates[last]
        signs_there = {name: float(row[last]) for name, row in modes.items()}
        return _Stop(float(q[last]), float(bad), signs_there, unknowns, change=change, quality=quality)

    def _solver(self, modes: Mapping[str, object]) -> MotionSolver:
        return self.solver.with_flips(mode_groups(modes)) if modes else self.solver

    def _sines(self, positions: Positions, states: Mapping[str, Floats]) -> Floats:
        """Sines between guides of groups with one mode, positive as at the beginning; (groups, n)."""
        names = self._guided()
        if not names:
            return np.ones((1, positions.count))
        rows = self.solver.evaluate(names, positions, states, {})
        return np.asarray(rows * self._first_sines)

    @cached_property
    def _first_sines(self) -> Floats:
        """Signs of these sines where the search begins, (groups, 1)."""
        names = self._guided()
        first = self.positions(np.array([self.begin]))
        return np.sign(self.solver.evaluate(names, first, self.solver.states(first), {}))

    def _guides(self) -> list[str]:
        """Groups whose mode is the sense of the angle between two guides."""
        return [name for name, group in self.solver.motion.placed.items() if "sine" in group.facts]

    def _guided(self) -> tuple[str, ...]:
        return tuple(row_name("fact", name, on="sine") for name in self._guides())

    # refinement -----------------------------------------------------------------------------------
    def _narrowed(self, stop: _Stop, distance: float) -> tuple[float, float]:
        """The last coordinate that can be assembled and the first that cannot, next to each other, or within a
        distance."""
        parts = 16 if stop.unknowns is None else 2
        return edge(lambda q: self._fine(stop, q), stop.good, stop.bad, distance, parts)

    def _fine(self, stop: _Stop, q: Floats) -> np.ndarray[tuple[int], np.dtype[np.bool_]]:
        positions = self.positions(q)
        states = self._states(stop, q)
        solver, modes = self._solver(stop.modes), {n: np.full(len(q), v) for n, v in stop.modes.items()}
        fine = _finite(states, len(q)) & (self._sines(positions, states) > 0).all(axis=0)
        if self.modal:
            names = tuple(row_name("quality", name) for name in self.modal)
            fine &= (solver.evaluate(names, positions, states, modes) > 0).all(axis=0)
        return np.asarray(fine)

    def _states(self, stop: _Stop, q: Floats) -> dict[str, Floats]:
        if stop.unknowns is None:
            return {}
        tracker = self.solver.tracker()
        branches = [self._branch(stop, float(there)) for there in q]
        none = np.full(len(stop.unknowns), np.nan)
        rows = [b.last if b.complete and b.last is not None else none for b in branches]
        return tracker.states(np.array(rows))

    def _branch(self, stop: _Stop, there: float) -> Branch:
        assert stop.unknowns is not None
        rows = self.positions(np.array([stop.good, there])).coordinates
        ends = np.stack([row[0] for row in rows.values()], axis=1)
        return self.solver.tracker().between(ends[0], ends[1], stop.unknowns)

    def _towards(self, stop: _Stop, end: float) -> Floats:
        """The way from the beginning to an end where change points are passed; else the end alone."""
        if not stop.modes:
            return np.array([end])
        count = 2 + round(abs(end - self.begin) / (STEP if self.rotary else SLIDE_STEP * self.size))
        return np.linspace(self.begin, end, count)

    def _unknowns(self, stop: _Stop, q: float) -> Floats | None:
        return None if stop.unknowns is None else self._branch(stop, q).last

    # why --------------------------------------------------------------------------------------------
    def _reason(self, stop: _Stop, good: float, bad: float) -> tuple[Group, str]:
        """The group that stops, and what is the matter with it."""
        groups = {group.name: group for group in self.solver.structure.groups}
        ends = self.positions(np.array([good, bad]))
        states = self._states(stop, np.array([good, bad]))
        solver, modes = self._solver(stop.modes), {n: np.full(2, v) for n, v in stop.modes.items()}
        placed = solver.motion.placed
        modal = [name for name, p in placed.items() if p.dyad is not None]
        quality = solver.evaluate(tuple(row_name("quality", name) for name in modal), ends, states, modes)
        left = self._sines(ends, states)[:, 1] > 0
        gone = {name for name, fine in zip(self._guides(), left, strict=False) if not fine}
        gone |= {name for name, row in zip(modal, quality, strict=True) if not row[1] > 0}
        qualities = {name: row[0] for name, row in zip(modal, quality, strict=True)}
        first = next((name for name in modal if name in gone), None)
        stuck = stop.group or first or min(qualities, key=qualities.__getitem__, default="")
        stuck = stuck or solver.tracker().groups.formula.groups[-1].name
        explain_end = getattr(placed[stuck].dyad, "at_end", None)
        if explain_end is None:
            return groups[stuck], _("is singular", code="range.singular")
        facts = tuple(placed[stuck].facts)
        row = solver.evaluate(tuple(row_name("fact", stuck, on=fact) for fact in facts), ends, states, modes)[:, 0]
        return groups[stuck], explain_end(dict(zip(facts, map(float, row), strict=True)))


def _range_end(value: float, group: Group, how: str, precision: float) -> RangeEnd:
    label = _("group {signature} ({links})", signature=group.signature, links=tuple(group.links))
    return RangeEnd(value, label, how, precision)


def _finite(states: Mapping[str, Floats], count: int) -> np.ndarray[tuple[int], np.dtype[np.bool_]]:
    fine = np.ones(count, dtype=bool)
    for row in states.values():
        fine &= np.isfinite(row)
    return fine
