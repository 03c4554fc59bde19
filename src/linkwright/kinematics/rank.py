"""Rank of the Jacobian of all joints, and what it says against Grübler's count.

Coordinates of a link are the place of its origin and its angle; all lengths are divided by the size of the
mechanism, so that rows and columns compare. Drivers are left out: what is found is the mobility.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from linkwright.core.dataclass import dataclass
from linkwright.core.outputs import row_names
from linkwright.errors import LinkwrightError
from linkwright.joints.lower import SlidingJoint
from linkwright.kinematics.cycle import Floats
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.names import canonical
from linkwright.mechanism.drawing import Drawing
from linkwright.mechanism.geometry import mechanism_size
from linkwright.mechanism.mechanism import Mechanism
from linkwright.structure import Structure
from linkwright.structure.mobility import counts, grubler
from linkwright.words.sentence import Sentence

#: Singular values below this share of the largest one count as zero: at solved positions, and in a drawing.
ZERO = 1e-9
ZERO_DRAWN = 1e-6
#: A drawing whose joints gape by less than this share of the size closes.
CLOSED = 1e-9

Numbers = NDArray[Any]
Parts = Mapping[str, Sequence[Any]]


@dataclass(frozen=True)
class Row:
    """One scalar equation: its joint, what it holds (``place`` or ``rotation``), its value, its derivatives."""

    joint: str
    holds: str
    value: Any
    parts: Parts


@dataclass(frozen=True)
class RankReport:
    """Mobility by rank: ``mobility`` = ``freedoms`` - ``rank``, of ``equations`` rows.

    ``redundant``: equations that others already demand, such as ``rotation at slot_2``; ``links``: links that
    could be taken out without changing the motion; ``special``: whether the rank is smaller here than in
    neighbouring positions; ``grubler``: 3n - 2p; ``sentence``: all this in words, in English.
    """

    rank: int
    freedoms: int
    equations: int
    grubler: int
    redundant: tuple[str, ...]
    links: tuple[str, ...]
    special: bool
    sentence: Sentence

    @property
    def mobility(self) -> int:
        """Number of independent (at a special position instantaneous) freedoms of the mechanism."""
        return self.freedoms - self.rank

    def say(self, language: str = "en") -> str:
        """The sentence in a language."""
        return self.sentence.say(language)


def jacobian_rank(motion: Motion, index: int = 0) -> RankReport:
    """Rank of the constraint Jacobian of the whole mechanism at a solved position, by singular values.

    A singular value below 1e-9 of the largest counts as zero. Sees what counting cannot: passive constraints
    (Norton, Design of Machinery, ch. 2; Wittenburg, Dynamics of Multibody Systems, ch. 5). Special lengths and
    positions have no solved positions; of these :func:`rank_from_drawing` tells. Raises LinkwrightError if the
    position is not solved.
    """
    if not motion.ok[index]:
        raise LinkwrightError(Sentence("motion.no_rank", index=index))
    mechanism = motion.mechanism
    system = ConstraintSystem(mechanism)
    here = coordinates(motion, index)
    if _regular_in_groups(mechanism, motion.structure, here):
        rank, redundant = len(system.rows(here)), tuple[Sentence, ...]()
    else:
        rank, redundant = _rank(system, here, ZERO)
    return _report(mechanism, system, rank, redundant, (), False, False, motion.structure.redundant)


def rank_from_drawing(mechanism: Mechanism) -> RankReport | None:
    """Rank in the position of the drawing, for models that counting refuses.

    The drawn coordinates are first moved to the nearest ones that the joints allow. ``special`` then means that
    the mechanism cannot leave that position. None without a drawing that places every link.
    """
    drawn = _drawn(mechanism)
    if drawn is None:
        return None
    system = ConstraintSystem(mechanism)
    here, gap = _closed(system, drawn)
    rank, redundant = _rank(system, here, ZERO_DRAWN)
    if gap > CLOSED:
        return _gaping(mechanism, system, rank, redundant, gap)
    special = rank < system.freedoms and not _moves(system, here, rank)
    links = () if special else _spare_links(mechanism, here, ZERO_DRAWN)
    return _report(mechanism, system, rank, redundant, links, special, True, ())


def rank_sentence(mechanism: Mechanism, language: str = "en") -> str:
    """What the rank of the Jacobian at the start of the cycle says about the mobility; empty if it cannot be had."""
    from linkwright.kinematics.cycle import over_cycle
    from linkwright.kinematics.solve import MotionRun
    from linkwright.kinematics.solver import MotionSolver

    try:
        ends = replace(over_cycle(mechanism, 1), cycle=False)
        outputs = (*_pose_outputs(mechanism), "outcome")
        motion = MotionRun(MotionSolver(mechanism), ends).solve("mark", outputs)
    except LinkwrightError:
        return ""
    good = np.flatnonzero(motion.ok)
    return jacobian_rank(motion, int(good[0])).say(language) if len(good) else ""


# equations ----------------------------------------------------------------------------------------
class ConstraintSystem:
    """Equations of the joints of a mechanism over (x, y, θ) of every link.

    A pin of several links holds each of them to the first one, in the ``order`` given or that of the file.

    Works on complex numbers as well, for exact derivatives by complex steps.
    """

    def __init__(self, mechanism: Mechanism, order: Mapping[str, int] | None = None) -> None:
        number = order or {}
        self.mechanism = mechanism
        self.links = list(mechanism.links)
        self.size = mechanism_size(mechanism)
        self._rest: dict[str, float] = {}
        self._first = {name: 3 * i for i, name in enumerate(self.links)}
        self._joints = [
            (joint, tuple(sorted(joint.joined, key=lambda link: number.get(link, 0))))
            for joint in mechanism.joints.values()
        ]

    @property
    def freedoms(self) -> int:
        """Three of every link."""
        return 3 * len(self.links)

    def rows(self, x: Numbers) -> list[Row]:
        """All equations at some coordinates."""
        poses = {"frame": Place(0.0, 0.0, 0.0)}
        poses |= {name: Place(*x[i : i + 3]) for name, i in self._first.items()}
        return [row for joint, kept in self._joints for row in joint.rows(self, kept, poses)]

    def residual(self, x: Numbers) -> Numbers:
        """Values of the equations; lengths over the size."""
        return np.array([row.value for row in self.rows(x)])

    def jacobian(self, x: Numbers) -> Numbers:
        """Derivatives of the equations, (equations, freedoms)."""
        return self.matrix(self.rows(x))

    def matrix(self, rows: Sequence[Row]) -> Numbers:
        """The derivatives of some equations as a matrix."""
        kind = complex if any(isinstance(row.value, complex) for row in rows) else float
        entries = np.zeros((len(rows), self.freedoms), dtype=kind)
        for entry, row in zip(entries, rows, strict=True):
            for link, part in row.parts.items():
                if link in self._first:
                    entry[self._first[link] : self._first[link] + 3] += part
        return entries

    def driver_row(self, name: str, x: Numbers) -> Row:
        """A driver's coordinate (rad, or m over the size) with its derivatives."""
        driver = self.mechanism.drivers[name]
        joint: Any = self.mechanism.joints[driver.joint]
        poses = {"frame": Place(0.0, 0.0, 0.0)}
        poses |= {link: Place(*x[i : i + 3]) for link, i in self._first.items()}
        if joint.coordinate == "slide":
            return self.along(joint, poses, across=False)
        a, b = driver.relative_to, driver.link
        return Row(joint.name, "driver", poses[b].angle - poses[a].angle, {a: (0, 0, -1.0), b: (0, 0, 1.0)})

    def kept(self, joint: str, gap: Any, parts: Parts) -> Row:
        """The row of a higher pair: ``gap``, over the size where it is a length, keeps the value that it has where it
        is first seen; ``parts``: its derivatives by (x, y, θ) of its links."""
        rest = self._rest.setdefault(joint, float(np.real(gap)))
        return Row(joint, "rolling", gap - rest, parts)

    def local(self, link: str, point: str) -> tuple[float, float]:
        """A point in the axes of its link, over the size."""
        x, y = self.mechanism.link(link).points[point]
        return x / self.size, y / self.size

    def pin(self, joint: str, a: str, b: str, point: str, poses: Mapping[str, Place]) -> Iterable[Row]:
        (ax, ay), (bx, by) = (poses[link].arm(self.local(link, point)) for link in (a, b))
        p, q = poses[a], poses[b]
        yield Row(joint, "place", p.x + ax - q.x - bx, {a: (1.0, 0.0, -ay), b: (-1.0, 0.0, by)})
        yield Row(joint, "place", p.y + ay - q.y - by, {a: (0.0, 1.0, ax), b: (0.0, -1.0, -bx)})

    @staticmethod
    def rotation(joint: str, a: str, b: str, turn: float, poses: Mapping[str, Place]) -> Row:
        difference = poses[b].angle - poses[a].angle - turn
        c = np.cos(difference)
        return Row(joint, "rotation", np.sin(difference), {a: (0.0, 0.0, -c), b: (0.0, 0.0, c)})

    def along(self, joint: SlidingJoint, poses: Mapping[str, Place], *, across: bool) -> Row:
        """The block's place along the guide, or its distance across it."""
        guide, block = poses[joint.guide], poses[joint.block]
        direction = joint.direction + (0.5 * math.pi if across else 0.0)
        nx, ny = guide.arm((math.cos(direction), math.sin(direction)))
        tx, ty = guide.arm(self.local(joint.guide, joint.through))
        bx, by = block.arm(self.local(joint.block, joint.at))
        gx, gy = block.x + bx - guide.x - tx, block.y + by - guide.y - ty
        value = nx * gx + ny * gy - (joint.offset / self.size if across else 0.0)
        turned = nx * ty - ny * tx + nx * gy - ny * gx
        parts = {joint.guide: (-nx, -ny, turned), joint.block: (nx, ny, ny * bx - nx * by)}
        return Row(joint.name, "place", value, parts)


class Place:
    """Place and direction of a link."""

    __slots__ = ("angle", "c", "s", "x", "y")

    def __init__(self, x: Any, y: Any, angle: Any) -> None:
        self.x, self.y, self.angle = x, y, angle
        self.c, self.s = np.cos(angle), np.sin(angle)

    def arm(self, local: tuple[float, float]) -> tuple[Any, Any]:
        """A vector of the link's axes in frame axes."""
        return self.c * local[0] - self.s * local[1], self.s * local[0] + self.c * local[1]


def coordinates(motion: Motion, index: int) -> Floats:
    """(x, y, θ) of every link at a position, lengths over the size of the mechanism."""
    mechanism, found = motion.mechanism, []
    size, places = mechanism_size(mechanism), _first_points(mechanism)
    motion.rows.fetch(_pose_outputs(mechanism), motion.evaluate)  # all in one program
    wheels = mechanism.higher
    for name, link in mechanism.links.items():
        c, s = motion.link(name).direction[index]
        px, py = next(iter(link.points.values()))
        x, y = motion.point_of(places[name]).position[index]
        found += [(x - c * px + s * py) / size, (y - s * px - c * py) / size]
        found.append(motion.link(name).angle[index] if wheels else math.atan2(s, c))
    return np.array(found)


def _first_points(mechanism: Mechanism) -> dict[str, str]:
    """The first point of every link."""
    return {
        name: canonical(mechanism, name, next(iter(link.points))) for name, link in mechanism.links.items()
    }


def _pose_outputs(mechanism: Mechanism) -> tuple[str, ...]:
    """Names of the outputs that tell where every link is."""
    wanted = [
        row_names(*each)
        for name, key in _first_points(mechanism).items()
        for each in (("direction", name), ("position", key))
    ]
    return tuple(dict.fromkeys(name for pair in wanted for name in pair))


def _drawn(mechanism: Mechanism) -> Floats | None:
    drawing = Drawing(mechanism)
    if not drawing:
        return None
    size, found = mechanism_size(mechanism), []
    for name, link in mechanism.links.items():
        angle = drawing.angle(name)
        places = ((p, drawing.points.get(f"{name}.{p}", drawing.points.get(p))) for p in link.points)
        known = next(((link.points[p], place) for p, place in places if place is not None), None)
        if angle is None or known is None:
            return None
        (px, py), (x, y) = known
        c, s = math.cos(angle), math.sin(angle)
        found += [(x - c * px + s * py) / size, (y - s * px - c * py) / size, angle]
    return np.array(found)


# rank ---------------------------------------------------------------------------------------------
def _regular_in_groups(mechanism: Mechanism, built: Structure, x: Floats) -> bool:
    """Whether every group alone is regular, its drivers held: then no equation of the whole implies another.

    Ordered as the groups are solved, the Jacobian of the joints and drivers has the groups' own ones on its diagonal
    and nothing above them.
    """
    turn = {link: number for number, group in enumerate(built.groups) for link in group.links}
    system = ConstraintSystem(mechanism, order={"frame": -1, **turn})
    rows = [*system.rows(x), *(system.driver_row(name, x) for name in mechanism.drivers)]
    of_group: list[list[Row]] = [[] for _ in built.groups]
    for row in rows:
        of_group[max(turn.get(link, -1) for link in row.parts)].append(row)
    for group, own in zip(built.groups, of_group, strict=True):
        if len(own) != 3 * len(group.links):
            return False
        matrix = [
            [entry for link in group.links for entry in row.parts.get(link, (0.0, 0.0, 0.0))] for row in own
        ]
        if _numeric_rank(np.array(matrix, dtype=float), ZERO) < len(own):
            return False
    return True


def _rank(system: ConstraintSystem, x: Floats, zero: float) -> tuple[int, tuple[Sentence, ...]]:
    """Rank, and the equations that those before them imply (the last ones of each dependence)."""
    rows = system.rows(x)
    matrix = system.matrix(rows)
    redundant = []
    rank = _numeric_rank(matrix, zero)
    if rank == len(rows):
        return rank, ()
    independent, found = np.empty((rank, system.freedoms)), 0
    for row, vector in zip(rows, matrix, strict=True):
        left = vector
        for _ in range(2):
            left = left - (independent[:found] @ left) @ independent[:found]
        length = float(np.linalg.norm(left))
        if length > math.sqrt(zero) * float(np.linalg.norm(vector)) and found < rank:
            independent[found] = left / length
            found += 1
        else:
            redundant.append(Sentence(f"rank.{row.holds}", joint=row.joint))
    return rank, tuple(redundant)


def _numeric_rank(matrix: Floats, zero: float) -> int:
    if not matrix.size:
        return 0
    values = np.linalg.svd(matrix, compute_uv=False)
    return int((values > zero * values[0]).sum())


def _null_space(matrix: Floats, rank: int) -> Floats:
    """Orthonormal vectors that a matrix of this rank takes to zero, as columns."""
    from scipy.linalg import qr

    full: Floats = qr(matrix.T, pivoting=True)[0]
    return full[:, rank:]


def _spare_links(mechanism: Mechanism, x: Floats, zero: float) -> tuple[str, ...]:
    """Links without which the mobility stays the same and Grübler's count comes up to it; last ones first.

    By the states of self-stress, the multipliers that need no load: without a link those remain that put no force on
    it at any of its joints, and each of them is one redundant equation.
    """
    full = ConstraintSystem(mechanism)
    rows = full.rows(x)
    matrix = full.matrix(rows)
    rank = _numeric_rank(matrix, zero)
    mobility, states = full.freedoms - rank, np.eye(len(rows) - rank)
    forces = _forces_on_links(full, rows, _null_space(matrix.T, rank))
    keep = {name for driver in mechanism.drivers.values() for name in (driver.link, driver.relative_to)}
    spare: list[str] = []
    for name in reversed(list(mechanism.links)):
        if name in keep or not states.size:
            continue
        _, sizes, directions = np.linalg.svd(forces[name] @ states)
        needed = int((sizes > math.sqrt(zero)).sum())
        trial, remaining = [*spare, name], states @ directions[needed:].T
        if needed and _freedoms_without(full, rows, trial) + remaining.shape[1] == mobility:
            spare, states = trial, remaining
    return tuple(spare)


def _forces_on_links(system: ConstraintSystem, rows: Sequence[Row], states: Floats) -> dict[str, Floats]:
    """Forces and moments of every joint on every link in all states of self-stress; by link (3 joints, states)."""
    found: dict[str, dict[str, Floats]] = {name: {} for name in system.links}
    none = np.zeros((3, states.shape[1]))
    for row, multipliers in zip(rows, states, strict=True):
        for link, part in row.parts.items():
            if link in found:
                acting = np.outer(np.array(part, dtype=float), multipliers)
                found[link][row.joint] = found[link].get(row.joint, none) + acting
    return {link: np.concatenate([*by_joint.values(), none]) for link, by_joint in found.items()}


def _freedoms_without(full: ConstraintSystem, rows: Sequence[Row], without: Sequence[str]) -> int:
    """Freedoms by Grübler's count, the equations that are redundant counted as the others."""
    equations, left = Counter(row.joint for row in rows), frozenset(without)
    lost = 0
    for joint in full.mechanism.joints.values():
        kept = sum(link not in left for link in joint.joined)
        each = equations[joint.name] // (len(joint.joined) - 1)
        lost += each * max(kept - 1, 0)
    return 3 * (len(full.links) - len(left)) - lost


# drawings -----------------------------------------------------------------------------------------
def _closed(system: ConstraintSystem, x: Floats) -> tuple[Floats, float]:
    """The nearest coordinates that satisfy the joints (Gauss and Newton, shortest steps), and what still gapes.

    Ends where steps are zero, or so short that only rounding is left of them: they do not become shorter.
    """
    from scipy.linalg import lstsq

    before = math.inf
    for _ in range(60):
        rows = system.rows(x)
        gap = np.array([row.value for row in rows])
        step = lstsq(system.matrix(rows), gap, cond=1e-9, lapack_driver="gelsy")[0] if rows else 0.0 * x
        length = float(np.linalg.norm(step))
        x = x - step * min(1.0, 0.5 / max(length, 1e-300))
        if length < 1e-15 or (length < 1e-10 and length > 0.5 * before):
            break
        before = length
    return x, float(np.abs(system.residual(x)).max(initial=0.0))


def _moves(system: ConstraintSystem, x: Floats, rank: int) -> bool:
    """Whether a small finite motion along one of the free directions exists at the same rank."""
    for direction in _null_space(system.jacobian(x), rank).T:
        there, gap = _closed(system, x + 0.03 * direction)
        moved = float(np.linalg.norm(there - x))
        if gap <= CLOSED and moved > 0.015 and _numeric_rank(system.jacobian(there), ZERO_DRAWN) <= rank:
            return True
    return False


# sentences ----------------------------------------------------------------------------------------
def _report(
    mechanism: Mechanism,
    system: ConstraintSystem,
    rank: int,
    redundant: tuple[str, ...],
    links: tuple[str, ...],
    special: bool,
    drawn: bool,
    guides: tuple[str, ...],
) -> RankReport:
    count = grubler(counts(mechanism))
    mobility = system.freedoms - rank
    equations = system.freedoms - count
    make = partial(RankReport, rank, system.freedoms, equations, count, redundant, links, special)
    where = "_drawn" if drawn else ""
    if mobility == count:
        return make(Sentence(f"rank.confirmed{where}", count=count))
    wheels = bool(guides) and all(mechanism.joints[name].higher for name in guides)
    reason = _reason(redundant, links, special, guides, wheels)
    return make(Sentence(f"rank.differs{where}", count=count, mobility=mobility, reason=reason))


def _reason(
    redundant: tuple[str, ...],
    links: tuple[str, ...],
    special: bool,
    guides: tuple[str, ...],
    wheels: bool,
) -> Sentence:
    if special:
        return Sentence("rank.special", redundant=redundant)
    if links:
        named = tuple(Sentence("rank.named", name=name) for name in links)
        return Sentence("rank.links" if len(links) > 1 else "rank.link", links=named)
    if guides and wheels:
        return Sentence("rank.wheels", pairs=guides, redundant=redundant)
    if guides:
        return Sentence(
            "rank.guides" if len(guides) > 1 else "rank.guide", guides=guides, redundant=redundant
        )
    return Sentence("rank.passive", redundant=redundant)


def _gaping(
    mechanism: Mechanism, system: ConstraintSystem, rank: int, redundant: tuple[str, ...], gap: float
) -> RankReport:
    from linkwright.units import format

    count = grubler(counts(mechanism))
    said = Sentence("rank.gaping", count=count, gap=format(gap * system.size, "length"))
    return RankReport(rank, system.freedoms, system.freedoms - count, count, redundant, (), False, said)
