"""Joints of a loop as polynomials of the input, up to MuJoCo's fourth degree, and by how much they leave it open."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.elements import Connection
from linkwright.exporters.mjcf.bodies import Chains, Coordinate, Poses, rider

#: Highest degree of MuJoCo's ``polycoef``.
DEGREE = 4
#: Passes of the exchange of weights in a fit.
PASSES = 40
#: Fewest positions of a cycle from which a polynomial is taken.
FEWEST = 8


@dataclass(frozen=True)
class Coupling:
    """A coordinate y as a polynomial of the driven one x: y - y0 = Σ ``factors``[i] (x - x0)^i from the start."""

    dependent: str
    independent: str
    factors: tuple[float, ...]

    @property
    def degree(self) -> int:
        """The highest power with a factor."""
        return max((i for i, factor in enumerate(self.factors) if factor), default=0)

    def after(self, moved: Floats) -> Floats:
        """y - y0 after x - x0."""
        found = np.zeros(len(moved))
        for factor in reversed(self.factors):
            found = found * moved + factor
        return found


def coupled(chains: Chains, cuts: Sequence[Connection], degree: int) -> tuple[Coupling, ...]:
    """The best polynomials of a degree for all coordinates of the loops that ``cuts`` close; none where no one driver
    moves the machine through a cycle."""
    driven = [each for each in chains.coordinates if each.driver is not None]
    positions = chains.motion.positions
    if len(driven) != 1 or not positions.cycle or not chains.motion.complete or positions.count < FEWEST:
        return ()
    turns_on = goes_on(chains)
    if turns_on and degree > 1:
        return ()
    found = []
    for coordinate in _coordinates(chains, cuts):
        factors = _fitted(chains, driven[0], coordinate, degree)
        if turns_on:
            factors = (0.0, _steady(factors[1], driven[0], coordinate, chains))
        found.append(Coupling(coordinate.name, driven[0].name, (*factors, *[0.0] * (DEGREE + 1 - len(factors)))))
    return tuple(found)


def goes_on(chains: Chains) -> bool:
    """Whether the input turns on beyond its cycle, so that only straight lines hold for all turns."""
    laws = [driver.law.constant_speed for driver in chains.mechanism.drivers.values()]
    return chains.motion.positions.closed and None not in laws


def _coordinates(chains: Chains, cuts: Sequence[Connection]) -> list[Coordinate]:
    """The free coordinates of the groups with these cuts, those of their riders included."""
    groups = [group for group in chains.structure.groups if any(cut in group.cuts for cut in cuts)]
    bodies = [step.child for group in groups for step in group.unknowns]
    bodies += [rider(cut) for cut in cuts if cut.slides]
    return [each for each in map(chains.of, bodies) if each is not None]


def _fitted(chains: Chains, x: Coordinate, y: Coordinate, degree: int) -> tuple[float, ...]:
    """Factors from power 0 whose largest error over the motion is near the smallest one; exact at the start.

    Lawson's algorithm: least squares, weighted anew with the errors (Rice and Usow, Math. Comp. 22, 1968).
    """
    moved, wanted = x.values - x.values[chains.index], y.values - y.values[chains.index]
    size = float(np.abs(moved).max(initial=0.0)) or 1.0
    powers = (moved[:, None] / size) ** np.arange(1, degree + 1)
    weights = np.full(len(moved), 1.0 / len(moved))
    best, found = math.inf, np.zeros(degree)
    for _pass in range(PASSES):
        root = np.sqrt(weights)
        factors = np.linalg.lstsq(powers * root[:, None], wanted * root, rcond=None)[0]
        errors = np.abs(powers @ factors - wanted)
        worst = float(errors.max(initial=0.0))
        if worst < best:
            best, found = worst, factors
        weights = weights * errors
        if not weights.sum() > 0.0:
            break
        weights /= weights.sum()
    return (0.0, *(float(each) for each in found / size ** np.arange(1, degree + 1)))


def _steady(slope: float, x: Coordinate, y: Coordinate, chains: Chains) -> float:
    """The slope nearest to ``slope`` with which y comes back, but for full turns, when the cycle begins again."""
    assert chains.motion.positions.period is not None
    turn = float(x.rates[chains.index]) * chains.motion.positions.period
    return 0.0 if y.slides else round(slope * turn / math.tau) * math.tau / turn


def values_with(chains: Chains, couplings: Sequence[Coupling], values: Mapping[str, Floats]) -> dict[str, Floats]:
    """Coordinates with those that are coupled taken from their polynomials."""
    start = {each.name: float(each.values[chains.index]) for each in chains.coordinates}
    found = dict(values)
    for each in couplings:
        moved = values[each.independent] - start[each.independent]
        found[each.dependent] = start[each.dependent] + each.after(moved)
    return found


def gap(chains: Chains, cut: Connection, poses: Poses, values: Mapping[str, Floats]) -> Floats:
    """By how much a cut joint is open, (n,) m.

    Of a pin the distance of its two points; of a guide or a weld the largest distance of a point of the link from
    where the joint would have it; of a higher pair the arc by which its wheels, or rack and pinion, are off.
    """
    if cut.turns:
        a, b = (poses[link].of(chains.mechanism.link(link).points[cut.joint]) for link in (cut.a, cut.b))
        return np.abs(a - b)
    if cut.higher:
        return np.abs(_row(chains, cut, values)) * _arm(chains, cut)
    held, pose = poses[cut.b], poses[rider(cut) if cut.slides else cut.a]
    origin, direction = pose.origin, pose.direction
    if not cut.slides:
        (place, axis), (other, turned) = chains.start(cut.a), chains.start(cut.b)
        origin = pose.origin + direction * (other - place) * axis.conjugate()
        direction = direction * turned * axis.conjugate()
    points = chains.mechanism.link(cut.b).points.values()
    off = [np.abs(origin - held.origin + (direction - held.direction) * complex(*point)) for point in points]
    furthest: Floats = np.max(off, axis=0)
    return furthest


def _row(chains: Chains, cut: Connection, values: Mapping[str, Floats]) -> Floats:
    start = {each.name: float(each.values[chains.index]) for each in chains.coordinates}
    parts = [factor * (values[name] - start[name]) for name, factor in chains.factors(cut).items()]
    total: Floats = np.sum(parts, axis=0)
    return total


def _arm(chains: Chains, cut: Connection) -> float:
    """Metres of a unit of the pair's row: 1 where displacements are in it, else the distance of the centres."""
    joint = chains.mechanism.joints[cut.joint]
    if joint.sums(chains.mechanism)[1] or len(joint.seats) < 2:
        return 1.0
    a, b = (chains.mechanism.link(link).points[point] for link, point in joint.seats[:2])
    return math.dist(a, b)
