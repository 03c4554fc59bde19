"""Motion generation: four-bars and slider-cranks whose coupler takes given poses."""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from linkwright.core.arrays import Complexes, Flags, Floats, Integers
from linkwright.synthesis.candidates import (
    Assessment,
    assess_four_bars,
    assess_slider_cranks,
    candidate,
    four_bar_candidate,
    path_of_four_bar,
    slider_crank,
    working_span,
)
from linkwright.synthesis.motion_generation.burmester import Dyads, circles, five_poses, relative_poses
from linkwright.synthesis.motion_generation.families import (
    AROUND,
    LINES,
    Window,
    all_dyads,
    circle_points,
    cubic_coefficients,
    fitted,
    held,
    inverse_poses,
    scale_of,
    two_points,
    usual_window,
)
from linkwright.synthesis.motion_generation.mixed_poses import counted_solutions, mixed_solutions
from linkwright.synthesis.names import (
    DEFECTS,
    LINK_RATIO_UNMET,
    MOTION_FITTED,
    MOTION_NO_MOVABLE,
    MOTION_NO_PAIRS,
    MOTION_POSES,
    NOT_WITH,
)
from linkwright.synthesis.requirements.slider_crank import positive
from linkwright.synthesis.result import (
    Candidate,
    Derivation,
    Synthesis,
    SynthesisError,
    different,
    extent_of,
    merit,
    merits,
    ranked,
    ranking,
    require_integers,
)
from linkwright.words import _

Pose = Sequence[float]

#: Longest over shortest link up to which candidates are equally good where no ratio is demanded.
USUAL_RATIO = 10.0


@dataclass(frozen=True, eq=False)
class MotionDerivation(Derivation):
    """Poses: places (n,), m, and angles (n,), rad, NaN where free.

    Five poses: all four Burmester points (4,) in axes at the first place, their centres (4,) in the frame, which are
    real and which slide. Four: coefficients of the circle- and the centre-point curve by ``families.POWERS`` in
    coordinates from the first place over ``size`` (m). ``link_ratio``: the limit that was held.
    """

    p: Complexes
    phi: Floats
    link_ratio: float
    points: Complexes | None = None
    centres: Complexes | None = None
    real: Flags | None = None
    slides: Flags | None = None
    size: float = 1.0
    circle_curve: Floats | None = None
    centre_curve: Floats | None = None


def motion_generation(
    poses: ArrayLike,
    *,
    within: tuple[tuple[float, float], tuple[float, float]] | None = None,
    fixed_pivots: Sequence[tuple[float, float]] = (),
    moving_pivots: Sequence[tuple[float, float]] = (),
    pivot_line: Sequence[Sequence[float]] | None = None,
    link_ratio: float | None = None,
    count: int = 6,
) -> Synthesis:
    """Linkages whose coupler takes the poses: all dyads and all their pairs.

    Args:
        poses: (n, 3) x (m), y (m) and angle (rad) of the coupler, n ≥ 2. Five poses: all real Burmester dyads; two
            to four: dyads sampled from their families; six and more: dyads of least squares. An angle that is NaN is
            free (mixed poses and points): all four-bars where 2 × poses + points is 10 (also nine points and one
            pose or none), else least squares from many starts, not provably all.
        within: lower left and upper right corner (m) in which all pivots lie at the first pose, but the one that
            is given; not given: for up to four poses three times their extent.
        fixed_pivots, moving_pivots: pivots that dyads must have (n ≤ 3): places in the frame, moving ones at the
            first pose, m.
        pivot_line: two places (m) between which every fixed pivot must lie (three or four poses).
        link_ratio: largest ratio of longest to shortest link; not given: candidates with more than 10 come last.
        count: candidates wanted.

    Returns:
        Candidates without circuit, branch and order defects, by merit. ``error``: the largest
        difference of a link's length between poses, m: 0 for exact ones.

    Raises:
        SynthesisError: fewer than two real dyads, or no pair that moves through the poses in order without being
            dismantled, or none of the ``link_ratio``; ``nearest`` has the best ones with their defects or errors.
    """
    require_integers(count=count)
    p, phi = _read(poses)
    _applicable(phi, within, pivot_line, fixed_pivots=fixed_pivots, moving_pivots=moving_pivots)
    region = within, fixed_pivots, moving_pivots, pivot_line
    if link_ratio is None:
        return _guided(p, phi, *region, USUAL_RATIO, count)
    positive(link_ratio=link_ratio)
    try:
        found = _guided(p, phi, *region, link_ratio, count)
    except SynthesisError:
        found = _guided(p, phi, *region, math.inf, count)
    good = tuple(each for each in found if each.link_ratio <= link_ratio * (1 + 1e-12) and not each.defects)
    if not good:
        nearest = replace(found, candidates=tuple(sorted(found, key=lambda each: each.link_ratio)))
        smallest_ratio = f"{math.ceil(1e3 * nearest.best.link_ratio) / 1e3:g}"
        raise SynthesisError(LINK_RATIO_UNMET.format(value=f"{link_ratio:g}", minimum=smallest_ratio), nearest)
    return replace(found, candidates=good)


def _derivation(p: Complexes, phi: Floats, link_ratio: float) -> MotionDerivation:
    """What the dyads of these poses follow from."""
    d, e = relative_poses(p, phi)
    if len(p) == 5:
        z, c, real, slides = (each[0] for each in five_poses(p[None], phi[None]))
        return MotionDerivation(p, phi, link_ratio, points=z, centres=c + p[0], real=real, slides=slides)
    if len(p) == 4:
        d_inverse, phi_inverse = inverse_poses(p, phi)
        size = scale_of(p)
        both = [cubic_coefficients(d, e, size), cubic_coefficients(d_inverse, np.exp(1j * phi_inverse), size)]
        return MotionDerivation(p, phi, link_ratio, size=size, circle_curve=both[0], centre_curve=both[1])
    return MotionDerivation(p, phi, link_ratio)


def _applicable(phi: Floats, within: object, line: object, **pivots: Sequence[object]) -> None:
    """Raises SynthesisError for demands that do not go together."""
    named = [name for name, places in pivots.items() if len(places)]
    lines = named + ["pivot_line"] * (line is not None) + ["within"] * (within is not None)
    if lines and np.isnan(phi).any():
        raise SynthesisError(
            NOT_WITH.format(
                demand=lines[0], other=_("poses whose angle is free", code="synthesize.motion.free_angles")
            )
        )
    if line is not None and named:
        raise SynthesisError(NOT_WITH.format(demand="pivot_line", other=f'"{named[0]}"'))
    if within is not None and sum(len(places) for places in pivots.values()) > 1:
        raise SynthesisError(
            NOT_WITH.format(demand="within", other=_("two or more given pivots", code="synthesize.motion.two_pivots"))
        )


def _guided(
    p: Complexes,
    phi: Floats,
    within: tuple[tuple[float, float], tuple[float, float]] | None,
    fixed_pivots: Sequence[tuple[float, float]],
    moving_pivots: Sequence[tuple[float, float]],
    pivot_line: Sequence[Sequence[float]] | None,
    link_ratio: float,
    count: int,
) -> Synthesis:
    """The linkages that take the poses, those within the ratio of links first."""
    if np.isnan(phi).any():
        return _mixed(p, phi, link_ratio, count)
    _special(p, phi, link_ratio, count)
    window = usual_window(p) if within is None else _window(within)
    found, error = all_dyads(p, phi, window, fixed_pivots, moving_pivots, pivot_line)
    counts = {"dyads": len(found), "sliders": int(found.slides.sum())}
    if len(found) < 2 and len(p) == 5:
        raise SynthesisError(
            _(
                "{real} real Burmester dyads fit the five poses, two are needed; the nearest solution is "
                "that of least squares, with the errors shown",
                code="synthesize.motion.no_dyads",
                real=len(found),
            ),
            _nearest(p, phi, link_ratio, count),
        )
    if within is not None and not len(fixed_pivots) + len(moving_pivots):
        inside = np.flatnonzero(held(found, window))
        found, error = found[inside], error[inside]
    chosen = _pairs(found, error, p, phi, link_ratio, count)
    counts["pairs"] = len(found) * (len(found) - 1) // 2
    curves = _curves(p, phi, window) if len(p) == 4 else {}
    result = Synthesis(
        "motion",
        chosen,
        "deviation",
        _shown(p, phi),
        counts,
        curves=curves,
        extent=extent_of(p),
        derivation=_derivation(p, phi, link_ratio),
    )
    if not chosen:
        raise SynthesisError(MOTION_NO_PAIRS)
    if all(each.defects for each in chosen):
        flaws = tuple(DEFECTS[name] for name in chosen[0].defects)
        raise SynthesisError(MOTION_NO_MOVABLE.format(why=flaws, defects=chosen[0].defects), result)
    if len(p) > 5:
        result = replace(result, notes=(MOTION_FITTED.format(poses=len(p)),))
    return result


def _window(corners: tuple[tuple[float, float], tuple[float, float]]) -> Window:
    """The window between two corners."""
    first, last = two_points(corners)
    return Window(first, last)


def _read(poses: ArrayLike) -> tuple[Complexes, Floats]:
    try:
        values = np.asarray(poses, float)
    except (TypeError, ValueError):
        raise SynthesisError(MOTION_POSES) from None
    if values.ndim != 2 or values.shape[1] != 3 or len(values) < 2 or not np.isfinite(values[:, :2]).all():
        raise SynthesisError(MOTION_POSES)
    p, phi = values[:, 0] + 1j * values[:, 1], values[:, 2]
    size = np.ptp(p.real) + np.ptp(p.imag)
    same = [
        (i + 1, j + 1)
        for i in range(len(p))
        for j in range(i)
        if abs(p[i] - p[j]) <= 1e-12 * size and abs(cmath.exp(1j * (phi[i] - phi[j])) - 1) < 1e-12
    ]
    if same:
        raise SynthesisError(
            _(
                "poses {first} and {second} are the same; leave one out",
                code="synthesize.motion.same",
                first=same[0][1],
                second=same[0][0],
            )
        )
    return p, phi


def _special(p: Complexes, phi: Floats, link_ratio: float, count: int) -> None:
    """Raises SynthesisError for poses that one pin or slide guides, or that do not turn and lie on no circle."""
    d, e = relative_poses(p, phi)
    size = scale_of(p)
    turns = np.abs(e - 1).max() > 1e-9
    if turns and len(p) > 2:
        pole = complex(np.linalg.lstsq((e - 1)[:, None], -d, rcond=None)[0][0])
        if np.abs(d + (e - 1) * pole).max() <= 1e-9 * (size + abs(pole)):
            place = p[0] + pole
            raise SynthesisError(
                _(
                    "all poses are turns about one point, ({x}, {y}) m: a single pin there guides the body, "
                    "and no linkage is needed; move a pose if a four-bar is wanted",
                    code="synthesize.motion.one_pin",
                    x=f"{place.real:.6g}",
                    y=f"{place.imag:.6g}",
                )
            )
    if turns or len(p) < 3:
        return
    if np.linalg.matrix_rank(np.stack([d.real, d.imag]), 1e-9 * size) < 2:
        raise SynthesisError(
            _(
                "the poses do not turn and lie on one line: a straight guide leads the body, and no "
                "four-bar does; turn or move a pose",
                code="synthesize.motion.slide",
            )
        )
    found = circles(size * AROUND, p, d, e)
    off = np.abs(found.positions - found.centre[:, None])
    error = ((off - off.mean(1, keepdims=True)) ** 2).sum(1)
    if np.sqrt(error.max()) > 1e-9 * size:
        made = _pairs(found, error, p, phi, link_ratio, count)
        notes = (MOTION_FITTED.format(poses=len(p)),)
        nearest = Synthesis("motion", made, "deviation", _shown(p, phi), notes=notes, extent=extent_of(p))
        raise SynthesisError(
            _(
                "the poses do not turn, so all points of the body have the same motion, and their places lie on no "
                "circle: the nearest parallelogram is off by {off} m (shown); turn a pose or move it",
                code="synthesize.motion.no_turn",
                off=f"{np.sqrt(error.max() / len(p)):.4g}",
            ),
            nearest,
        )


def _mixed(p: Complexes, phi: Floats, link_ratio: float, count: int) -> Synthesis:
    """Poses some of whose angles are free."""
    if len(p) < 3:
        raise SynthesisError(
            _(
                "{poses} poses are too few where angles are free; give three or more",
                code="synthesize.motion.mixed",
                poses=len(p),
            )
        )
    every = counted_solutions(p, phi)
    notes = (
        _(
            "{free} angles are free: solutions from many starts, not provably all",
            code="synthesize.motion.mixed_note",
            free=int(np.isnan(phi).sum()),
        ),
    )
    counts = {}
    if every is not None:
        counts = {"solutions": every[1], "real": len(every[0])}
        notes = (
            _(
                "{found} of {known} solutions were found, {real} of them real",
                code="synthesize.motion.mixed_all",
                found=every[1],
                known=every[2],
                real=len(every[0]),
            ),
        )
    made: list[Candidate] = []
    for angles, pair, squares in mixed_solutions(p, phi) if every is None or not every[0] else every[0]:
        for first, second in ((0, 1), (1, 0)):
            made += _pairs(pair[np.array([first, second])], np.array([squares, 0.0]), p, angles, link_ratio, 1)
    size = scale_of(p)
    chosen = different(ranked(made, size, extent_of(p)), 0.02 * size)[:count]
    if not chosen:
        raise SynthesisError(MOTION_NO_PAIRS)
    result = Synthesis(
        "motion",
        chosen,
        "deviation",
        _shown(p, phi),
        counts | {"pairs": len(made)},
        notes,
        extent=extent_of(p),
        derivation=MotionDerivation(p, phi, link_ratio),
    )
    if every is not None and not every[0]:
        raise SynthesisError(
            _(
                "none of the {found} solutions of these poses and points is real; the nearest solution "
                "is that of least squares, whose links' lengths differ by {error} m",
                code="synthesize.motion.mixed_none",
                found=every[1],
                error=f"{chosen[0].error:.4g}",
            ),
            result,
        )
    if chosen[0].defects:
        flaws = tuple(DEFECTS[name] for name in chosen[0].defects)
        raise SynthesisError(MOTION_NO_MOVABLE.format(why=flaws, defects=chosen[0].defects), result)
    return result


def _pairs(
    found: Dyads, error: Floats, p: Complexes, phi: Floats, link_ratio: float, count: int
) -> tuple[Candidate, ...]:
    """The best pairs: the first dyad a crank, the second a crank or a slider."""
    pins = np.flatnonzero(~found.slides)
    first, second = (each.ravel() for each in np.meshgrid(pins, np.arange(len(found)), indexing="ij"))
    separated = np.abs(found.point[first] - found.point[second]) > 1e-6 * scale_of(p)
    first, second = first[separated], second[separated]
    rows: list[tuple[Assessment, Integers, Integers]] = []
    for slider in (False, True):
        use = found.slides[second] == slider
        if use.any():
            rows.append((_assess(found, first[use], second[use], slider), first[use], second[use]))
    keys = [
        (facts, i, j, k, float(error[i] + error[j]))
        for facts, a, b in rows
        for k in _best(facts, error[a] + error[b], p, link_ratio, count)
        for i, j in [(int(a[k]), int(b[k]))]
    ]
    made = [_candidate(found, facts, i, j, k, worst, p, phi) for facts, i, j, k, worst in keys]
    sound = np.array([not each.defects and each.link_ratio <= link_ratio for each in made], dtype=bool)
    if not made:
        return ()
    error = np.array([each.error for each in made])
    order = ranking(error, merits(made, extent_of(p)), sound, scale_of(p))
    return different(tuple(made[i] for i in order), 0.08 * scale_of(p) if len(p) < 5 else 0.0)[:count]


def _best(facts: Assessment, error: Floats, p: Complexes, link_ratio: float, count: int) -> list[int]:
    sound = facts.sound & (facts.ratio <= link_ratio)
    worth = merit(facts.transmission, facts.ratio, facts.longest, extent_of(p))
    order = ranking(np.sqrt(error), worth, sound, scale_of(p))
    return [int(k) for k in order[: 30 * count]]


def _assess(found: Dyads, first: Integers, second: Integers, slider: bool) -> Assessment:
    o1, a, b = found.centre[first], found.positions[first], found.positions[second]
    if not slider:
        return assess_four_bars(o1, a, b, found.centre[second])
    direction = found.direction[second]
    return assess_slider_cranks(o1, a, b, direction, ((b[:, 0] - o1) * direction.conj()).imag)


def _candidate(
    found: Dyads, facts: Assessment, i: int, j: int, k: int, squares: float, p: Complexes, phi: Floats
) -> Candidate:
    o1, a, b = complex(found.centre[i]), found.positions[i], found.positions[j]
    error = float(np.sqrt(squares / len(p)))
    if not found.slides[j]:
        o2 = complex(found.centre[j])
        curve = path_of_four_bar(o1, a[0], b[0], o2, p[0])
        return four_bar_candidate(o1, a, b, o2, facts, k, error, p=complex(p[0]), worst=error, curve=curve, path=p)
    direction = complex(found.direction[j])
    span = working_span(facts, k, cmath.phase(direction))
    turns = bool(facts.turns[k])
    linkage = slider_crank(o1, complex(a[0]), complex(b[0]), direction, complex(p[0]), span=span, turns=turns)
    return candidate(linkage, facts, k, error, worst=error, positions={"A": a, "B": b, "P": p})


def _nearest(p: Complexes, phi: Floats, link_ratio: float, count: int) -> Synthesis | None:
    """The best linkages of least squares, where the exact ones are not real."""
    found, squares = fitted(p, phi, np.random.default_rng(0))
    chosen = _pairs(found, squares, p, phi, link_ratio, count) if len(found) > 1 else ()
    notes = (MOTION_FITTED.format(poses=len(p)),)
    if not chosen:
        return None
    return Synthesis("motion", chosen, "deviation", _shown(p, phi), notes=notes, extent=extent_of(p))


def _shown(p: Complexes, phi: Floats) -> Complexes:
    """Places and turns of the poses for the picture; 0 for a free angle."""
    return np.stack([p, np.where(np.isnan(phi), 0, np.exp(1j * np.nan_to_num(phi)))])


def _curves(p: Complexes, phi: Floats, window: Window) -> dict[str, Complexes]:
    """Sampled circle-point curve (at the first pose) and centre-point curve of four poses, for the picture."""
    shifted = Window(window.low - complex(p[0]), window.high - complex(p[0]))
    d, e = relative_poses(p, phi)
    di, phi_i = inverse_poses(p, phi)
    ei = np.exp(1j * phi_i)
    return {
        "circle_points": p[0] + circle_points(d, e, shifted, 4 * LINES),
        "centre_points": p[0] + circle_points(di, ei, shifted, 4 * LINES),
    }
