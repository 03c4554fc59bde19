"""Rank of the Jacobian of all joints, and what it says against Grübler's count.

Drivers are left out: what is found is the mobility.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.quantity import length_text
from linkwright.kinematics.constraint_equations import ConstraintEquations, Row, drawn_coordinates
from linkwright.mechanism.mechanism import Mechanism
from linkwright.topology.mobility import counts, grubler
from linkwright.words import Message, _

#: Singular values below this share of the largest one count as zero: at solved positions, and in a drawing.
ZERO = 1e-9
ZERO_DRAWN = 1e-6
#: A drawing whose joints gape by less than this share of the size closes.
CLOSED = 1e-9
#: Of at most so many links positions are sought from places at random: from so many of these, until so many close.
MAX_LINKS, ATTEMPTS, MAX_POSITIONS = 30, 16, 4


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
    sentence: Message

    @property
    def mobility(self) -> int:
        """Number of independent (at a special position instantaneous) freedoms of the mechanism."""
        return self.freedoms - self.rank

    def translate(self, language: str = "en") -> str:
        """The sentence in a language."""
        return self.sentence.translate(language)


def rank_from_drawing(mechanism: Mechanism) -> RankReport | None:
    """Rank in the position of the drawing, for models that counting refuses.

    The drawn coordinates are first moved to the nearest ones that the joints allow. ``special`` then means that
    the mechanism cannot leave that position. None without a drawing that places every link.
    """
    drawn = drawn_coordinates(mechanism)
    if drawn is None:
        return None
    system = ConstraintEquations(mechanism)
    here, gap = _closed(system, drawn)
    if gap > CLOSED:
        return _gaping(mechanism, system, *rank_at(system, here, ZERO_DRAWN), gap)
    return _rank_where_closed(mechanism, system, here, "_drawn")


def rank_from_dimensions(mechanism: Mechanism) -> RankReport | None:
    """Rank where the joints close by the dimensions alone, for models without a drawing that counting refuses.

    Positions are sought from all links strewn at random, the same at every call; the one of maximum rank
    counts, as others may be special. None where no position is found, where the rank confirms the count, of higher
    pairs, whose phases a position found so need not keep, and of more than 30 links.
    """
    system = ConstraintEquations(mechanism)
    if mechanism.higher or len(system.links) > MAX_LINKS:
        return None
    here, rank = _assembled(system)
    if here is None or system.freedoms - rank == grubler(counts(mechanism)):
        return None
    return _rank_where_closed(mechanism, system, here, "_assembled")


def _rank_where_closed(mechanism: Mechanism, system: ConstraintEquations, here: Floats, where: str) -> RankReport:
    rank, redundant = rank_at(system, here, ZERO_DRAWN)
    special = rank < system.freedoms and not _moves(system, here, rank)
    links = () if special else _spare_links(mechanism, here, ZERO_DRAWN)
    joints = () if special or links else _spare_joints(system.rows(here), redundant)
    return report_of(mechanism, rank, redundant, links, special, where, joints=joints)


# rank ---------------------------------------------------------------------------------------------
def rank_at(system: ConstraintEquations, x: Floats, zero: float) -> tuple[int, tuple[Row, ...]]:
    """Rank, and the equations that those before them imply (the last ones of each dependence)."""
    rows = system.rows(x)
    matrix = system.matrix(rows)
    redundant = []
    rank = numeric_rank(matrix, zero)
    if rank == len(rows):
        return rank, ()
    independent, found = np.empty((rank, system.freedoms)), 0
    for row, vector in zip(rows, matrix, strict=True):
        left = vector
        for _unused in range(2):
            left = left - (independent[:found] @ left) @ independent[:found]
        length = float(np.linalg.norm(left))
        if length > math.sqrt(zero) * float(np.linalg.norm(vector)) and found < rank:
            independent[found] = left / length
            found += 1
        else:
            redundant.append(row)
    return rank, tuple(redundant)


def numeric_rank(matrix: Floats, zero: float) -> int:
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
    full = ConstraintEquations(mechanism)
    rows = full.rows(x)
    matrix = full.matrix(rows)
    rank = numeric_rank(matrix, zero)
    mobility, states = full.freedoms - rank, np.eye(len(rows) - rank)
    forces = _forces_on_links(full, rows, _null_space(matrix.T, rank))
    keep = {name for driver in mechanism.drivers.values() for name in (driver.link, driver.relative_to)}
    spare: list[str] = []
    for name in reversed(list(mechanism.links)):
        if name in keep or not states.size:
            continue
        _unused, sizes, directions = np.linalg.svd(forces[name] @ states)
        needed = int((sizes > math.sqrt(zero)).sum())
        trial, remaining = [*spare, name], states @ directions[needed:].T
        if needed and _freedoms_without(full, rows, trial) + remaining.shape[1] == mobility:
            spare, states = trial, remaining
    return tuple(spare)


def _spare_joints(rows: Sequence[Row], redundant: Sequence[Row]) -> tuple[str, ...]:
    """Joints that others imply altogether, if these are all that is redundant."""
    equations, implied = (Counter(row.joint for row in some) for some in (rows, redundant))
    return tuple(implied) if all(implied[joint] == equations[joint] for joint in implied) else ()


def _forces_on_links(system: ConstraintEquations, rows: Sequence[Row], states: Floats) -> dict[str, Floats]:
    """Forces and moments of every joint on every link in all states of self-stress; by link (3 joints, states)."""
    found: dict[str, dict[str, Floats]] = {name: {} for name in system.links}
    none = np.zeros((3, states.shape[1]))
    for row, multipliers in zip(rows, states, strict=True):
        for link, part in row.parts.items():
            if link in found:
                acting = np.outer(np.array(part, dtype=float), multipliers)
                found[link][row.joint] = found[link].get(row.joint, none) + acting
    return {link: np.concatenate([*by_joint.values(), none]) for link, by_joint in found.items()}


def _freedoms_without(full: ConstraintEquations, rows: Sequence[Row], without: Sequence[str]) -> int:
    """Freedoms by Grübler's count, the equations that are redundant counted as the others."""
    equations, left = Counter(row.joint for row in rows), frozenset(without)
    lost = 0
    for joint in full.mechanism.joints.values():
        links_left = sum(link not in left for link in joint.joined)
        each = equations[joint.name] // (len(joint.joined) - 1)
        lost += each * max(links_left - 1, 0)
    return 3 * (len(full.links) - len(left)) - lost


# drawings -----------------------------------------------------------------------------------------
def _closed(system: ConstraintEquations, x: Floats, held: str | None = None) -> tuple[Floats, float]:
    """The nearest coordinates that satisfy the joints (Gauss and Newton, shortest steps), and what still gapes.

    Ends where steps are zero, or so short that only rounding is left of them: they do not become shorter. ``held``: a
    driver that keeps its coordinate.
    """
    from scipy.linalg import lstsq

    before = math.inf
    for _unused in range(60):
        rows = system.rows(x)
        gap = np.array([row.value for row in rows])
        if held is not None:
            rows, gap = [*rows, system.driver_row(held, x)], np.append(gap, 0.0)
        step = lstsq(system.matrix(rows), gap, cond=1e-9, lapack_driver="gelsy")[0] if rows else 0.0 * x
        length = float(np.linalg.norm(step))
        x = x - step * min(1.0, 0.5 / max(length, 1e-300))
        if length < 1e-15 or (length < 1e-10 and length > 0.5 * before):
            break
        before = length
    return x, float(np.abs(system.residual(x)).max(initial=0.0))


def _assembled(system: ConstraintEquations) -> tuple[Floats | None, int]:
    """Coordinates that satisfy the joints and the rank there, the maximum among some; None where none are found.

    The first driver is held where it was strewn, as steps that move everything often end in special positions.
    """
    random, found = np.random.default_rng(0), list[tuple[Floats | None, int]]()
    extent = np.tile([1.0, 1.0, math.pi], len(system.links))
    for _unused in range(ATTEMPTS):
        strewn = random.uniform(-1.0, 1.0, system.freedoms) * extent
        here, gap = _closed(system, strewn, held=next(iter(system.mechanism.drivers), None))
        if gap <= CLOSED:
            found.append((here, numeric_rank(system.jacobian(here), ZERO_DRAWN)))
        if len(found) == MAX_POSITIONS:
            break
    return max(found, key=lambda each: each[1], default=(None, 0))


def _moves(system: ConstraintEquations, x: Floats, rank: int) -> bool:
    """Whether a small finite motion along one of the free directions exists at the same rank."""
    for direction in _null_space(system.jacobian(x), rank).T:
        there, gap = _closed(system, x + 0.03 * direction)
        moved = float(np.linalg.norm(there - x))
        if gap <= CLOSED and moved > 0.015 and numeric_rank(system.jacobian(there), ZERO_DRAWN) <= rank:
            return True
    return False


# sentences ----------------------------------------------------------------------------------------
#: Where the rank was taken: at the start, in the drawing, where the joints close.
_CONFIRMED = {
    "": _("Grübler's mobility {count} is confirmed by the rank of the Jacobian", code="rank.confirmed"),
    "_drawn": _(
        "Grübler's mobility {count} is confirmed by the rank of the Jacobian in the drawing",
        code="rank.confirmed_drawn",
    ),
}
_DIFFERS = {
    "": _("Grübler gives {count}, but the rank of the Jacobian gives {mobility}: {reason}", code="rank.differs"),
    "_drawn": _(
        "Grübler gives {count}, but the rank of the Jacobian in the drawing gives {mobility}: {reason}",
        code="rank.differs_drawn",
    ),
    "_assembled": _(
        "Grübler gives {count}, but the rank of the Jacobian where the joints close gives {mobility}: {reason}",
        code="rank.differs_assembled",
    ),
}
_HELD = {"place": _("place at {joint}"), "rotation": _("rotation at {joint}"), "rolling": _("rolling at {joint}")}


def report_of(
    mechanism: Mechanism,
    rank: int,
    implied: Sequence[Row],
    links: tuple[str, ...],
    special: bool,
    where: str = "",
    guides: tuple[str, ...] = (),
    joints: tuple[str, ...] = (),
) -> RankReport:
    count = grubler(counts(mechanism))
    freedoms = 3 * len(mechanism.links)
    mobility = freedoms - rank
    equations, redundant = freedoms - count, _messages(implied)
    make = partial(RankReport, rank, freedoms, equations, count, redundant, links, special)
    if mobility == count:
        return make(_CONFIRMED[where].format(count=count))
    wheels = bool(guides) and all(mechanism.joints[name].higher for name in guides)
    if joints:
        reason = (
            _("the joints {joints} demand only what others demand already in this special geometry; remove them")
            if len(joints) > 1
            else _(
                "the joint {joints} demands only what others demand already in this special geometry; remove it",
                code="rank.joint",
            )
        ).format(joints=_named(joints))
    else:
        reason = _reason(redundant, links, special, guides, wheels)
    return make(_DIFFERS[where].format(count=count, mobility=mobility, reason=reason))


def _reason(
    redundant: tuple[str, ...], links: tuple[str, ...], special: bool, guides: tuple[str, ...], wheels: bool
) -> Message:
    if special:
        return _(
            "this is a special position, where the joints' equations are dependent "
            "({redundant}); the additional freedom is lost as soon as the mechanism leaves it",
            redundant=redundant,
        )
    if links:
        return (
            _("the links {links} are redundant in this special geometry; remove them")
            if len(links) > 1
            else _("the link {links} is redundant in this special geometry; remove it", code="rank.link")
        ).format(links=_named(links))
    if guides and wheels:
        return _(
            "the pairs {pairs} demand again what others demand already ({redundant})",
            pairs=guides,
            redundant=redundant,
        )
    if guides:
        return (
            _("the guides {guides} close a loop in which rotation is already prevented ({redundant})")
            if len(guides) > 1
            else _(
                "the guide {guides} closes a loop in which rotation is already prevented ({redundant})",
                code="rank.guide",
            )
        ).format(guides=guides, redundant=redundant)
    return _(
        "passive constraints ({redundant}) demand what other joints already demand, by the special lengths",
        redundant=redundant,
    )


def _named(names: Sequence[str]) -> tuple[Message, ...]:
    return tuple(_("'{name}'", name=name) for name in names)


def _messages(rows: Sequence[Row]) -> tuple[Message, ...]:
    return tuple(_HELD[row.holds].format(joint=row.joint) for row in rows)


def _gaping(
    mechanism: Mechanism, system: ConstraintEquations, rank: int, implied: Sequence[Row], gap: float
) -> RankReport:
    count = grubler(counts(mechanism))
    message = _(
        "Grübler gives {count}; the links do not fit together near the drawing: at best a "
        "gap of {gap} is left, so no link is redundant there",
        code="rank.gaping",
        count=count,
        gap=length_text(gap * system.size, 3),
    )
    return RankReport(rank, system.freedoms, system.freedoms - count, count, _messages(implied), (), False, message)
