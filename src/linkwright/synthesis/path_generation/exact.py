"""Exact path generation: four-bars whose coupler point passes three to nine points, and the cognates of a four-bar.

With λ = (P - A)/(B - A) the third pivot is O3 = O1 + λ (O2 - O1); the cognate at O1 has the pins A' = O1 + P - A and
B' = A' + λ (A - O1), that at O2 the pins A' = O2 + P - B and B' = A' + (1 - λ)(B - O2).
Source: Roberts 1875, Proc. London Math. Soc. 7.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from linkwright.core.arguments import require
from linkwright.core.arrays import Complexes
from linkwright.synthesis.candidates import Assessment, assess_four_bars, four_bar_candidate, path_of_four_bar
from linkwright.synthesis.linkage import Linkage
from linkwright.synthesis.names import DEFECTS, PATH_NO_REAL, PATH_ONE_PLACE
from linkwright.synthesis.path_generation.generate import complex_points, path_generation
from linkwright.synthesis.path_generation.nine_points import NinePoints, is_real, nine_points, relatives
from linkwright.synthesis.result import (
    Candidate,
    Derivation,
    Synthesis,
    SynthesisError,
    extent_of,
    merit,
    require_integers,
)
from linkwright.words import _

#: Sum of squares below which a path of least squares passes its points exactly, in units of their size squared.
EXACT = 1e-18


@dataclass(frozen=True, eq=False)
class NinePointDerivation(Derivation):
    """Nine points (9,), m; classes of Roberts' cognates found and those that are real; four-bars examined with both
    inputs and all cognates, and those without defects."""

    points: Complexes
    classes: int
    real: int
    examined: int
    sound: int


def exact_path_generation(points: ArrayLike, *, count: int = 6, seed: int = 0) -> Synthesis:
    """Four-bars whose coupler point passes the points exactly.

    Args:
        points: (n, 2) or complex (n,), m, 3 ≤ n ≤ 9, in the order in which they shall be passed.
        count, seed: candidates wanted; seed of the starts (n < 9).

    Returns:
        Nine points: every four-bar there is, from all 1442 classes of Roberts' cognates, of which those that are real
        are examined with both inputs and all cognates for circuit, branch and order defects. Three to eight points
        leave numbers free: those of least squares with a turning crank whose error vanishes.

    Raises:
        SynthesisError: another number of points, or points that coincide; no real four-bar; none that passes the
        points
            in order on one branch (``nearest``: the best with its defects, or that of least squares).
    """
    require_integers(count=count)
    require_integers(minimum=0, seed=seed)
    z = complex_points(points)
    if not 3 <= len(z) <= 9:
        raise SynthesisError(
            _(
                "exact path generation takes 3 to 9 points, given: {count}; leave angles out and use "
                "least squares for more",
                code="synthesize.path.exact_few",
                count=len(z),
            )
        )
    size = float(np.sqrt(np.mean(np.abs(z - z.mean()) ** 2)))
    if not size > 0:
        raise SynthesisError(PATH_ONE_PLACE)
    same = np.argwhere(np.triu(np.abs(z[:, None] - z) <= 1e-9 * size, 1))
    if len(same):
        raise SynthesisError(
            _(
                "points {first} and {second} are the same; leave one out",
                code="synthesize.path.same_point",
                first=int(same[0, 0]) + 1,
                second=int(same[0, 1]) + 1,
            )
        )
    if len(z) < 9:
        return _fewer(z, size, count, seed)
    found = nine_points(z)
    return _nine(z, found, count, seed)


def _fewer(z: Complexes, size: float, count: int, seed: int) -> Synthesis:
    found = path_generation(z, count=4 * count, seed=seed)
    exact = tuple(each for each in found if each.error <= EXACT * size**2 and not each.defects)
    if not exact:
        raise SynthesisError(PATH_NO_REAL.format(count=len(z), error=f"{found.best.error:.4g}"), found)
    return replace(found, task="exact_path", candidates=exact[:count], counts={"exact": len(exact)}, notes=())


def _nine(z: Complexes, found: NinePoints, count: int, seed: int) -> Synthesis:
    real = found.solutions[is_real(found.solutions)]
    counts = {"classes": len(found.solutions), "real": len(real)}
    if not len(real):
        nearest = path_generation(z, count=count, seed=seed)
        raise SynthesisError(PATH_NO_REAL.format(count=9, error=f"{nearest.best.error:.4g}"), nearest)
    u = np.concatenate(relatives(real, found.q))
    usable = np.isfinite(u).all(1) & (np.abs(u[:, [0, 2, 4, 6]]).max(1) < 1e4)
    u = u[usable]
    turn = np.concatenate([np.ones((len(u), 1)), 1 + u[:, 8:]], 1)
    pins = [z + found.scale * u[:, o, None] * turn for o in (0, 4)]
    pivots = [z[0] + found.scale * (u[:, o] + u[:, o + 2]) for o in (0, 4)]
    facts = assess_four_bars(pivots[0], pins[0], pins[1], pivots[1])
    extent = extent_of(z)
    arms = [np.abs(z[0] - each[:, 0]) for each in pins]
    merits = merit(facts.transmission, facts.ratio, np.maximum.reduce([facts.longest, *arms]), extent)
    order = np.lexsort((-merits, ~facts.sound))[:count]
    made = tuple(_candidate(z, pivots, pins, facts, int(i)) for i in order)
    counts |= {"four_bars": len(u), "sound": int(facts.sound.sum())}
    notes = (
        _(
            "{classes} of 1442 classes of four-bars were found for the points; {real} of them are "
            "real, {sound} without defects",
            code="synthesize.path.nine",
            classes=counts["classes"],
            real=counts["real"],
            sound=counts["sound"],
        ),
    )
    derivation = NinePointDerivation(z, counts["classes"], len(real), len(u), int(facts.sound.sum()))
    result = Synthesis("exact_path", made, "squares", z, counts, notes, extent=extent, derivation=derivation)
    if made[0].defects:
        why = tuple(DEFECTS[name] for name in made[0].defects)
        raise SynthesisError(
            _(
                "{real} real four-bars pass exactly through the points, none in order on one branch; the "
                "best one shows: {why}",
                code="synthesize.path.no_movable",
                real=len(u),
                why=why,
                defects=made[0].defects,
            ),
            result,
        )
    return result


def _candidate(z: Complexes, pivots: list[Complexes], pins: list[Complexes], facts: Assessment, i: int) -> Candidate:
    o1, o2 = (complex(each[i]) for each in pivots)
    a, b = (each[i] for each in pins)
    lengths = [np.ptp(np.abs(pin - pivot)) for pin, pivot in ((a, o1), (b, o2))]
    curve = path_of_four_bar(o1, a[0], b[0], o2, z[0])
    error = float(max(lengths))
    made = four_bar_candidate(o1, a, b, o2, facts, i, error**2, p=complex(z[0]), worst=error, curve=curve, path=z)
    return replace(
        made, deviations=np.maximum(*(np.abs(pin - pivot) - abs(pin[0] - pivot) for pin, pivot in ((a, o1), (b, o2))))
    )


Four = tuple[complex, complex, complex, complex]


def cognates(linkage: Linkage) -> Synthesis:
    """The linkage and its two cognates, in the same pose, each with its facts.

    Raises:
        SynthesisError: the linkage is not a four-bar with a coupler point P, or P lies on a pin.
    """
    require(linkage, Linkage)
    points = linkage.points
    if linkage.guides or not {"O1", "A", "B", "O2", "P"} <= set(points):
        raise SynthesisError(
            _(
                "cognates belong to a four-bar with pins and a coupler point P; give one",
                code="synthesize.cognates.four_bar",
            )
        )
    o1, a, b, o2, p = (points[name] for name in ("O1", "A", "B", "O2", "P"))
    if min(abs(p - a), abs(p - b)) < 1e-9 * abs(b - a):
        raise SynthesisError(
            _(
                "the coupler point lies on a pin, so its path is a circle without cognates; move it",
                code="synthesize.cognates.pin",
            )
        )
    found = tuple(_cognate(each, p) for each in ((o1, a, b, o2), *both(o1, a, b, o2, p)))
    return Synthesis("cognates", found)


def both(o1: complex, a: complex, b: complex, o2: complex, p: complex) -> tuple[Four, Four]:
    """(O1, A, B, O2) of the cognates that keep the first and the second pivot."""
    share = (p - a) / (b - a)
    o3 = o1 + share * (o2 - o1)
    first, second = o1 + p - a, o2 + p - b
    return (o1, first, first + share * (a - o1), o3), (o2, second, second + (1 - share) * (b - o2), o3)


def _cognate(four: Four, p: complex) -> Candidate:
    o1, a, b, o2 = four
    pins = np.array([a]), np.array([b])
    facts: Assessment = assess_four_bars(np.array([o1]), pins[0][None], pins[1][None], np.array([o2]))
    return four_bar_candidate(o1, *pins, o2, facts, 0, 0.0, p=p, curve=path_of_four_bar(o1, a, b, o2, p))
