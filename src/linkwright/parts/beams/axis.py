"""The axis of a link, straight or with corners; the link's mass along it, and the forces at its points."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.polynomial import Polynomial, legendre

from linkwright.core.arrays import Floats, Indices
from linkwright.core.plane import cross
from linkwright.kinetostatics.forces import Forces
from linkwright.kinetostatics.link_balance import applied_rows, driver_wrenches
from linkwright.mechanism.link import Link

#: Stations between two corners.
STATIONS = 201


@dataclass(frozen=True)
class LinkAxis:
    """A line through ``corners`` (m, 2) in the axes of the link; s counts along it from the first one, m."""

    corners: Floats

    @classmethod
    def of(cls, link: Link, names: Sequence[str] = ()) -> LinkAxis:
        """Through named points, in their order; else straight through the two most distant points."""
        if names:
            return cls(np.array([link.points[name] for name in names], dtype=float))
        places = np.array(list(link.points.values()), dtype=float)
        gaps = np.linalg.norm(places[:, None] - places[None], axis=2)
        ends = np.unravel_index(int(gaps.argmax()), gaps.shape)
        return cls(places[[min(ends), max(ends)]])

    @cached_property
    def places(self) -> Floats:
        """s of the corners, (m,)."""
        return np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(self.corners, axis=0), axis=1))])

    @property
    def length(self) -> float:
        """Length along the axis, m."""
        return float(self.places[-1])

    @property
    def straight(self) -> bool:
        """Whether it has no corner."""
        return len(self.corners) == 2

    @cached_property
    def tangents(self) -> Floats:
        """Unit vectors of the pieces, (m - 1, 2)."""
        steps = np.diff(self.corners, axis=0)
        return np.asarray(steps / np.linalg.norm(steps, axis=1)[:, None])

    def at(self, s: Floats, piece: Indices) -> Floats:
        """Points at places s of given pieces, (k, 2)."""
        return np.asarray(self.corners[piece] + (s - self.places[piece])[:, None] * self.tangents[piece])

    def nearest(self, points: Floats) -> tuple[Floats, Floats]:
        """s of the axis' points nearest to points (n, 2), and how far away these are, (n,) each."""
        away = points[:, None] - self.corners[:-1]
        lengths = np.diff(self.places)
        reach = np.clip((away * self.tangents).sum(axis=2), 0.0, lengths)
        gap = np.linalg.norm(away - reach[:, :, None] * self.tangents, axis=2)
        best, rows = gap.argmin(axis=1), np.arange(len(points))
        return (self.places[:-1] + reach)[rows, best], gap[rows, best]

    def crossed(self, force: Floats, moment: Floats) -> tuple[Floats, Floats]:
        """Where forces (n, 2) with ``moment`` (n,) about the origin meet the axis: s (n,), and the couple that is
        left (n,) where they pass it by, at the corner where it is smallest."""
        left = moment[:, None] - cross(self.corners[None], force[:, None])
        rows = np.arange(len(force))
        best = np.abs(left).argmin(axis=1)
        s, couple = self.places[best], left[rows, best]
        turning = cross((self.tangents * np.diff(self.places)[:, None])[None], force[:, None])
        with np.errstate(all="ignore"):
            share = left[:, :-1] / turning
        for piece in reversed(range(len(self.tangents))):
            within = (share[:, piece] >= 0.0) & (share[:, piece] <= 1.0)
            reach = np.where(within, share[:, piece], 0.0) * (self.places[piece + 1] - self.places[piece])
            s = np.where(within, self.places[piece] + reach, s)
            couple = np.where(within, 0.0, couple)
        return s, couple

    def stations(self, points: Sequence[float], count: int = STATIONS) -> tuple[Floats, Indices]:
        """Places along the axis, so many between two corners, every corner and named point twice (left and right),
        and their pieces."""
        found, pieces = [], []
        for piece, (begin, end) in enumerate(zip(self.places[:-1], self.places[1:], strict=True)):
            own = [p for p in points if begin <= p <= end]
            row = np.sort(np.concatenate([np.linspace(begin, end, count), own, own]))
            found.append(row)
            pieces.append(np.full(len(row), piece))
        return np.concatenate(found), np.concatenate(pieces)


@dataclass(frozen=True)
class SpreadMass:
    """Mass of a link along its axis, ρ(s) between two places, with the link's mass, centre and inertia.

    Straight: evenly about the centre over √(12 J/m) where that fits (a uniform bar: over its length), else
    ρ = r0 + r1 s + r2 s². With corners: a cubic, of four conditions.
    """

    axis: LinkAxis
    link: Link

    @cached_property
    def span(self) -> tuple[float, float]:
        """Where the mass lies, m."""
        link, length = self.link, self.axis.length
        if not self.axis.straight or not link.mass or not link.inertia:
            return 0.0, length
        centre = float(self.axis.nearest(np.array([link.centre]))[0][0])
        half = math.sqrt(3.0 * link.inertia / link.mass)
        within = 1e-9 * length
        if centre - half >= -within and centre + half <= length + within:
            return max(centre - half, 0.0), min(centre + half, length)
        return 0.0, length

    @cached_property
    def density(self) -> Polynomial:
        """ρ(s) within ``span``, kg/m."""
        link, (a, b) = self.link, self.span
        if not link.mass:
            return Polynomial([0.0])
        degree = 2 if self.axis.straight else 3
        wanted = np.array([1.0, 0.0, 0.0, link.inertia / link.mass / self.axis.length**2])
        rows = np.array([self._moments(Polynomial.basis(k, [a, b], [-1.0, 1.0])) for k in range(degree + 1)]).T
        coefficients, *_ = np.linalg.lstsq(rows, wanted, rcond=1e-9)
        found = np.where(np.abs(coefficients) < 1e-9 * np.abs(coefficients).max(), 0.0, coefficients)
        return Polynomial(found * link.mass, [a, b], [-1.0, 1.0]).convert()

    @property
    def gap(self) -> float:
        """How far the spread mass misses mass, centre and inertia, as shares."""
        if not self.link.mass:
            return 0.0
        wanted = np.array([1.0, 0.0, 0.0, self.link.inertia / self.link.mass / self.axis.length**2])
        return float(np.abs(self._moments(self.density) / self.link.mass - wanted).max())

    def _moments(self, density: Polynomial) -> Floats:
        """Mass, static moments over the length, moment of inertia over its square, about the mass centre."""
        m0, m1, m2 = self._sums(self.axis.places, np.arange(len(self.axis.tangents)), density)
        length = self.axis.length
        return np.array([m0[-1], *(m1[-1] / length), m2[-1] / length**2])

    def below(self, stations: Floats, pieces: Indices) -> tuple[Floats, Floats, Floats]:
        """∫ρ ds, ∫ρ r ds, ∫ρ |r|² ds below every station, (k,), (k, 2), (k,), r from the mass centre."""
        return self._sums(stations, pieces[1:], self.density)

    def _sums(self, edges: Floats, pieces: Indices, density: Polynomial) -> tuple[Floats, Floats, Floats]:
        nodes, weights = legendre.leggauss(4)
        ends = np.clip(edges, *self.span)
        half, middle = 0.5 * np.diff(ends), 0.5 * (ends[1:] + ends[:-1])
        s = middle[:, None] + half[:, None] * nodes
        around = self.axis.at(s.ravel(), np.repeat(pieces, len(nodes))).reshape(*s.shape, 2) - self.link.centre
        mass = density(s) * weights * half[:, None]
        parts = (
            mass.sum(axis=1),
            (mass[:, :, None] * around).sum(axis=1),
            (mass * (around**2).sum(axis=2)).sum(axis=1),
        )
        m0, m1, m2 = (np.concatenate([np.zeros_like(part[:1]), np.cumsum(part, axis=0)]) for part in parts)
        return m0, m1, m2


@dataclass(frozen=True)
class PointForce:
    """What acts at a point of a link: ``place`` s (n,) m, ``force`` (n, 2) N and ``point`` (n, 2) m in the link's
    axes, ``couple`` (n,) N·m."""

    name: str
    place: Floats
    force: Floats
    point: Floats
    couple: Floats


@dataclass(frozen=True)
class LinkForces:
    """All that acts on the link ``name`` at points, in the axes of the link; places along its ``axis``."""

    forces: Forces
    name: str
    axis: LinkAxis

    @property
    def link(self) -> Link:
        """The link."""
        return self.forces.motion.mechanism.links[self.name]

    def at_points(self) -> list[PointForce]:
        """All that acts at points."""
        return [*self._joint_forces(), *self._driver_forces(), *self._load_forces()]

    def turned(self, vectors: Floats) -> Floats:
        """Vectors (n, 2) of the frame in the axes of the link."""
        e = self.forces.motion.link(self.name).direction
        x, y = vectors[:, 0], vectors[:, 1]
        return np.stack([x * e[:, 0] + y * e[:, 1], y * e[:, 0] - x * e[:, 1]], axis=1)

    def _local(self, places: Floats) -> Floats:
        """Places (n, 2) of the frame in the axes of the link."""
        first, own = next(iter(self.link.points.items()))
        origin = self.forces.motion.point(f"{self.name}.{first}").position
        return self.turned(places - origin) + own

    def _seat(self, joint: str) -> Floats:
        """Where a joint's force acts, (n, 2) in the link's axes: the block's point where the link is the guide."""
        own = self.forces.motion.mechanism.joints[joint]
        if own.couples or own.higher:
            return self._local(self.forces.motion.reaction_place(joint))
        return np.tile(self.link.points[own.point_on(self.name)], (self.forces.steps, 1))

    def _joint_forces(self) -> list[PointForce]:
        found, name = [], self.name
        for joint, own in self.forces.motion.mechanism.joints.items():
            if name in own.joined:
                force, seat = self.turned(self.forces.reaction(joint, on=name)), self._seat(joint)
                couple = self.forces.couple(joint, on=name)
                found.append(PointForce(joint, self.axis.nearest(seat)[0], force, seat, couple))
        return found

    def _driver_forces(self) -> list[PointForce]:
        found = []
        for name, force, couple in driver_wrenches(self.forces, self.name):
            seat = self._seat(self.forces.motion.mechanism.drivers[name].joint)
            found.append(PointForce(name, self.axis.nearest(seat)[0], self.turned(force), seat, couple))
        return found

    def _load_forces(self) -> list[PointForce]:
        """The resultant of all loads on the link, where it meets the axis; a couple where it passes by."""
        link = self.name
        fx, fy, moment = self.forces.fetch(applied_rows(link))
        if not (np.any(fx) or np.any(fy) or np.any(moment)):
            return []
        force = np.stack([fx, fy], axis=1)
        first, own = next(iter(self.link.points.items()))
        origin = self.forces.motion.point(f"{link}.{first}").position
        turned = self.turned(force)
        about = moment - cross(origin, force) + cross(np.array(own, dtype=float), turned)
        place, couple = self.axis.crossed(turned, about)
        piece = np.clip(np.searchsorted(self.axis.places, place, side="right") - 1, 0, len(self.axis.tangents) - 1)
        return [PointForce("loads", place, turned, self.axis.at(place, piece), couple)]
