"""How far a force on a point moves a machine at rest: by its stiffness there, and exactly for a force of any size."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from linkwright.core.arguments import require_pair
from linkwright.core.arrays import Floats
from linkwright.dynamics.static_forces import StaticForces
from linkwright.dynamics.zeros import root
from linkwright.errors import LinkwrightError
from linkwright.words import _

#: Places on the way of one input, and steps in which a force on several inputs grows.
PLACES, STEPS = 1440, 40
#: Newton's steps of one of these.
ITERATIONS = 12
CONVERGED = 1e-10


@dataclass(frozen=True)
class Displacement:
    """Where a machine comes to rest under a slowly growing ``force`` (2,), N, on a ``point``.

    ``linear`` and ``exact``: the point's displacement (2,), m, by the stiffness at the beginning, and in truth;
    ``inputs`` the free inputs there, (freedoms,) rad or m. ``carried``: 1; or the share of the force at which the
    machine gives way and snaps over: ``exact`` and ``inputs`` are those of just before.
    """

    point: str
    force: Floats
    linear: Floats
    exact: Floats
    inputs: Floats
    carried: float = 1.0


def flexibility(forces: StaticForces, place: Floats, stiffness: Floats, point: str, stability: str) -> Floats:
    """Displacement (2, 2) of a point by unit forces; raises as ``Equilibrium.flexibility``."""
    _require_stable(point, stability)
    moved = forces.point(point, place[:, None])[1][:, :, 0]
    return np.asarray(moved @ np.linalg.solve(stiffness, moved.T))


def displaced(
    forces: StaticForces,
    place: Floats,
    stiffness: Floats,
    point: str,
    force: tuple[float, float],
    stability: str,
    reach: tuple[float, float] | None,
) -> Displacement:
    """See ``Equilibrium.displaced``."""
    require_pair("force", force)
    pull = np.array(force, dtype=float)
    linear = flexibility(forces, place, stiffness, point, stability) @ pull
    begin = forces.point(point, place[:, None])[0][:, 0]
    if len(place) == 1:
        inputs, carried = _along(forces, float(place[0]), point, pull, float(stiffness[0, 0]), reach)
    else:
        inputs, carried = _stepped(forces, place, point, pull)
    end = forces.point(point, inputs[:, None])[0][:, 0]
    return Displacement(point, pull, linear, end - begin, inputs, carried)


def _require_stable(point: str, stability: str) -> None:
    if stability != "stable":
        raise LinkwrightError(
            _(
                "the position is not stable, so no force moves point {point} by a certain amount; take a stable one",
                code="dynamics.not_stable",
                point=point,
            )
        )


def _along(
    forces: StaticForces, begin: float, point: str, pull: Floats, stiffness: float, reach: tuple[float, float] | None
) -> tuple[Floats, float]:
    """One input: the force that holds it, as share of the one that acts, grows with the way up to its maximum."""

    def share(q: Floats) -> Floats:
        moved = forces.point(point, q[None])[1][:, 0]
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.asarray(forces.efforts(q[None])[0] / (pull @ moved))

    first = float(pull @ forces.point(point, np.array([[begin]]))[1][:, 0, 0])
    if abs(first) <= CONVERGED * float(np.hypot(*pull)):
        return np.array([begin]), 1.0
    way = np.sign(first / stiffness)
    low, high = reach or (begin - 2.0 * np.pi, begin + 2.0 * np.pi)
    length = (high - begin if way > 0.0 else begin - low) * (1.0 - 1e-9)
    q = begin + way * length * (np.arange(1, PLACES + 1) / PLACES) ** 2
    values = share(q)
    previous = np.append(0.0, values[:-1])
    over, falls = values >= 1.0, ~(values > previous)
    last = int(np.argmax(over | falls)) if (over | falls).any() else PLACES
    if last < PLACES and over[last]:
        before = begin if last == 0 else float(q[last - 1])
        place = root(lambda x: -1.0 if x == begin else share(np.array([x]))[0] - 1.0, before, q[last])
        return np.array([place]), 1.0
    best = max(last - 1, 0)
    return q[best : best + 1], float(values[best])


def _stepped(forces: StaticForces, place: Floats, point: str, pull: Floats) -> tuple[Floats, float]:
    """Several inputs: Newton's method while the force grows step by step."""
    q, size = place.copy(), 0.0
    for step in range(1, STEPS + 1):
        found = _balanced(forces, q, point, pull * (step / STEPS))
        if (
            found is None
            or not (np.linalg.eigvalsh(_stiffness(forces, found, point, pull * (step / STEPS))) > 0).all()
        ):
            return q, size
        q, size = found, step / STEPS
    return q, 1.0


def _stiffness(forces: StaticForces, q: Floats, point: str, pull: Floats) -> Floats:
    """Stiffness under a force on a point, whose direction stays: less the change of its levers."""
    bent = np.einsum("i,ijkn->jkn", pull, forces.point_curvature(point, q[:, None]))[:, :, 0]
    found = forces.slopes(q[:, None])[:, :, 0] - bent
    return np.asarray(0.5 * (found + found.T))


def _balanced(forces: StaticForces, q: Floats, point: str, pull: Floats) -> Floats | None:
    for _iteration in range(ITERATIONS):
        moved = forces.point(point, q[:, None])[1][:, :, 0]
        left = forces.efforts(q[:, None])[:, 0] - pull @ moved
        change = np.linalg.solve(_stiffness(forces, q, point, pull), -left)
        q = q + change
        if np.abs(change).max() <= CONVERGED:
            return q if np.isfinite(q).all() else None
    return None
