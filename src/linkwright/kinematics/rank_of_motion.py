"""Rank of the Jacobian of all joints where a mechanism is solved, and the fold at which it drops."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.errors import LinkwrightError
from linkwright.kinematics.constraint_equations import ConstraintEquations, Row, first_points, pose_outputs
from linkwright.kinematics.cycle import over_cycle
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.rank import ZERO, RankReport, numeric_rank, rank_at, report_of
from linkwright.kinematics.solve import MotionRun
from linkwright.kinematics.solver import MotionSolver
from linkwright.mechanism.mechanism import Mechanism
from linkwright.topology import Structure
from linkwright.words import _


def jacobian_rank(motion: Motion, index: int = 0) -> RankReport:
    """Rank of the constraint Jacobian of the mechanism at a solved position, by singular values.

    A singular value below 1e-9 of the largest counts as zero. Sees what counting cannot: passive constraints
    (Norton, Design of Machinery, ch. 2; Wittenburg, Dynamics of Multibody Systems, ch. 5). Special lengths and
    positions have no solved positions; of these :func:`rank_from_drawing` tells. Raises LinkwrightError if the
    position is not solved.
    """
    if not motion.ok[index]:
        raise LinkwrightError(
            _(
                "position {index} is not solved, so its Jacobian has no rank; choose another one",
                code="motion.no_rank",
                index=index,
            )
        )
    mechanism = motion.mechanism
    here = coordinates(motion, index)
    redundant: tuple[Row, ...] = ()
    rank = _rank_of_groups(mechanism, motion.structure, here)
    if rank is None:
        rank, redundant = rank_at(ConstraintEquations(mechanism), here, ZERO)
    return report_of(mechanism, rank, redundant, (), False, guides=motion.structure.redundant)


def rank_sentence(mechanism: Mechanism, language: str = "en") -> str:
    """What the rank of the Jacobian at the start of the cycle says about the mobility, or that a group is
    singular there; empty if it cannot be had."""
    try:
        ends = replace(over_cycle(mechanism, 1), cycle=False)
        outputs = (*pose_outputs(mechanism), "outcome")
        motion = MotionRun(MotionSolver(mechanism), ends).solve("mark", outputs)
    except LinkwrightError:
        return ""
    good = np.flatnonzero(motion.ok)
    if len(good):
        return jacobian_rank(motion, int(good[0])).translate(language)
    outcome = motion.outcomes[0]
    return (
        _("At the start of the cycle {outcome}, whatever the count says", outcome=outcome).translate(language)
        if outcome.kind == "singular"
        else ""
    )


def coordinates(motion: Motion, index: int) -> Floats:
    """(x, y, θ) of every link at a position, lengths over the size of the mechanism."""
    mechanism, found = motion.mechanism, []
    size, places = mechanism.size, first_points(mechanism)
    motion.rows.fetch(pose_outputs(mechanism), motion.evaluate)  # all in one program
    wheels = mechanism.higher
    for name, link in mechanism.links.items():
        c, s = motion.link(name).direction[index]
        px, py = next(iter(link.points.values()))
        x, y = motion.point_of(places[name]).position[index]
        found += [(x - c * px + s * py) / size, (y - s * px - c * py) / size]
        found.append(motion.link(name).angle[index] if wheels else math.atan2(s, c))
    return np.array(found)


def _rank_of_groups(mechanism: Mechanism, built: Structure, x: Floats) -> int | None:
    """The rank where every group alone is regular, its drivers held: then no equation of the mechanism implies
    another.

    Ordered as the groups are solved, the Jacobian of the joints and drivers has the groups' own ones on its diagonal
    and nothing above them. None where a group is not regular.
    """
    turn = {link: number for number, group in enumerate(built.groups) for link in group.links}
    system = ConstraintEquations(mechanism, order={"frame": -1, **turn})
    rows = [*system.rows(x), *(system.driver_row(name, x) for name in mechanism.drivers)]
    of_group: list[list[Row]] = [[] for _unused in built.groups]
    for row in rows:
        of_group[max(turn.get(link, -1) for link in row.parts)].append(row)
    for group, own in zip(built.groups, of_group, strict=True):
        if len(own) != 3 * len(group.links):
            return None
        matrix = [[entry for link in group.links for entry in row.parts.get(link, (0.0, 0.0, 0.0))] for row in own]
        if numeric_rank(np.array(matrix, dtype=float), ZERO) < len(own):
            return None
    return len(rows) - len(mechanism.drivers)


#: Largest equation (lengths over the size, rad) that a found fold may leave, and Newton steps to get there.
CLOSED = 1e-12
STEPS = 25
#: What rounding leaves of the equations.
ROUNDED = 2e-15


def fold(motion: Motion, driver: str) -> tuple[float, float] | None:
    """The driver's coordinate (rad or m) at the fold nearest to the last position of a motion; None if not found.

    With it the error that is left, which is larger where two folds almost meet.

    Newton's method on the joints, the other drivers' coordinates, J v = 0 and |v| = 1, in the coordinates x of
    all links and the direction v in which they can still move while all drivers stand still (Govaerts, Numerical
    Methods for Bifurcations of Dynamical Equilibria, ch. 4). Its derivatives are exact.
    """
    positions = motion.positions
    if not motion.ok[-1]:
        return None
    start = coordinates(motion, -1)
    search = _Fold(ConstraintEquations(motion.mechanism), driver, start)
    found = search.solve(start)
    if found is None:
        return None
    x, unsure = found
    value = float(search.coordinate(driver, x))
    if positions.rotary[driver]:
        near, unit = float(positions.coordinates[driver][0][-1]), 1.0
        value += 2 * math.pi * round((near - value) / (2 * math.pi))
    else:
        unit = search.system.size
    return value * unit, (unsure + ROUNDED * (1.0 + abs(value))) * unit


class _Fold:
    def __init__(self, system: ConstraintEquations, driver: str, start: Floats) -> None:
        self.system = system
        self.drivers = list(system.mechanism.drivers)
        self.held = {name: self.coordinate(name, start) for name in self.drivers if name != driver}

    def coordinate(self, driver: str, x: Floats) -> float:
        """A driver's coordinate; lengths over the size."""
        return self.system.driver_row(driver, x).value

    def solve(self, start: Floats) -> tuple[Floats, float] | None:
        """Coordinates of all links at the fold, and what rounding leaves of them."""
        x = start
        v = np.linalg.svd(self._jacobian(x))[2][-1]
        normal = v.copy()
        for _step in range(STEPS):
            gap = np.concatenate([self._position(x), self._jacobian(x) @ v, [normal @ v - 1.0]])
            step = np.linalg.lstsq(self._derivative(x, v, normal), gap, rcond=None)[0]
            x, v = x - step[: len(x)], v - step[len(x) :]
            if not np.isfinite(x).all() or np.abs(x - start).max() > 0.5:
                return None
            if np.abs(step).max() < 1e-13:
                break
        left = max(np.abs(self._position(x)).max(), np.abs(self._jacobian(x) @ v).max())
        if left > CLOSED:
            return None
        smallest = float(np.linalg.svd(self._derivative(x, v, normal), compute_uv=False)[-1])
        return x, float(np.abs(step).max()) + ROUNDED / smallest

    def _position(self, x: Floats) -> Floats:
        held = [self.system.driver_row(name, x).value - q for name, q in self.held.items()]
        return np.concatenate([self.system.residual(x), held])

    def _jacobian(self, x: Floats) -> Floats:
        return self.system.matrix([*self.system.rows(x), *(self.system.driver_row(n, x) for n in self.drivers)])

    def _held_jacobian(self, x: Floats) -> Floats:
        rows = [*self.system.rows(x), *(self.system.driver_row(name, x) for name in self.held)]
        return self.system.matrix(rows)

    def _derivative(self, x: Floats, v: Floats, normal: Floats) -> Floats:
        top = self._held_jacobian(x)
        return np.block(
            [
                [top, np.zeros_like(top)],
                [self.system.second(x, v), self._jacobian(x)],
                [np.zeros((1, len(x))), normal[None, :]],
            ]
        )
