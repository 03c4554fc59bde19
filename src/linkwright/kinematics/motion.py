"""The result of a motion analysis: arrays by the names of points, links and joints."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any, ClassVar, TypeVar

import numpy as np

from linkwright.core.arrays import Floats, Indices
from linkwright.core.attached import PlotMixin, attached
from linkwright.core.data import FrozenDict, locked
from linkwright.core.outputs import KINDS, NAMED, SLIDE, Output, row_name
from linkwright.errors import LinkwrightError, RequestError
from linkwright.kinematics.dimensions import Design, moving, pace_name
from linkwright.kinematics.names import point_key
from linkwright.kinematics.positions import Positions
from linkwright.kinematics.solver import MotionSolver
from linkwright.mechanism.mechanism import Mechanism
from linkwright.registry import offered
from linkwright.topology import Structure
from linkwright.words import _
from linkwright.words.message import in_language

if TYPE_CHECKING:
    import pandas

    from linkwright.kinematics.tracked_branch import TrackedBranch


Evaluate = Callable[[tuple[str, ...]], Floats]


TURN = 2.0 * np.pi
Found = TypeVar("Found")


class Rows:
    """``values`` (outputs, n) with the row number of every name in ``index``; ``extra`` rows by name."""

    __slots__ = ("extra", "index", "values")

    def __init__(self, values: Floats, index: Mapping[str, int]) -> None:
        self.values = locked(values)
        self.index = index
        self.extra: dict[str, Floats] = {}

    def taken(self, order: Indices) -> Rows:
        """The rows at some positions, in another order."""
        found = Rows(self.values[:, order], self.index)
        found.extra.update((name, locked(row[order])) for name, row in self.extra.items())
        return found

    def row(self, name: str, evaluate: Evaluate) -> Floats:
        """The row of an output, (n,); ``evaluate`` supplies one that is not stored."""
        place = self.index.get(name)
        return self.fetch((name,), evaluate)[0] if place is None else self.values[place]

    def pair(self, name: str, evaluate: Evaluate) -> Floats:
        """The two components of a vector output, (n, 2); a view of the stored rows where they lie together."""
        x, y = f"{name}.x", f"{name}.y"
        first = self.index.get(x)
        if first is not None and self.index.get(y) == first + 1:
            return self.values[first : first + 2].T
        return locked(np.stack(self.fetch((x, y), evaluate), axis=1))

    def fetch(self, names: tuple[str, ...], evaluate: Evaluate) -> list[Floats]:
        """The rows of some outputs, (n,) each; ``evaluate`` supplies those that are not stored."""
        index, extra = self.index, self.extra
        missing = [name for name in names if name not in index and name not in extra]
        if missing:
            extra.update(zip(missing, map(locked, evaluate(tuple(missing))), strict=True))
        return [self.values[index[name]] if name in index else extra[name] for name in names]


class PointMotion:
    """Motion of a point in frame axes, arrays (n, 2)."""

    def __init__(self, motion: Motion, name: str) -> None:
        self._motion = motion
        self.name = name

    @property
    def position(self) -> Floats:
        """(n, 2) m."""
        return self._motion.vector("position", self.name)

    @property
    def velocity(self) -> Floats:
        """(n, 2) m/s."""
        return self._motion.vector("velocity", self.name)

    @property
    def acceleration(self) -> Floats:
        """(n, 2) m/s²."""
        return self._motion.vector("acceleration", self.name)


@dataclass(frozen=True)
class JointMotion:
    """Coordinate of a joint with its rates, arrays (n,): m for a guide, rad for a pin."""

    name: str
    displacement: Floats
    velocity: Floats
    acceleration: Floats


class LinkMotion:
    """Motion of a link: angle of its x axis (rad, continuous over the positions), its rates, its direction."""

    def __init__(self, motion: Motion, name: str) -> None:
        self._motion = motion
        self.name = name

    @property
    def direction(self) -> Floats:
        """Unit vector of the link's x axis, (n, 2)."""
        if self.name == "frame":
            return np.tile([1.0, 0.0], (self._motion.steps, 1))
        return self._motion.vector("direction", self.name)

    @property
    def angle(self) -> Floats:
        """Angle of the link's x axis against the frame's, (n,) rad, counter-clockwise positive.

        Continuous over positions that can be reached, in the order of time, and of driven links also over positions
        that are far from each other; the first lies in (-π, π].
        """
        return self._motion.cached(("angle", self.name), self._angle)

    @property
    def counted(self) -> bool:
        """Whether its turns are known from those of the drivers, however far it turns from position to position."""
        angles, drivers = self._motion.solver.motion.angles, self._motion.mechanism.drivers.values()
        steady = all(driver.law.constant_speed is not None for driver in drivers)
        return angles.counts(self.name) if steady else angles.follows(self.name)

    @property
    def turns_before(self) -> float:
        """Full turns, rad, of a link whose turns are known, that ``angle`` leaves out so that its first one lies in
        (-π, π]."""
        turned = self._motion.row("turned_angle", self.name)
        known = turned[np.isfinite(turned)]
        return TURN * float(np.ceil(known[0] / TURN - 0.5)) if len(known) else 0.0

    def _angle(self) -> Floats:
        separate = not self._motion.positions.is_way
        if self.counted or (separate and self._motion.solver.motion.angles.follows(self.name)):
            return locked(self._motion.row("turned_angle", self.name) - self.turns_before)
        raw = np.arctan2(self.direction[:, 1], self.direction[:, 0])
        order = self._motion.order
        good = np.flatnonzero(np.isfinite(raw)) if order is None else order[np.isfinite(raw[order])]
        raw[good] = _unwrapped(raw[good])
        if order is not None and len(good):
            raw -= TURN * np.ceil(raw[good.min()] / TURN - 0.5)
        return locked(raw)

    @property
    def angular_velocity(self) -> Floats:
        """(n,) rad/s."""
        return self._motion.row("angular_velocity", self.name)

    @property
    def angular_acceleration(self) -> Floats:
        """(n,) rad/s²."""
        return self._motion.row("angular_acceleration", self.name)

    @property
    def centre(self) -> PointMotion:
        """Motion of the mass centre."""
        return self._motion.point_of(f"{self.name}.@centre")


@dataclass(eq=False)
class Motion(PlotMixin):
    """Positions, velocities and accelerations of a mechanism at n positions.

    ``point("C")``, ``link("jaw")``, ``joint("guide")`` give the arrays; ``outcomes`` one sentence per position.
    Where a position cannot be reached the arrays hold NaN (only if marked outcomes were asked for). ``breaks``:
    positions between which and the next ones something cannot be passed.
    """

    #: Whether drivers' laws say its positions, so that others between them can be solved.
    by_law: ClassVar[bool] = True
    solver: MotionSolver
    design: Design
    positions: Positions
    rows: Rows
    states: Mapping[str, Floats] = field(default_factory=dict)
    modes: Mapping[str, Floats] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
    barred: Floats | None = None
    tracked: TrackedBranch | None = None
    breaks: frozenset[int] = frozenset()
    _cache: dict[Hashable, Any] = field(default_factory=dict, init=False, repr=False)

    @property
    def mechanism(self) -> Mechanism:
        """What was solved."""
        return self.design.mechanism

    @property
    def structure(self) -> Structure:
        """Its Assur groups."""
        return self.solver.structure

    @property
    def steps(self) -> int:
        """Number of positions n."""
        return self.positions.count

    @cached_property
    def time(self) -> Floats:
        """Times of the positions, (n,) s."""
        return locked(self.positions.time)

    @cached_property
    def inputs(self) -> dict[str, Floats]:
        """Coordinates of the drivers by name, (n,) rad or m."""
        return FrozenDict({name: locked(rows[0]) for name, rows in self.positions.coordinates.items()})

    @property
    def input(self) -> Floats:
        """Coordinate of the first driver, (n,) rad or m."""
        if not self.inputs:
            raise RequestError(
                _("{name!r} has no driver, so it has no input", code="motion.no_input", name=self.mechanism.name)
            )
        return next(iter(self.inputs.values()))

    @cached_property
    def order(self) -> Indices | None:
        """The positions by their times, (n,), where inputs were asked for in no order; None where they follow each
        other one way."""
        ways = np.diff(self.positions.time)
        if not ((ways > 0.0).any() and (ways < 0.0).any()):
            return None
        return np.argsort(self.positions.time, kind="stable")

    def in_order(self) -> Motion:
        """The same positions one after the other, as everything needs that lies between two of them."""
        order = self.order
        return self if order is None else self.cached("in order", lambda: self._taken(order))

    def _taken(self, order: Indices) -> Motion:
        return Motion(
            self.solver,
            self.design,
            self.positions.taken(order),
            self.rows.taken(order),
            {name: row[order] for name, row in self.states.items()},
            {name: row[order] for name, row in self.modes.items()},
            self.notes,
            None if self.barred is None else self.barred[order],
            None if self.tracked is None else self.tracked.taken(order),
        )

    @property
    def outcome_codes(self) -> Floats:
        """0 for a solved position, else the number (from 1) of the failing group, negative if singular, (n,)."""
        return self.rows.row("outcome", self.evaluate)

    @cached_property
    def ok(self) -> np.ndarray[Any, np.dtype[np.bool_]]:
        """Which positions are solved, (n,)."""
        good: np.ndarray[Any, np.dtype[np.bool_]] = self.outcome_codes == 0
        return locked(good if self.barred is None else good & (self.barred == 0))

    @cached_property
    def complete(self) -> bool:
        """Whether all positions are solved, and the way leads through all of them."""
        return not self.breaks and bool(self.ok.all())

    @cached_property
    @attached
    def outcomes(self) -> list[Outcome]:
        """What became of every position."""
        raise NotImplementedError

    @attached
    def refusal(self) -> PositionError:
        """The error for a motion of which some positions cannot be reached, or that is barred between two of them."""
        raise NotImplementedError

    def point(self, name: str) -> PointMotion:
        """Motion of a point: ``C`` for a pin or a name used once, ``jaw.D`` for a point of one link."""
        return self.point_of(self._point_key(name))

    def link(self, name: str) -> LinkMotion:
        """Motion of a link."""
        if name != "frame" and name not in self.design.base.links:
            self.design.base.link(name)
        return LinkMotion(self, name)

    def cached(self, key: Hashable, find: Callable[[], Found]) -> Found:
        """A result derived from the motion, cached under a key as long as the motion."""
        if key not in self._cache:
            self._cache[key] = find()
        found: Found = self._cache[key]
        return found

    def turning(self, link: str, against: str) -> Floats:
        """Angular velocity of a link against another one, (n,) rad/s, zero at rest."""
        a, b = self.link(against), self.link(link)
        second = b.angular_acceleration - a.angular_acceleration
        return self.moving(b.angular_velocity - a.angular_velocity, second, "angle")

    def moving(self, rate: Floats | float, second: Floats | float, dimension: str) -> Floats:
        """Rates, with their own rates, of an ``angle`` or a ``length``, zero at rest."""
        pace, turning = (self.design.parameters[pace_name(each)] for each in (dimension, "angle"))
        first: Any = rate
        own: Any = second
        return np.asarray(moving(first, own, pace, turning))

    def joint(self, name: str) -> JointMotion:
        """Coordinate of a joint: displacement of a guide's block, or angle of a pin's second link on its first."""
        joint = self.design.base.joints.get(name)
        if joint is not None and joint.coordinate == "slide":
            return JointMotion(name, *(self.row(kind, name) for kind in SLIDE))
        if joint is not None and joint.coordinate == "turn":
            a, b = (self.link(link) for link in joint.joined[:2])
            return JointMotion(
                name,
                locked(b.angle - a.angle),
                locked(b.angular_velocity - a.angular_velocity),
                locked(b.angular_acceleration - a.angular_acceleration),
            )
        hint = offered(name, self.mechanism.joints)
        raise RequestError(
            _(
                "there is no joint {name!r} with a coordinate; {hint}",
                code="motion.no_coordinate",
                name=name,
                hint=hint,
            )
        )

    def reaction_place(self, joint: str) -> Floats:
        """Where the force of a joint is reported, (n, 2) m in frame axes: a pin, a block's point, a pitch point."""
        return self.vector("reaction_place", joint)

    def point_of(self, key: str) -> PointMotion:
        """Motion of a point by its canonical key."""
        return PointMotion(self, key)

    def vector(self, kind: str, key: str) -> Floats:
        """A vector output, (n, 2), by its kind (see ``core.outputs``) and owner."""
        return self.rows.pair(row_name(kind, key), self.evaluate)

    def row(self, kind: str, key: str) -> Floats:
        """A scalar output, (n,)."""
        if key == "frame":
            return np.zeros(self.steps)
        return self.rows.row(row_name(kind, key), self.evaluate)

    def read(self, output: Output) -> Floats:
        """An angle, a displacement, a component of a point's motion, an output that the model names, or a rate of
        these, (n,)."""
        if output.kind in NAMED:
            return self.cached(("named", output.owner), lambda: self._named_course(output.owner))[output.kind]
        if output.kind == "angle":
            return self.link(output.owner).angle
        if KINDS[output.kind].of != "point":
            return self.row(output.kind, output.owner)
        return self.vector(output.kind, self._point_key(output.owner))[:, "xy".index(output.component)]

    @attached
    def _named_course(self, name: str) -> dict[str, Floats]:
        """Value and derivatives by time of an output that the model names, by their kinds, (n,) each."""
        raise NotImplementedError

    def _fetch(self, names: tuple[str, ...]) -> list[Floats]:
        return self.rows.fetch(names, self.evaluate)

    def evaluate_together(self, names: Iterable[str]) -> None:
        """Evaluates outputs that are about to be asked for in one program, by their names in it."""
        self._fetch(tuple(dict.fromkeys(names)))

    def evaluate(self, names: tuple[str, ...]) -> Floats:
        """Outputs of the program by name, (names, n); NaN where the position is not solved."""
        values = self.solver.evaluate(names, self.positions, self.states, self.modes, self.design)
        if not self.ok.all():
            values[:, ~self.ok] = np.nan
        return values

    def _point_key(self, name: str) -> str:
        found = self.solver.point_keys.get(name)
        if found is None:
            found = self.solver.point_keys[name] = point_key(self.design.base, name)
        return found

    def point_names(self) -> Iterable[str]:
        """Names of all points that move."""
        return self.solver.outputs.point_keys()

    @attached
    def columns(self) -> dict[str, Floats]:
        """All results as named columns (n,), names with units."""
        raise NotImplementedError

    @attached
    def to_dataframe(self) -> pandas.DataFrame:
        """All results as a table over the first driver's coordinate, its index; needs pandas."""
        raise NotImplementedError

    @attached
    def _repr_svg_(self) -> str | None:
        """The drawing, as notebooks show it; None where it cannot be put together."""
        raise NotImplementedError

    def __repr__(self) -> str:
        failed = self.steps - int(self.ok.sum())
        state = "all assembled" if not failed else f"{failed} not reached"
        return (
            f"Motion({self.mechanism.name!r}: {self.steps} positions, {state}; "
            f"points {', '.join(self.point_names())}; links {', '.join(self.mechanism.links)})"
        )


def _unwrapped(angle: Floats) -> Floats:
    """Angles (n,) moved by full turns, each next to the one before."""
    if len(angle) and angle.max() - angle.min() >= np.pi:
        angle[1:] -= TURN * np.cumsum(np.round(np.diff(angle) / TURN))
    return angle


@dataclass(frozen=True)
class Outcome:
    """Of one position: whether it is solved, and if not, the group that fails and why (in English)."""

    ok: bool
    sentence: str = _("assembled", code="outcome.assembled")
    group: str | None = None
    kind: str = "ok"

    def translate(self, language: str = "en") -> str:
        """The sentence in a language."""
        return in_language(self.sentence, language)


class PositionError(LinkwrightError):
    """The mechanism cannot be in a position that was asked for.

    ``failed``: indices of the failed positions; ``outcomes``: what became of the first of them.
    """

    def __init__(self, message: str, failed: tuple[int, ...] = (), outcome: Outcome | None = None) -> None:
        super().__init__(message)
        self.failed = failed
        self.outcome = outcome
