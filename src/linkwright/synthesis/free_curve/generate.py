"""Free curves: linkages of four to twelve bars whose last point draws a given curve."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from linkwright.core.arrays import Complexes
from linkwright.core.progress import Progress, current_progress
from linkwright.designs.checkpoints import RESUME, current_checkpoints
from linkwright.synthesis.free_curve.linkages import Placed, drawing, kind_of, linkage_of
from linkwright.synthesis.free_curve.search import JOINTS, Search
from linkwright.synthesis.free_curve.target import Target, read_curve
from linkwright.synthesis.free_curve.topology import Design
from linkwright.synthesis.names import FREE_CURVE_NO_CURVE, ONLY_WITH, PATH_ONE_PLACE, TRANSMISSION_RANGE
from linkwright.synthesis.path_generation.generate import complex_points
from linkwright.synthesis.requirements.slider_crank import not_negative, positive
from linkwright.synthesis.result import Candidate, Derivation, Synthesis, SynthesisError, require_integers
from linkwright.words import _

#: Positions of a candidate's curve.
SHOWN = 721
#: Coordinates of a curve lie below this, m; points nearer than this share of them (of 1 m at least) are one place.
FARTHEST, SMALLEST = 1e9, 1e-12
#: Designs count as equal whose error (relative), transmission angle (rad) and size (rms radii) differ by less.
SLACK = 0.02, 0.03, 0.2
#: What all linkages found keep to, and that none does: where the input turns fully, and where it may swing.
TURNING = (
    _(
        "The crank turns fully; transmission angle of every dyad at least {angle} deg over the "
        "full turn, every joint within {size} rms radii of the curve's centroid.",
        code="synthesize.free_curve.turning",
    ),
    _(
        "no linkage was found that turns fully with transmission angles of {angle} deg within "
        "{size} rms radii; ask for less, or give more seconds (the nearest ones are shown)",
        code="synthesize.free_curve.none_turning",
    ),
)
SWINGING = (
    _(
        "The input may swing; while it draws, the transmission angle of every dyad is at least "
        "{angle} deg and every joint within {size} rms radii of the curve's centroid.",
        code="synthesize.free_curve.swinging",
    ),
    _(
        "no linkage was found that draws the curve with transmission angles of {angle} deg "
        "within {size} rms radii; ask for less, or give more seconds (the nearest ones are shown)",
        code="synthesize.free_curve.none_swinging",
    ),
)


@dataclass(frozen=True, eq=False)
class FreeCurveDerivation(Derivation):
    """The curve as it was given (m), closed or open, its centroid and rms radius (m); the demands; linkages tried and
    found."""

    curve: Complexes
    closed: bool
    centroid: complex
    radius: float
    transmission_angle: float
    size: float
    turning: bool
    seconds: float
    attempts: int
    designs: int


def free_curve(
    points: ArrayLike | None = None,
    *,
    file: str | Path | None = None,
    file_unit: float | None = None,
    closed: bool | None = None,
    joints: int = 12,
    transmission_angle: float = math.radians(20),
    size: float = 6.0,
    turning: bool = True,
    error: float = 0.0,
    seconds: float = 15.0,
    count: int = 6,
    seed: int = 0,
    progress: Progress | None = None,
) -> Synthesis:
    """Linkages that draw a curve, best first.

    Args:
        points: corners of the curve in order, (n, 2) or complex (n,), m; n ≥ 2.
        file: the curve in a file instead: two columns of numbers (``.csv``, ``.txt``), or the first path of an
            ``.svg``; ``file_unit``: length of one unit there, m (not given: 1 mm).
        closed: whether the last point joins the first; not given: where they are the same point.
        joints: most joints (pivots, pins, slides, points of links and the drawing point), 5 to 12: a four-bar, a
            slider-crank and a crank with a swinging block have 5, a six-bar up to 8; with 10 there are eight- and
            ten-bars, with 12 twelve-bars as well.
        transmission_angle: minimum of every dyad, rad.
        size: maximum distance of any joint from the curve's centroid, in rms radii of the curve.
        turning: the crank turns fully, and both demands hold over its full turn; without it an open curve may be
            drawn by an input that swings, and they hold while it draws.
        error: an error that is good enough: linkages within it come with the fewest links first; 0: the smallest
            error first.
        seconds: time of the search on all cores; more time finds better linkages, as a rule: draws depend on it.
        count: candidates wanted; seed: of the search. Where the clock ends the search depends on the machine, so
            two runs may differ.
        progress: called with the percents of the time that are over, and 100.

    Returns:
        Candidates none of which is beaten by another in error, number of links, transmission angle and size at
        once. ``error``: mean nearest distance from curve to drawn curve plus that from drawn curve to curve, in rms
        radii of the curve (both even in arc length; as they lie, the curve's centroid and rms radius unchanged);
        ``worst``: the largest nearest distance, the same unit. ``values``: joints, links, size, the share drawn in
        the given direction, the maximum speed at one turn of the crank per second. An open curve is drawn between
        the ends of the model's cycle; a crank that ``turns`` goes on from there.

    Raises:
        SynthesisError: no curve, or demands out of range; none was found within the demands or within ``error``
            (``nearest``).
    """
    curve, closes = _curve(points, file, file_unit, closed)
    require_integers(count=count)
    require_integers(seed=seed, minimum=0)
    require_integers(joints=joints, minimum=JOINTS[0])
    if joints > JOINTS[-1]:
        raise SynthesisError(
            _(
                "a search with at most {value} joints cannot be made; ask for 5 (four-bar, slider-crank) to {most}",
                code="synthesize.free_curve.joints",
                value=joints,
                most=JOINTS[-1],
            )
        )
    if not 0 < transmission_angle < math.pi / 2:
        raise SynthesisError(TRANSMISSION_RANGE.format(value=f"{math.degrees(transmission_angle):g}"))
    positive(size=size, seconds=seconds)
    not_negative(error=error)
    target = Target(curve, closes, transmission_angle, size, turning)
    search = Search(target, int(joints), seconds, int(seed), progress or current_progress())
    return _ranked(target, search.run(), curve, error, int(count), search)


def _curve(
    points: ArrayLike | None, file: str | Path | None, unit: float | None, closed: bool | None
) -> tuple[Complexes, bool]:
    if (points is None) == (file is None):
        raise SynthesisError(FREE_CURVE_NO_CURVE)
    if unit is not None and file is None:
        raise SynthesisError(ONLY_WITH.format(demand="file_unit", needs="file"))
    unit = 1e-3 if unit is None else unit
    positive(file_unit=unit)
    z = complex_points(points) if points is not None else unit * read_curve(Path(str(file)))
    if not len(z):
        raise SynthesisError(FREE_CURVE_NO_CURVE)
    far = float(np.abs([z.real, z.imag]).max())
    if not far < FARTHEST:
        raise SynthesisError(
            _(
                "the curve has a coordinate of {value} m; give coordinates below {most} m (see its unit)",
                code="synthesize.free_curve.far",
                value=f"{far:.3g}",
                most=f"{FARTHEST:g}",
            )
        )
    z = z[np.append(True, np.abs(np.diff(z)) > 0)]
    if np.abs(z - z[0]).max() < SMALLEST * max(1.0, far):
        raise SynthesisError(PATH_ONE_PLACE)
    joined = abs(z[-1] - z[0]) < 1e-9 * np.abs(z - z[0]).max()
    closes = joined if closed is None else closed
    return (z[:-1] if joined and closes else z), bool(closes)


def _ranked(
    target: Target, designs: list[Design], curve: Complexes, error: float, count: int, search: Search
) -> Synthesis:
    found = [(each, _facts(each, target)) for each in designs]
    within = [(each, facts) for each, facts in found if Placed(each, target).keeps()]
    constraint_note, none = TURNING if target.turning else SWINGING
    asked = {"angle": f"{math.degrees(target.min_angle):g}", "size": f"{target.largest:g}"}
    notes = [
        constraint_note.format(**asked),
        _(
            "drawn_as_given: 1 where the curve is drawn in the order of its points, 0 backwards; "
            "fastest_at_1_Hz: maximum speed at one turn per second, m/s.",
            code="synthesize.free_curve.measure",
        ),
    ]
    cache = current_checkpoints()
    if search.stopped and not within:
        raise KeyboardInterrupt
    if search.stopped and cache is not None:
        notes.append(RESUME.format(path=cache.left()))
    counts = {"attempts": search.attempts, "designs": len(found)}
    derivation = FreeCurveDerivation(
        curve,
        target.closed,
        target.centre,
        target.radius,
        target.min_angle,
        target.largest,
        target.turning,
        search.seconds,
        search.attempts,
        len(found),
    )
    if not within:
        nearest = [_candidate(each, target) for each, _unused in _front(found)[:count]]
        near = (
            Synthesis("free_curve", tuple(nearest), "curve", curve, counts, tuple(notes), derivation=derivation)
            if nearest
            else None
        )
        raise SynthesisError(none.format(**asked), near)
    front = _front(within)
    good = sorted((each for each in front if each[1][0] <= error), key=lambda each: (each[0].links, each[1][0]))
    rest = [each for each in front if each[1][0] > error]
    chosen = _spread(good + rest, count)
    made = tuple(_candidate(each, target) for each, _unused in chosen)
    result = Synthesis(
        "free_curve", made, "curve", _shown(curve, target.closed), counts, tuple(notes), derivation=derivation
    )
    if error and not good:
        raise SynthesisError(
            _(
                "no linkage was found within the error {value}; the smallest found is {minimum} (shown); allow more "
                "joints or more seconds",
                code="synthesize.free_curve.error",
                value=f"{error:g}",
                minimum=f"{made[0].error:.3g}",
            ),
            result,
        )
    return result


Facts = tuple[float, int, float, float]


def _facts(design: Design, target: Target) -> Facts:
    """Error, links, negative minimum transmission angle (rad), size."""
    placed = Placed(design, target)
    return target.deviation(design)[0], design.links, -placed.transmission_angle(), placed.size()


def _front(found: list[tuple[Design, Facts]]) -> list[tuple[Design, Facts]]:
    """Without designs that another one equals or beats in all (within ``SLACK``), the smallest error first."""
    found = sorted(found, key=lambda each: each[1])
    front: list[tuple[Design, Facts]] = []
    for each in found:
        error, angle, size = SLACK
        worse = np.array(each[1]) * (1 + error, 1, 1, 1) + (0.0, 0.0, angle, size)
        if not any((np.array(facts) <= worse).all() for _unused, facts in front):
            front.append(each)
    return front


def _spread(front: list[tuple[Design, Facts]], count: int) -> list[tuple[Design, Facts]]:
    """The first, the first of every other number of links, then the next in order."""
    firsts = {facts[1]: k for k, (_unused, facts) in reversed(list(enumerate(front)))}
    order = sorted(firsts.values()) + [k for k in range(len(front)) if k not in firsts.values()]
    return [front[k] for k in sorted(order[:count])]


def _shown(curve: Complexes, closed: bool) -> Complexes:
    return np.append(curve, curve[0]) if closed else curve


def _candidate(design: Design, target: Target) -> Candidate:
    placed = Placed(design, target)
    linkage, (mean, most) = linkage_of(placed), target.deviation(design)
    angle = placed.over_a_turn() if placed.turns() else placed.transmission_angle()
    how, curve = drawing(placed), placed.curve(SHOWN)
    lengths = list(linkage.lengths().values())
    values = {
        "joints": float(design.joints),
        "links": float(design.links),
        "size": placed.size(),
        "drawn_as_given": how.along,
        "fastest_at_1_Hz": how.fastest,
        "fastest_to_mean": how.unevenness,
    }
    return Candidate(
        linkage,
        mean,
        kind_of(design),
        (),
        placed.turns(),
        angle,
        max(lengths) / min(lengths),
        most,
        _shown(curve, target.closed),
        values,
    )
