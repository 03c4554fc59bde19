"""Undercut and cusps: where the follower, elsewhere on its way, cuts away what it should touch.

The contact at φ is lost where the follower at some ψ reaches beyond it, g(φ) = max over ψ of reach(Q(φ), ψ) > 0. That
is the case wherever the profile would have to fold back (growth < 0), and around it as far as the swallow's tail
goes, and where parts of the profile that are far from each other on the way cross.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from linkwright.cams.curves import CamCurve
from linkwright.core.arrays import Complexes, Flags, Floats
from linkwright.core.search import ends as last_places
from linkwright.core.search import first_largest
from linkwright.curves.curve import Curve
from linkwright.laws.program import Program

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
