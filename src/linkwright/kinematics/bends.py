"""Where a motion goes over from one formula to the next: laws of drivers, and joints such as cams.

Between two such places, and those where a link turns round by which such a joint is measured, an output that nothing
else turns round either rests all the time or goes one way.
"""

from __future__ import annotations

import numpy as np

from linkwright.core.arrays import Flags, Floats, Indices
from linkwright.core.cached_property import cached_property
from linkwright.core.dataclass import dataclass
from linkwright.core.outputs import row_name, row_names
from linkwright.core.search import zeros
from linkwright.drivers.base import Law
from linkwright.joints.base import Bends
from linkwright.kinematics.between_positions import Between
from linkwright.kinematics.motion import TURN, Motion
from linkwright.mechanism.mechanism import Mechanism

#: Angles nearer than this to one at which a joint bends are on it, rad.
ON = 1e-12
#: Times nearer to each other than this share of the motion are one.
SAME = 1e-12
#: Places of a stretch of a driver's law, between which it turns round once at most.
LOOKS = 14
#: Ways of drivers that turn by laws, rad: between places of a stretch, and at most in what is one piece.
LEAP, FAR = np.pi / 36, np.pi / 3
#: As many pieces at most, however far something turns.
MOST = 6000
#: Places in a stretch, as shares of it, one of which at least an output passes that moves there.
INNER = np.array([0.003, 0.03, 0.15, 0.35, 0.7, 0.9, 0.97, 0.997])


def one_formula(mechanism: Mechanism) -> bool:
    """Whether a mechanism moves by one formula all the time, so that no output rests for a while."""
    speeds = [driver.law.constant_speed for driver in mechanism.drivers.values()]
    bends = [joint.bends for joint in mechanism.joints.values()]
    return None not in speeds and not any(bends)


def bend_times(motion: Motion) -> Floats:
    """Times of a motion, s, in order, at which a driver's law or a joint goes over to another formula."""
    return np.empty(0) if one_formula(motion.mechanism) else _search(motion).bends


def law_bends(motion: Motion) -> Floats:
    """Times of a motion, s, in order, at which a driver's law goes over to another formula, or the driver turns
    round: the same whatever the dimensions of the links are."""
    return np.empty(0) if one_formula(motion.mechanism) else _search(motion).of_laws


def stretches(motion: Motion) -> Stretches | None:
    """The stretches of a motion between those times and the ones at which a link turns round by which joints with
    several formulas are measured; None where there are no such times."""
    return None if one_formula(motion.mechanism) else _search(motion).stretches


def with_leaps(motion: Motion, edges: Floats) -> Floats:
    """Times, s, in order, with others in between where a driver, or a link that pairs such as gears turn with it,
    turns farther than :data:`FAR`; at most :data:`MOST` for each."""
    for time, way in motion.kept("turning", lambda: _turning(motion)):
        passed = np.interp(edges, time, way)
        parts = np.ceil(np.diff(passed) / max(FAR, float(np.ptp(passed)) / MOST)).astype(int)
        if (parts > 1).any():
            more = [
                np.linspace(passed[k], passed[k + 1], parts[k] + 1)[1:-1] for k in np.flatnonzero(parts > 1)
            ]
            edges = np.sort(np.concatenate([edges, *(np.interp(each, way, time) for each in more)]))
    return edges


def _turning(motion: Motion) -> list[tuple[Floats, Floats]]:
    """Times, s, and the ways, rad, that what turns has gone by then: drivers by their laws, and links with them."""
    mechanism, order = motion.mechanism, np.argsort(motion.positions.around)
    time = motion.positions.around[order]
    laws = [driver.law for driver in mechanism.drivers.values() if driver.law.rotary]
    fastest = max((abs(law.constant_speed or 0.0) for law in laws), default=0.0)
    found = [(time[[0, -1]], fastest * (time[[0, -1]] - time[0]))]
    if not one_formula(mechanism):
        found.append(_search(motion).way)
    counted = [link for link in mechanism.links if motion.link(link).counted]
    for link in counted if motion.solver.motion.angles.pairs else ():
        rate = np.resize(motion.row("angular_velocity", link), len(time))[order]
        rate = np.abs(np.nan_to_num(rate))
        steps = np.maximum(rate[1:], rate[:-1]) * np.diff(time)
        found.append((time, np.append(0.0, np.cumsum(steps))))
    return found


@dataclass(frozen=True)
class Stretches:
    """``edges`` (k + 1,), s, between stretches of one formula each; ``period``, s, after which the first one comes
    again as the last one; ``places``, s, of each, with the positions of the motion ``before`` these."""

    edges: Floats
    period: float | None
    places: Floats
    before: Indices

    def inside(self, time: Floats) -> Flags:
        """Which times (n,), s, lie on no edge."""
        return self._pieces(time)[1]

    def resting(self, time: Floats, moving: Flags) -> Floats:
        """Begin and end (r, 2), s, of rests, from places (n,) of all stretches in which something is ``moving`` or
        not, those of no time between two ways among them; one across the end of a closed cycle in one piece, and its
        parts as well."""
        edges, (piece, inside) = self.edges, self._pieces(time)
        rests = np.ones(len(edges) - 1, dtype=np.int8)
        rests[piece[inside & moving]] = 0
        if self.period is not None:
            rests, edges = np.tile(rests, 2), np.append(edges, edges[1:] + self.period)
        change, between = np.diff(rests, prepend=0, append=0), time[~inside & ~moving]
        return np.concatenate(
            [np.stack([edges[change > 0], edges[change < 0]], axis=1), np.stack([between] * 2, axis=1)]
        )

    def _pieces(self, time: Floats) -> tuple[Indices, Flags]:
        """The stretch of each time (n,), s, and whether it lies inside."""
        edges = self.edges
        if self.period is not None:
            time = edges[0] + (time - edges[0]) % self.period
        near = SAME * (edges[-1] - edges[0])
        piece = np.clip(np.searchsorted(edges, time, "right") - 1, 0, len(edges) - 2)
        return piece, (time - edges[piece] > near) & (edges[piece + 1] - time > near)


def _search(motion: Motion) -> _Search:
    return motion.kept("bends", lambda: _Search(motion))


class _Search:
    """The bends of a motion, and the ``turns`` of links by which joints are measured, s."""

    def __init__(self, motion: Motion) -> None:
        self.motion, self.between = motion, Between(motion)
        time, positions = motion.time, motion.positions
        self.sense = 1.0 if time[-1] >= time[0] else -1.0
        self.period = positions.period
        self.low, self.high = float(positions.around.min()), float(positions.around.max())
        laws = [driver.law for driver in motion.mechanism.drivers.values()]
        self.bends = self._apart(*(law.breaks(self.low, self.high) for law in laws))
        self.turns = self._apart(np.empty(0), *(self._looks(law)[1] for law in laws))
        self.of_laws = self._apart(self.bends, self.turns)
        self.way = self._way([law for law in laws if law.rotary and law.constant_speed is None])
        for joint in self._in_turn():
            turns, bends = self._of_joint(joint)
            self.turns, self.bends = self._apart(self.turns, turns), self._apart(self.bends, bends)

    @cached_property
    def stretches(self) -> Stretches | None:
        """Those between all these times."""
        found = self._apart(self.bends, self.turns)
        if not len(found):
            return None
        if self.period is not None:
            edges = np.append(found, found[0] + self.period)
        else:
            inner = found[(found - self.low > self._same) & (self.high - found > self._same)]
            edges = np.concatenate([[self.low], inner, [self.high]])
        inner = (edges[:-1, None] + np.diff(edges)[:, None] * INNER).ravel()
        time, way = self.way
        places = self._apart(edges, inner, np.interp(np.arange(LEAP, way[-1], LEAP), way, time))
        return Stretches(edges, self.period, places, self._before(places))

    @property
    def _same(self) -> float:
        return SAME * (self.high - self.low)

    def _apart(self, *times: Floats) -> Floats:
        """All these times in order, within the cycle, those that are nearly the same once."""
        found = np.concatenate(times)
        if self.period is not None:
            found = self.low + (found - self.low) % self.period
        found = np.sort(found)
        return np.asarray(found[np.diff(found, prepend=-np.inf) > self._same])

    def _in_turn(self) -> list[Bends]:
        """Those of the joints, of what is solved first before."""
        groups = self.motion.structure.groups
        solved = {link: k for k, group in enumerate(groups) for link in group.links}
        found = [each.bends for each in self.motion.mechanism.joints.values() if each.bends is not None]
        return sorted(found, key=lambda bends: solved.get(bends.link, -1))

    def _looks(self, law: Law) -> tuple[Floats, Floats]:
        """Places, s, of all stretches of a law, and times at which the driver turns round."""
        if law.constant_speed is not None:
            return np.empty(0), np.empty(0)
        edges = np.concatenate([[self.low], law.breaks(self.low, self.high), [self.high]])
        time = (edges[:-1, None] + np.diff(edges)[:, None] * np.linspace(0.0, 1.0, LOOKS)).ravel()
        rate = law.coordinate(time)[1]
        at = np.flatnonzero(rate[:-1] * rate[1:] < 0.0)
        return time, zeros(lambda time: law.coordinate(time)[1:], time[at], time[at + 1], rate[at])

    def _way(self, laws: list[Law]) -> tuple[Floats, Floats]:
        """Times, s, with the way, rad, that drivers have turned by these laws since the motion began."""
        time = np.sort(
            np.concatenate([[self.low, self.high], *(each for law in laws for each in self._looks(law))])
        )
        steps = sum((np.abs(np.diff(law.coordinate(time)[0])) for law in laws), np.zeros(len(time) - 1))
        return time, np.append(0.0, np.cumsum(steps))

    def _of_joint(self, bends: Bends) -> tuple[Floats, Floats]:
        """Times at which its link turns round, and at which it goes over to another formula."""
        time = np.append(self.motion.time, [self.low, self.high] if self.period else [])
        time = np.sort(np.concatenate([time, self.bends, self.turns]))
        _, rate, _ = self._turned(bends, time)
        at = np.flatnonzero(rate[:-1] * rate[1:] < 0.0)

        def rates(at: Floats) -> tuple[Floats, Floats]:
            _, rate, second = self._turned(bends, at)
            return rate, second

        turns = zeros(rates, time[at], time[at + 1], rate[at])
        time = np.sort(np.append(time, turns))
        angle, *_ = self._turned(bends, time)
        angles = np.array(bends.angles) + self.motion.mechanism.dimension(bends.phase)
        first, last = ((end(angle) - angles) / TURN for end in (np.nanmin, np.nanmax))
        laps = np.arange(np.ceil(first.min()), np.floor(last.max()) + 1)
        asked = (angles + TURN * laps[:, None]).ravel()[:, None]
        on = np.abs(angle - asked) <= ON
        which, at = np.nonzero(
            ((angle - asked)[:, :-1] * (angle - asked)[:, 1:] < 0.0) & ~on[:, :-1] & ~on[:, 1:]
        )

        def beyond(at: Floats) -> tuple[Floats, Floats]:
            angle, rate, _ = self._turned(bends, at)
            return angle - asked[which, 0], rate

        passed = zeros(beyond, time[at], time[at + 1], angle[at] - asked[which, 0])
        return turns, np.append(passed, time[on.any(axis=0)])

    def _turned(self, bends: Bends, time: Floats) -> Floats:
        """Angle of its link to the carrier, rad, and its two rates, at some times, s."""
        motion, found = self.motion, np.zeros((3, len(time)))
        before = self._before(time)
        for link, sign in ((bends.link, 1.0), (bends.carrier, -1.0)):
            if link == "frame":
                continue
            rates = tuple(row_name(kind, link) for kind in ("angular_velocity", "angular_acceleration"))
            if motion.link(link).counted:
                found += sign * self.between.evaluate((row_name("turned_angle", link), *rates), before, time)
                continue
            x, y, rate, second = self.between.evaluate((*row_names("direction", link), *rates), before, time)
            near, raw = motion.link(link).angle[before], np.arctan2(y, x)
            found += sign * np.stack([raw + TURN * np.round((near - raw) / TURN), rate, second])
        return found

    def _before(self, time: Floats) -> Indices:
        """The position at or before each of some times, s."""
        known = np.searchsorted(self.sense * self.motion.time, self.sense * time, "right") - 1
        return np.clip(known, 0, self.motion.steps - 1)
