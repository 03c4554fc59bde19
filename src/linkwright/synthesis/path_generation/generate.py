"""Path generation: the four-bars with a turning crank whose coupler point comes nearest to given points."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from linkwright.core.arrays import Complexes
from linkwright.synthesis.candidates import assess_four_bars, four_bar_candidate, path_of_four_bar
from linkwright.synthesis.names import ONLY_WITH, PATH_ONE_PLACE, POINTS
from linkwright.synthesis.path_generation.crank_family import Demand, couplers
from linkwright.synthesis.path_generation.search import Found, search
from linkwright.synthesis.requirements.slider_crank import positive
from linkwright.synthesis.result import (
    Candidate,
    Derivation,
    Synthesis,
    SynthesisError,
    allowed_transmission,
    different,
    extent_of,
    ranked,
    require_integers,
)
from linkwright.words import _

#: Solutions whose lengths agree so far (relative) are one.
SAME_LINKAGE = 1e-4


@dataclass(frozen=True, eq=False)
class PathDerivation(Derivation):
    """The demand of a path, the smallest transmission angle (rad) demanded, and how many optima were compared."""

    demand: Demand
    transmission_angle: float
    optima: int


def path_generation(
    points: ArrayLike,
    *,
    angles: ArrayLike | None = None,
    phase: bool = True,
    pivot: tuple[float, float] | None = None,
    direction: float | None = None,
    bound: float | None = None,
    transmission_angle: float = 0.0,
    turning: bool = True,
    count: int = 6,
    seed: int = 0,
) -> Synthesis:
    """Four-bars whose coupler point passes near the points, least squares, globally.

    Args:
        points: (n, 2) or complex (n,), m, in the order in which they are passed; n ≥ 3; a last point equal to the
            first closes the curve.
        angles: crank angles of the points, rad (timed); None: the timing is free (untimed).
        phase: a common angle may be added to ``angles``; without it they count from the line O1→O2.
        pivot: the crank's pivot (m) where it is given.
        direction: angle of the line O1→O2 (rad) where it is given.
        bound: largest length, and largest absolute coordinate of the crank's pivot and of the coupler point in the
            coupler's axes, m.
        transmission_angle: the smallest that is allowed over the turn, or between first and last point, rad.
        turning: the input must turn fully; without it any four-bar will do, driven between the points.
        count: candidates wanted.
        seed: of the random starts.

    Returns:
        Candidates; ``error``: ``Σ |P_j - target_j|²``, m². ``P = z + α e^{iθ} + β U(θ; b, c, d)``: place, size and
        coupler point are projected out, ratios and timing iterated from an atlas of starts.

    Raises:
        SynthesisError: fewer than three points, points that coincide, angles that do not fit; different points
            at one crank angle, or beyond what the bound reaches (``nearest``: the least squares).
    """
    require_integers(count=count)
    require_integers(minimum=0, seed=seed)
    allowed_transmission(transmission_angle)
    if bound is not None:
        positive(bound=bound)
    if not phase and angles is None:
        raise SynthesisError(ONLY_WITH.format(demand="phase: false", needs="angles"))
    demand = _demand(points, angles, phase, pivot, direction)
    rng = np.random.default_rng(seed)
    candidates = _candidates(search(demand, bound, transmission_angle, False, rng))
    if not turning:
        candidates += _candidates(search(demand, bound, transmission_angle, True, rng))
        candidates = [each for each in candidates if each.transmission_angle >= transmission_angle - 1e-9]
    extent = extent_of(demand.points)
    chosen = different(ranked(candidates, demand.size**2, extent), SAME_LINKAGE * demand.size)[:count]
    if not chosen:
        raise SynthesisError(_("no four-bar was found for the path; check the points", code="synthesize.path.none"))
    notes = (
        (
            _(
                "no candidate passes the points in the given order on one branch: the best one has the "
                "defects shown; leave out points or allow larger lengths",
                code="synthesize.path.ordered",
            ),
        )
        if chosen[0].defects
        else ()
    )
    derivation = PathDerivation(demand, transmission_angle, len(candidates))
    result = Synthesis("path", chosen, "squares", demand.points, notes=notes, extent=extent, derivation=derivation)
    _contradictions(demand, bound, result)
    return result


def _contradictions(demand: Demand, bound: float | None, result: Synthesis) -> None:
    """Raises SynthesisError, with the result as the nearest, where no four-bar at all can meet the demands."""
    if demand.timed:
        turn = np.exp(1j * demand.angles)
        same = np.triu(np.abs(turn[:, None] - turn) < 1e-9, 1)
        distance = np.where(same, np.abs(demand.points[:, None] - demand.points), 0.0)
        i, j = np.unravel_index(int(distance.argmax()), distance.shape)
        if distance[i, j] > 1e-9 * demand.size:
            minimum = f"{distance[i, j] ** 2 / 2:.4g}"
            raise SynthesisError(
                _(
                    "points {first} and {second} have the same crank angle and a distance of {distance} m; no path "
                    "comes below a sum of squared distances of {minimum} m² there (the nearest solution is "
                    "shown); change one of the angles",
                    code="synthesize.path.same_angle",
                    first=i + 1,
                    second=j + 1,
                    distance=f"{distance[i, j]:.4g}",
                    minimum=minimum,
                ),
                result,
            )
    if bound is not None:
        far = np.abs(demand.points - (demand.pivot or 0.0))
        most = bound * (1 + math.sqrt(2) * (2 if demand.pivot is None else 1))
        if far.max() > most:
            number, limit = int(far.argmax()) + 1, f"{bound:.4g}"
            raise SynthesisError(
                _(
                    "point {number} lies {far} m away, and within the bound {bound} m a four-bar reaches "
                    "{most} m at most; allow a larger bound (the nearest solution is shown)",
                    code="synthesize.path.reach",
                    number=number,
                    far=f"{far.max():.4g}",
                    bound=limit,
                    most=f"{most:.4g}",
                ),
                result,
            )


def _demand(
    points: ArrayLike,
    angles: ArrayLike | None,
    phase: bool,
    pivot: tuple[float, float] | None,
    direction: float | None,
) -> Demand:
    z = complex_points(points)
    if len(z) < 3:
        raise SynthesisError(
            _("{count} points are too few for a path; give 3 or more", code="synthesize.path.few", count=len(z))
        )
    theta = np.zeros(len(z)) if angles is None else np.asarray(angles, float)
    if theta.shape != z.shape or not np.isfinite(theta).all():
        raise SynthesisError(
            _(
                "{angles} crank angles do not fit {points} points; give one for each point",
                code="synthesize.path.angles",
                angles=int(np.isfinite(theta).sum()),
                points=len(z),
            )
        )
    place = None if pivot is None else complex_points([pivot])[0]
    found = Demand(z, theta, phase, angles is not None, place, direction)
    if not found.size > 0:
        raise SynthesisError(PATH_ONE_PLACE)
    if found.timed and np.abs(np.exp(1j * theta) - np.exp(1j * theta[0])).max() < 1e-9:
        raise SynthesisError(
            _(
                "all points have the same crank angle, at which a coupler point is at one place; give "
                "different angles",
                code="synthesize.path.one_angle",
            )
        )
    return found


def complex_points(points: ArrayLike) -> Complexes:
    """Points (n, 2) or complex (n,) as complex (n,); raises SynthesisError for what is neither, or not finite."""
    try:
        places = np.asarray(points)
        if places.ndim == 2 and places.shape[1] == 2:
            places = places[:, 0].astype(float) + 1j * places[:, 1].astype(float)
        places = places.astype(complex)
    except (ValueError, TypeError):
        raise SynthesisError(POINTS) from None
    if places.ndim != 1 or not np.isfinite(places).all():
        raise SynthesisError(POINTS)
    return places


def _candidates(found: Found) -> list[Candidate]:
    """Four-bars in the plane of the points, mirrored ones mirrored back."""
    paths, free, who, linear = found
    z, alpha, beta = (v[:, None] for v in linear)
    shape = paths.family.chosen(who).lengths(free)
    a, u = couplers(paths.theta(free, who), shape)
    b, _, d = shape
    flip = paths.mirrored[who][:, None]
    pivot = np.where(flip, z.conj(), z) + (paths.demand.pivot or 0.0)

    def back(v: Complexes) -> Complexes:
        return np.where(flip, v.conj(), v)

    pin_a, pin_b = pivot + back(alpha * a), pivot + back(alpha * (a + b[:, None] * u))
    o2, p = pivot + back(alpha * d[:, None]), pivot + back(alpha * a + beta * u)
    facts = assess_four_bars(pivot[:, 0], pin_a, pin_b, o2[:, 0])
    off = np.abs(p - paths.demand.points)
    error = (off**2).sum(1)
    made = [
        four_bar_candidate(
            complex(pivot[i, 0]),
            pin_a[i],
            pin_b[i],
            complex(o2[i, 0]),
            facts,
            i,
            error[i],
            p=complex(p[i, 0]),
            worst=off[i].max(),
            path=p[i],
            curve=path_of_four_bar(complex(pivot[i, 0]), pin_a[i, 0], pin_b[i, 0], complex(o2[i, 0]), p[i, 0]),
        )
        for i in range(len(free))
    ]
    return [replace(each, deviations=off[i]) for i, each in enumerate(made)]
