r"""Closed loops of the groups without closed form and of all that they hang on, as sums of turned arms.

Links that a guide or a weld joins share a rotation, links that a driver turns against each other one rotation and
the driver's angle. So every closed loop is, as complex numbers,

    F = Σ_c e^{iθ_c} (a_c + Σ_{j on c} b_j s_j) = 0,      θ_c = φ_c + (turns of drivers),

with as many unknown rotations φ and slides s as real equations. Lifts of cams that drivers turn are known as the
drivers' coordinates are, and have columns behind these. Terms of one rotation each have second derivatives
that the arms bound, which is what :mod:`linkwright.kinematics.certificate` lives on.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from copy import copy

import numpy as np

from linkwright.core.arrays import Complexes, Floats
from linkwright.core.dataclass import dataclass
from linkwright.core.linear_sums import SMALL, LinearSums
from linkwright.elements.topology import Group
from linkwright.joints.base import LackingError
from linkwright.kinematics.angles import counted_links, geared
from linkwright.kinematics.groups import iterated, whole_form
from linkwright.mechanism.geometry import mechanism_size
from linkwright.mechanism.mechanism import Mechanism
from linkwright.structure.analysis import Structure

#: ``turn`` of a link, ``slide`` of a guide, ``drive`` of a driver, or ``lift`` of a cam.
Key = tuple[str, str]
#: Factors by key, and a constant: together zero.
Sum = tuple[dict[Key, float], float]
#: Coefficients of a place, by rotation and slide (-1: of no slide).
Terms = dict[tuple[int, int], complex]


@dataclass(frozen=True)
class Body:
    """A link: number of its rotation, angle of its x axis beyond it, and its point ``anchor`` at ``place``."""

    rotation: int
    offset: float
    anchor: complex
    place: Terms


#: Of a lift: itself and its first two derivatives by the cam's angle to the carrier (m,).
Curve = Callable[[Floats], tuple[Floats, Floats, Floats]]


@dataclass(frozen=True)
class Lift:
    """A cam's lift: ``row`` (d,) and ``rest`` give the cam's angle to its carrier from drivers and lifts, rad."""

    row: Floats
    rest: float
    curve: Curve
    unit: float


@dataclass(frozen=True)
class Turned:
    """Loops at some coordinates: unit vectors (…, C), arms (…, C, K), turned directions of slides (…, S, K)."""

    unit: Complexes
    arms: Complexes
    slides: Complexes


def counted(structure: Structure, mechanism: Mechanism) -> list[str]:
    """Links placed by closed forms or as directions whose turns a higher pair counts."""
    pairs = {name: joint.turning for name, joint in mechanism.joints.items() if joint.higher}
    return counted_links(structure.groups, pairs, _adds_up) if pairs else []


def _adds_up(group: Group) -> bool:
    return geared(group) and whole_form(group) is None


def upstream(structure: Structure, mechanism: Mechanism) -> list[Group]:
    """The groups without closed form, those whose turns are counted, and all that they hang on, in solving order."""
    wanted = {link for group in iterated(structure) for link in group.links}
    wanted.update(counted(structure, mechanism))
    gears = {name: joint.turning for name, joint in mechanism.joints.items() if joint.higher}
    found = []
    for group in reversed(structure.groups):
        if wanted & set(group.links):
            found.append(group)
            wanted |= {end for c in group.joints for end in (c.a, c.b, *gears.get(c.joint, ()))}
    return found[::-1]


class ClosedLoops:
    """The equations of K loops in coordinates y = (n unknowns, d drivers), n = 2K; lengths in m, angles in rad.

    ``turning`` (C, n + d): the rotations θ of y; ``sliding`` (S, n + d): the slides of y; ``owner`` (S,): the
    rotation on which a slide lies; ``scale`` (n,): 1 for a rotation, the mechanism's size for a slide;
    ``groups`` (n,): the group of every unknown.
    """

    def __init__(self, mechanism: Mechanism, structure: Structure) -> None:
        self.mechanism = mechanism
        self.size = mechanism_size(mechanism)
        self.drivers = list(mechanism.drivers)
        self._build = build = LoopBuilder(mechanism)
        for group in upstream(structure, mechanism):
            build.add(group)
        self.unknowns, self.sums = build.independent()
        owners = dict(zip(build.unknowns, build.groups, strict=True))
        self.groups = [owners[key] for key in self.unknowns]
        self.links = {name: (body.rotation, body.offset) for name, body in build.bodies.items()}
        self.n, self.d = len(self.unknowns), len(self.drivers) + len(build.lifts)
        self.C, self.S, self.K = len(build.rotations), len(build.slides), len(build.loops)
        self._matrices(build)
        self.scale = np.where([kind == "turn" for kind, _ in self.unknowns], 1.0, self.size)

    def _matrices(self, build: LoopBuilder) -> None:
        self._columns = {
            key: i
            for i, key in enumerate([*self.unknowns, *(("drive", d) for d in self.drivers), *build.lifts])
        }
        self.turning, self._phase = np.zeros((self.C, len(self._columns))), np.zeros(self.C)
        for c, (unknown, turns) in enumerate(build.rotations):
            if unknown:
                self.turning[c], self._phase[c] = self.share(("turn", unknown))
            for driver, sign in turns:
                self.turning[c, self._columns["drive", driver]] += sign
        self.sliding, self._start = np.zeros((self.S, len(self._columns))), np.zeros(self.S)
        self.owner = np.array([owner for _, owner in build.slides], dtype=int)
        for j, (key, _) in enumerate(build.slides):
            self.sliding[j], self._start[j] = self.share(key)
        self.a, self.b = self._arms([terms for _, terms in build.loops])
        self.loop_groups = [group for group, _ in build.loops]
        self.own = np.zeros((self.S, self.C))
        self.own[np.arange(self.S), self.owner] = 1.0
        self.coordinates = np.concatenate([self.turning, self.sliding])
        self.lifts = [self._lift(build, *each) for each in build.lifts.values()]

    def _lift(self, build: LoopBuilder, cam: str, carrier: str, curve: Curve, unit: float) -> Lift:
        """Raises LackingError where the cam turns with unknowns."""
        rows = [
            (self.turning[body.rotation], self._phase[body.rotation] + body.offset)
            for body in (build.bodies[cam], build.bodies[carrier])
        ]
        row, rest = (a - b for a, b in zip(*rows, strict=True))
        if np.abs(row[: self.n]).max(initial=0.0) > SMALL:
            raise LackingError("joints.cam_turned", cam=cam)
        return Lift(row[self.n :], float(rest), curve, unit)

    def driven(self, q: Floats, first: Floats, second: Floats) -> tuple[Floats, Floats, Floats]:
        """Coordinates of drivers with two derivatives (m, drivers) and behind them those of lifts, (m, d)."""
        rows = [np.pad(each, ((0, 0), (0, len(self.lifts)))) for each in (q, first, second)]
        for place, lift in enumerate(self.lifts, len(self.drivers)):
            turn, rate, bend = (row @ lift.row for row in rows)
            value, slope, curved = lift.curve(turn + lift.rest)
            for row, own in zip(rows, (value, slope * rate, curved * rate**2 + slope * bend), strict=True):
                row[:, place] = own
        return rows[0], rows[1], rows[2]

    def _arms(self, gaps: Sequence[Terms]) -> tuple[Complexes, Complexes]:
        """Arms (C, K) and turned directions of slides (S, K) of K places."""
        a, b = np.zeros((self.C, len(gaps)), complex), np.zeros((self.S, len(gaps)), complex)
        for k, terms in enumerate(gaps):
            for (c, j), value in terms.items():
                turned = value * cmath.exp(1j * self._phase[c]) if self._phase[c] else value
                if j < 0:
                    a[c, k] += turned
                else:
                    b[j, k] += turned
                    a[c, k] += self._start[j] * turned
        return a, b

    def share(self, key: Key) -> tuple[Floats, float]:
        """A coordinate of the mechanism as a sum of y: factors (n + d,) and a constant, rad or m."""
        terms, rest = self.sums.get(key, ({key: 1.0}, 0.0))
        row = np.zeros(len(self._columns))
        for each, factor in terms.items():
            row[self._columns[each]] += factor
        return row, rest

    def value(self, key: Key, y: Floats) -> Floats:
        """A coordinate of the mechanism, rad or m, at coordinates y (m, n + d), (m,)."""
        row, rest = self.share(key)
        return np.asarray(y[:, : len(row)] @ row + rest)

    def to_places(self, places: Mapping[tuple[str, str], complex]) -> ClosedLoops:
        """Loops in the same coordinates from points (link, name) to places in frame axes, x + iy (m)."""
        gaps = [_added(self._build.place(*point), {(0, -1): at}, -1.0) for point, at in places.items()]
        other = copy(self)
        other.K = len(gaps)
        other.a, other.b = self._arms(gaps)
        return other

    # values ---------------------------------------------------------------------------------
    def turned(self, y: Floats) -> Turned:
        """The loops at coordinates y (…, n + d)."""
        unit = np.exp(1j * (y @ self.turning.T))
        if not self.S:
            return Turned(
                unit, np.broadcast_to(self.a, (*y.shape[:-1], *self.a.shape)), np.zeros(self.b.shape, complex)
            )
        slid = (y @ self.sliding.T)[..., None] * self.b
        arms: Complexes = np.asarray(self.a + self.own.T @ slid, complex)
        return Turned(unit, arms, unit[..., self.owner, None] * self.b)

    def gap(self, at: Turned) -> Floats:
        """F (…, n): real parts, then imaginary parts."""
        return _real((at.unit[..., None] * at.arms).sum(axis=-2))

    def slopes(self, at: Turned) -> Complexes:
        """∂F/∂y, (…, n + d, K)."""
        columns = [1j * at.unit[..., None] * at.arms]
        if self.S:
            columns.append(at.slides)
        found: Complexes = self.coordinates.T @ np.concatenate(columns, axis=-2)
        return found

    def linear(self, y: Floats) -> tuple[Floats, Floats]:
        """F (2K,) at coordinates y (n + d,), and its derivatives ∂F/∂y, (n + d, 2K)."""
        at = self.turned(y)
        return self.gap(at), _real(self.slopes(at))

    def jacobian(self, slopes: Complexes) -> Floats:
        """∂F/∂z (…, n, n), real parts above imaginary parts."""
        return np.swapaxes(_real(slopes[..., : self.n, :]), -1, -2)

    def rates(self, y: Floats, first: Floats, second: Floats) -> tuple[Floats, Floats, Floats]:
        """y′ and y″ (n + d,) along a way on which the drivers have the given first and second derivatives (d,), and
        the Jacobian. Both orders have the same matrix. Raises LinAlgError where it is singular."""
        at = self.turned(y)
        slopes = self.slopes(at)
        jacobian = self.jacobian(slopes)
        inverse = np.linalg.inv(jacobian)
        rate = np.concatenate([-inverse @ _real(first @ slopes[self.n :]), first])
        theta = self.turning @ rate
        bend = -(at.unit * theta**2) @ at.arms
        if self.S:
            bend = bend + (2j * (at.unit * theta)[self.owner] * (self.sliding @ rate)) @ self.b
        return rate, np.concatenate([-inverse @ _real(bend + second @ slopes[self.n :]), second]), jacobian

    def tangents(self, y: Floats, drive: Floats) -> Floats:
        """First derivatives of the unknowns (m, n) at roots y (m, n + d) for those of the drivers (m, d)."""
        slopes = self.slopes(self.turned(y))
        right = _real((drive[..., None] * slopes[..., self.n :, :]).sum(axis=-2))
        return np.asarray(np.linalg.solve(self.jacobian(slopes), -right[..., None])[..., 0])

    # solving --------------------------------------------------------------------------------
    def newton(self, y: Floats, iterations: int = 8) -> Floats | None:
        """The root near y (n + d,) with the same drivers, to rounding; None where Newton's method fails."""
        y = y.copy()
        for _ in range(iterations):
            at = self.turned(y)
            try:
                step = np.asarray(np.linalg.solve(self.jacobian(self.slopes(at)), self.gap(at)), float)
            except np.linalg.LinAlgError:
                return None
            y[: self.n] -= step
            size = self.largest(step)
            if not size < 1e3:
                return None
            if size < 1e-8:
                return y
        return None

    def polished(self, y: Floats, iterations: int = 3) -> tuple[Floats, Floats]:
        """Roots near y (m, n + d), and the last correction (m,), relative."""
        y = y.copy()
        step: Floats = np.zeros((len(y), self.n))
        for _ in range(iterations):
            at = self.turned(y)
            change = np.linalg.solve(self.jacobian(self.slopes(at)), self.gap(at)[..., None])
            step = np.asarray(change[..., 0], float)
            y[:, : self.n] -= step
        return y, np.asarray(np.abs(step / self.scale).max(axis=-1))

    def largest(self, step: Floats) -> float:
        """The largest change of an unknown: rad, or share of the mechanism's size."""
        return float(np.abs(step[: self.n] / self.scale).max())

    def weakest_group(self, y: Floats) -> str:
        """The group whose own equations are nearest to singular at y; one that only pairs' sums place has none."""
        jacobian = self.jacobian(self.slopes(self.turned(y))) * self.scale
        least: dict[str, float] = {}
        for group in dict.fromkeys(self.groups):
            rows = [k for k, name in enumerate(self.loop_groups) if name == group]
            if not rows:
                continue
            columns = [i for i, name in enumerate(self.groups) if name == group]
            block = jacobian[np.ix_([*rows, *(self.K + k for k in rows)], columns)]
            least[group] = float(np.linalg.svd(block, compute_uv=False)[-1])
        return min(least, key=least.__getitem__)


def _real(v: Complexes) -> Floats:
    return np.concatenate([v.real, v.imag], axis=-1)


class LoopBuilder:
    """Walks the chains of the groups and writes down where every link is; the joints add to it."""

    def __init__(self, mechanism: Mechanism, *, gains: bool = False) -> None:
        """``gains``: only what coordinates gain over a cycle is asked, not where they are."""
        self.mechanism, self.gains = mechanism, gains
        self.unknowns: list[Key] = []
        self.groups: list[str] = []
        self.rotations: list[tuple[str, tuple[tuple[str, float], ...]]] = [("", ())]
        self.slides: list[tuple[Key, int]] = []
        self.loops: list[tuple[str, Terms]] = []
        self.sums: list[Sum] = []
        self.lifts: dict[Key, tuple[str, str, Curve, float]] = {}
        self.bodies = {"frame": Body(0, 0.0, 0j, {})}

    def add(self, group: Group) -> None:
        """The links of a group on the links before, and the loops and sums that its cuts close."""
        joints = self.mechanism.joints
        for step in group.tree:
            self.bodies[step.child] = joints[step.joint].hang_in_loop(self, step, group.name)
        for cut in group.cuts:
            joints[cut.joint].close_loop(self, cut, group.name)

    # what joints add ----------------------------------------------------------------------------
    def unknown(self, kind: str, name: str, group: str) -> Key:
        """A new unknown of a group: ``turn`` of a link or ``slide`` of a guide."""
        self.unknowns.append((kind, name))
        self.groups.append(group)
        return kind, name

    def body(self, rotation: int, offset: float, anchor: complex, place: Terms) -> Body:
        """A link on rotation ``rotation``, its x axis ``offset`` beyond it, its point ``anchor`` at ``place``."""
        return Body(rotation, offset, anchor, place)

    def free_rotation(self, link: str, group: str) -> int:
        """The rotation of a link that turns freely: a new unknown."""
        self.unknown("turn", link, group)
        return self._rotation(link, ())

    def driven(self, rotation: int, driver: str, sign: float) -> int:
        """A rotation and a driver's angle."""
        unknown, turns = self.rotations[rotation]
        return self._rotation(unknown, (*turns, (driver, sign)))

    def slide(self, place: Terms, key: Key, rotation: int, direction: complex, offset: float) -> None:
        """Adds a displacement along a direction of a rotation, and the offset across it, to a place."""
        self.slides.append((key, rotation))
        place[rotation, len(self.slides) - 1] = direction
        place[rotation, -1] = place.get((rotation, -1), 0j) + 1j * direction * offset

    def loop(self, group: str, start: Terms, end: Terms) -> None:
        """Two places that coincide."""
        self.loops.append((group, _added(start, end, -1.0)))

    def lifted(self, name: str, cam: str, carrier: str, curve: Curve, unit: float) -> Key:
        """The lift of a cam by its angle to the carrier; ``unit``: 1 rad, or the mechanism's size."""
        self.lifts["lift", name] = cam, carrier, curve, unit
        return "lift", name

    def sum(
        self,
        rotations: Mapping[str, float],
        slides: Mapping[str, float],
        rest: float,
        lifts: Mapping[Key, float] | None = None,
    ) -> None:
        """Σ factor · rotation of a link + Σ factor · displacement of a guide + Σ factor · lift + ``rest`` = 0."""
        terms: dict[Key, float] = dict(lifts or {})
        for link, factor in rotations.items():
            body = self.bodies[link]
            unknown, turns = self.rotations[body.rotation]
            rest += factor * body.offset
            for key, share in ((("turn", unknown), 1.0), *((("drive", d), sign) for d, sign in turns)):
                if key[1]:
                    terms[key] = terms.get(key, 0.0) + factor * share
        for name, factor in slides.items():
            key = ("slide", name) if ("slide", name) in self.unknowns else ("drive", self._driver(name))
            terms[key] = terms.get(key, 0.0) + factor
        self.sums.append((terms, rest))

    def place(self, link: str, point: str) -> Terms:
        """Where a point of a link is."""
        body = self.bodies[link]
        arm = cmath.exp(1j * body.offset) * (self.local(link, point) - body.anchor)
        return _added(body.place, {(body.rotation, -1): arm}, 1.0)

    def local(self, link: str, point: str) -> complex:
        """A point in the axes of its link."""
        return complex(*self.mechanism.link(link).points[point])

    def _driver(self, joint: str) -> str:
        return next(name for name, driver in self.mechanism.drivers.items() if driver.joint == joint)

    def _rotation(self, unknown: str, turns: tuple[tuple[str, float], ...]) -> int:
        if (unknown, turns) not in self.rotations:
            self.rotations.append((unknown, turns))
        return self.rotations.index((unknown, turns))

    # sums that make unknowns depend on others --------------------------------------------------------
    def independent(self) -> tuple[list[Key], dict[Key, tuple[dict[Key, float], float]]]:
        """The unknowns that are left, and the others as sums (factors by key, constant) of these and the drivers.

        Every sum gives one up: one that no loop holds if there is one, and of those with the largest factor.
        """
        looped = self._looped()

        def order(key: Key) -> float:
            return -math.inf if key[0] in ("drive", "lift") else float(key not in looped)

        found: LinearSums[Key] = LinearSums()
        for terms, rest in self.sums:
            found.add(terms, rest, order)
        return [key for key in self.unknowns if key not in found.solved], found.solved

    def _looped(self) -> set[Key]:
        found: set[Key] = set()
        for _, terms in self.loops:
            for rotation, slide in terms:
                found.add(("turn", self.rotations[rotation][0]))
                if slide >= 0:
                    found.add(self.slides[slide][0])
        return found


def _added(a: Mapping[tuple[int, int], complex], b: Mapping[tuple[int, int], complex], sign: float) -> Terms:
    keys: Iterable[tuple[int, int]] = dict.fromkeys([*a, *b])
    return {key: a.get(key, 0j) + sign * b.get(key, 0j) for key in keys}
