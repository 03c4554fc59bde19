"""Pitch curve, profile, normals and curvature of a cam, exactly, from its program's derivatives; undercut and cusps.

Points are complex numbers in the cam's axes, which agree with the frame's at φ = 0; the cam turns by σφ (σ = +1
counter-clockwise), so a place z of the frame is z e^(-iσφ) there.

The contact at φ is lost where the follower at some ψ reaches beyond it, g(φ) = max over ψ of reach(Q(φ), ψ) > 0. That
is the case wherever the profile would have to fold back (growth < 0), and around it as far as the swallow's tail
goes, and where parts of the profile that are far from each other on the way cross.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np

from linkwright.cams.follower import Follower
from linkwright.core.arrays import Complexes, Flags, Floats
from linkwright.core.search import ends as last_places
from linkwright.core.search import first_largest
from linkwright.curves.curve import Curve
from linkwright.laws.program import Program


@dataclass(frozen=True)
class Contact:
    """Where cam and follower touch at angles φ (n,).

    ``point`` of the profile and ``normal`` (unit, from the cam into the follower) in the cam's axes, m; ``curvature``
    the profile's curvature (1/m, positive where it is convex); ``growth``: the profile's length over that of the
    pitch curve (of a flat face: its radius of curvature, m), not positive where the cam would have to fold back;
    ``pressure_angle`` (rad) between normal and the follower's motion, positive where the cam pushes it to the side
    that the cam's surface moves to while it rises; ``along``: place of the contact on a flat face, m, from the
    follower's axis or pivot.
    """

    point: Complexes
    normal: Complexes
    curvature: Floats
    growth: Floats
    pressure_angle: Floats
    along: Floats


class CamCurve(ABC):
    """A wall of a cam that a follower touches; ``turn`` σ."""

    program: Program
    closed: bool = True

    @abstractmethod
    def contact(self, phi: Floats) -> Contact:
        """The contact at angles φ (n,)."""

    @abstractmethod
    def reach(self, points: Complexes, phi: Floats) -> Floats:
        """How deep (m) the follower at angles φ (n,) reaches beyond points (n,) of the profile."""

    @abstractmethod
    def reach_table(self, points: Complexes, phi: Floats) -> Floats:
        """The same for every point (n,) at every angle (k,): (n, k)."""

    @abstractmethod
    def reach_slopes(self, points: Complexes, phi: Floats) -> tuple[Floats, Floats]:
        """First and second derivative of :meth:`reach` along φ."""


@dataclass(frozen=True)
class RollerCurve(CamCurve):
    """The wall of a disc cam under a roller or a knife; ``outer``: the wall of a groove outside the roller."""

    program: Program
    follower: Follower
    base_radius: float
    turn: float = 1.0
    outer: bool = False

    def _world(self, phi: Floats) -> tuple[Complexes, Complexes, Complexes, Complexes]:
        """Trace point in the frame, its first two derivatives by φ, and the unit vector of its motion with lift."""
        follower = self.follower
        s, v, a, _ = self.program.curves(phi)
        if not follower.oscillating:
            height = follower.start_height(self.base_radius)
            assert height is not None
            return follower.offset + 1j * (height + s), 1j * v, 1j * a, np.full(len(phi), 1j)
        start, side = follower.start_angle(self.base_radius), follower.side
        assert start is not None and follower.arm is not None and follower.pivot_distance is not None
        arm = -follower.arm * np.exp(-1j * side * (start + s))
        first, second = -1j * side * v, -1j * side * a - v * v
        return follower.pivot_distance + arm, arm * first, arm * second, -1j * side * arm / follower.arm

    def pitch(self, phi: Floats) -> tuple[Complexes, Complexes, Complexes]:
        """Pitch curve and its first two derivatives by φ, in the cam's axes."""
        z, z1, z2, _ = self._world(phi)
        turned, w = np.exp(-1j * self.turn * phi), 1j * self.turn
        return z * turned, (z1 - w * z) * turned, (z2 - 2 * w * z1 - z) * turned

    def contact(self, phi: Floats) -> Contact:
        sign = -1.0 if self.outer else 1.0
        p, p1, p2 = self.pitch(phi)
        speed = np.abs(p1)
        outward = 1j * self.turn * p1 / speed
        curvature = -self.turn * (p1.conj() * p2).imag / speed**3
        growth = 1.0 - sign * self.follower.roller_radius * curvature
        with np.errstate(divide="ignore"):
            own = sign * curvature / growth
        direction = self._world(phi)[3] * np.exp(-1j * self.turn * phi)
        angle = self.turn * np.angle(outward / direction)
        normal = sign * outward
        point = p - self.follower.roller_radius * normal
        return Contact(point, normal, own, growth, angle, np.zeros(len(phi)))

    def reach(self, points: Complexes, phi: Floats) -> Floats:
        return np.asarray(self.follower.roller_radius - np.abs(points - self.pitch(phi)[0]))

    def reach_table(self, points: Complexes, phi: Floats) -> Floats:
        return np.asarray(self.follower.roller_radius - np.abs(points[:, None] - self.pitch(phi)[0]))

    def reach_slopes(self, points: Complexes, phi: Floats) -> tuple[Floats, Floats]:
        p, p1, p2 = self.pitch(phi)
        gap = points - p
        size = np.maximum(np.abs(gap), 1e-300)
        along = (gap.conj() * p1).real / size
        with np.errstate(over="ignore"):  # of points on the pitch curve
            across = (np.abs(p1) ** 2 - (gap.conj() * p2).real - along**2) / size
        return along, -across


@dataclass(frozen=True)
class BarrelCurve(RollerCurve):
    """A wall of the groove of a barrel cam of ``radius`` (m), unrolled: x = radius times φ, y the lift."""

    closed = False
    radius: float = 0.0

    def pitch(self, phi: Floats) -> tuple[Complexes, Complexes, Complexes]:
        s, v, a, _ = self.program.curves(phi)
        return self.radius * phi + 1j * s, self.radius + 1j * v, 1j * a

    def contact(self, phi: Floats) -> Contact:
        sign = -1.0 if self.outer else 1.0
        _, p1, p2 = self.pitch(phi)
        speed = np.abs(p1)
        up = 1j * p1 / speed
        curvature = -(p1.conj() * p2).imag / speed**3
        growth = 1.0 - sign * self.follower.roller_radius * curvature
        with np.errstate(divide="ignore"):
            own = sign * curvature / growth
        point = self.pitch(phi)[0] - sign * self.follower.roller_radius * up
        return Contact(point, sign * up, own, growth, np.angle(p1), np.zeros(len(phi)))


@dataclass(frozen=True)
class FlatCurve(CamCurve):
    """The profile under a flat face: the envelope of its lines, with support H over the normal's angle θ."""

    program: Program
    follower: Follower
    base_radius: float
    turn: float = 1.0

    def _support(self, phi: Floats) -> tuple[Complexes, Floats, Floats, Floats]:
        """Unit normal N in the cam's axes; H, dH/dθ and d²H/dθ²."""
        follower, turn = self.follower, self.turn
        s, v, a, _ = self.program.curves(phi)
        if not follower.oscillating:
            normal = 1j * np.exp(-1j * turn * phi)
            return normal, self.base_radius + s, -turn * v, a
        start, c, side = follower.start_angle(self.base_radius), follower.pivot_distance, follower.side
        assert start is not None and c is not None
        psi = start + s
        normal = 1j * side * np.exp(-1j * (side * psi + turn * phi))
        rate = -side * v - turn
        first = c * np.cos(psi) * v
        second = c * (np.cos(psi) * a - np.sin(psi) * v * v)
        slope = first / rate
        return normal, c * np.sin(psi) - follower.face_offset, slope, (second + side * a * slope) / rate**2

    def contact(self, phi: Floats) -> Contact:
        normal, support, slope, second = self._support(phi)
        point = (support + 1j * slope) * normal
        growth = support + second
        with np.errstate(divide="ignore"):
            curvature = 1.0 / growth
        none = np.zeros(len(phi))
        if not self.follower.oscillating:
            return Contact(point, normal, curvature, growth, none, -slope)
        assert self.follower.pivot_distance is not None
        turned = np.exp(1j * self.turn * phi)
        lever = point * turned - self.follower.pivot_distance
        arm = 1j * self.follower.side * normal * turned
        direction = -1j * self.follower.side * lever / np.abs(lever)
        angle = self.turn * np.angle(normal * turned / direction)
        return Contact(point, normal, curvature, growth, angle, (lever * arm.conj()).real)

    def reach(self, points: Complexes, phi: Floats) -> Floats:
        normal, support, _, _ = self._support(phi)
        return np.asarray((points * normal.conj()).real - support)

    def reach_table(self, points: Complexes, phi: Floats) -> Floats:
        normal, support, _, _ = self._support(phi)
        return np.outer(points.real, normal.real) + np.outer(points.imag, normal.imag) - support

    def reach_slopes(self, points: Complexes, phi: Floats) -> tuple[Floats, Floats]:
        normal, _, slope, second = self._support(phi)
        rate = -self.turn * np.ones(len(phi))
        if self.follower.oscillating:
            rate = -self.follower.side * self.program.curves(phi)[1] - self.turn
        across = (points * (1j * normal).conj()).real
        within = (points * normal.conj()).real
        return (across - slope) * rate, -(within + second) * rate**2


#: Places on the way at which everything is looked at first.
LOOKS = 1440
#: Depth, as a share of the cam's size, below which nothing counts as cut.
_DEEP = 1e-9
_NEWTON = 8


@dataclass(frozen=True)
class Undercut:
    """Contacts from ``start`` to ``end`` (rad, the end may lie beyond a turn) are cut away, up to ``depth`` (m).

    ``place``: where it is deepest; ``corner``: the point (x, y) m at which the profile that is left has a corner.
    """

    start: float
    end: float
    place: float
    depth: float
    corner: tuple[float, float]


def undercuts(curve: CamCurve) -> tuple[Undercut, ...]:
    """All parts of the way whose contact is cut away, in order."""
    search = _Search(curve)
    cut = search.depth(search.phi) > search.slack
    if cut.all():
        phi = search.phi[first_largest(search.depth(search.phi))]
        deepest = float(search.depth(search.phi).max())
        point = curve.contact(np.array([phi])).point[0]
        return (Undercut(0.0, search.period, float(phi), deepest, (point.real, point.imag)),)
    starts = np.flatnonzero(cut & ~np.roll(cut, 1))
    stops = np.flatnonzero(cut & ~np.roll(cut, -1))
    if not len(starts):
        return ()
    stops = np.array([min(s for s in (*stops, *(stops + len(cut))) if s >= start) for start in starts])
    phi = np.concatenate([search.phi, search.phi + search.period])
    before = np.where(starts > 0, phi[starts - 1], phi[len(cut) - 1] - search.period)
    low = last_places(search.lost, phi[starts], before)
    high = last_places(search.lost, phi[stops], phi[stops + 1])
    return tuple(_undercut(search, a, b) for a, b in zip(low, high, strict=True))


def _undercut(search: _Search, low: float, high: float) -> Undercut:
    phi = np.linspace(low, high, 129)
    depth = search.depth(phi)
    k = first_largest(depth)
    point = search.curve.contact(np.array([low])).point[0]
    return Undercut(float(low), float(high), float(phi[k]), float(depth[k]), (point.real, point.imag))


class _Search:
    """The depth g at any places, from a first look at many and Newton steps of the best."""

    def __init__(self, curve: CamCurve) -> None:
        self.curve, self.period = curve, curve.program.period
        inner = self._narrow()
        phi = curve.program.places(LOOKS)
        self.phi = np.unique(np.concatenate([phi, *inner]) % self.period)
        if curve.closed:
            self.psi = self.phi
        else:
            half = self.period / 2
            self.psi = np.concatenate(
                [self.phi[self.phi > half] - self.period, self.phi, self.phi[self.phi < half] + self.period]
            )
        points = curve.contact(self.phi).point
        self.size = float(np.ptp(points.real) + np.ptp(points.imag))
        self.slack = _DEEP * self.size

    def _narrow(self) -> list[Floats]:
        """Places around the smallest values of the growth, so that a narrow tail is not overlooked."""
        program = self.curve.program
        inner = program.breaks[(program.breaks > 0) & (program.breaks < program.period)]
        growth = Curve.of(lambda x: self.curve.contact(x).growth, 0.0, program.period, pieces=24, knots=inner)
        found = []
        for low, high in folds(growth):
            reach = 1.2 * (high - low)
            found.append(np.linspace(low - reach, high + reach, 61))
        return found

    def lost(self, phi: Floats) -> Flags:
        """Whether contacts are cut away."""
        return np.asarray(self.depth(phi) > self.slack)

    def depth(self, phi: Floats) -> Floats:
        """g at places (n,), zero where the contact stays."""
        contact = self.curve.contact(phi)
        found = np.zeros(len(phi))
        for part in np.array_split(np.arange(len(phi)), max(1, len(phi) // 400)):
            found[part] = self._deepest(contact.point[part])
        folded = contact.growth < 0
        return np.where(folded, np.maximum(found, 2 * self.slack), found)

    def _deepest(self, points: Complexes) -> Floats:
        """Largest reach over the full path, refined from the three best places that are peaks."""
        reach = self.curve.reach_table(points, self.psi)
        peaks = (reach >= np.roll(reach, 1, axis=1)) & (reach >= np.roll(reach, -1, axis=1))
        ranked = np.where(peaks, reach, -np.inf)
        best = np.argsort(-ranked, axis=1)[:, :3]
        most = np.zeros(len(points))
        width = 2 * self.period / len(self.phi)
        for column in best.T:
            psi = self.psi[column]
            start = psi
            for _ in range(_NEWTON):
                first, second = self.curve.reach_slopes(points, psi)
                with np.errstate(all="ignore"):
                    step = np.where(second < 0, -first / second, 0.0)
                psi = np.clip(psi + np.nan_to_num(step), start - width, start + width)
            most = np.maximum(most, self.curve.reach(points, psi))
        return most


def folds(growth: Curve) -> list[tuple[float, float]]:
    """The intervals in which the growth is negative, to rounding."""
    edges = growth.edges
    share = np.linspace(0.0, 1.0, 41)
    places = np.unique((edges[:-1, None] + np.diff(edges)[:, None] * share).ravel())
    lowest = growth.extreme("min")
    places = np.unique(np.append(places, lowest.place))
    values = growth(places)
    values[places == lowest.place] = min(lowest.value, float(values[places == lowest.place][0]))
    negative = values < 0
    starts = np.flatnonzero(negative & ~np.append(False, negative[:-1]))
    stops = np.flatnonzero(negative & ~np.append(negative[1:], False))
    found = []
    for a, b in zip(starts, stops, strict=True):
        low, high = places[a], places[b]
        if a > 0:
            low = float(last_places(lambda x: growth(x) < 0, places[a : a + 1], places[a - 1 : a])[0])
        if b + 1 < len(places):
            high = float(last_places(lambda x: growth(x) < 0, places[b : b + 1], places[b + 1 : b + 2])[0])
        found.append((float(low), float(high)))
    return found


def cusps(program: Program, curve: CamCurve) -> tuple[float, ...]:
    """Angles (rad) at which the profile has a cusp: its growth passes zero."""
    inner = program.breaks[(program.breaks > 0) & (program.breaks < program.period)]
    growth = Curve.of(lambda x: curve.contact(x).growth, 0.0, program.period, pieces=24, knots=inner)
    return tuple(place for pair in folds(growth) for place in pair if 0.0 < place < program.period)
