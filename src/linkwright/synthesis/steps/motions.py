"""Steps of motion generation: poles, Burmester's curves and points, the circles of both pins.

A body point with the coordinates (ξ, η) in the axes of the body lies at A_j = p_j + R(φ_j) (ξ, η). Its positions lie
on a circle about C where 2 (A_j - A_1)·C = A_j² - A_1² for j = 2 … n: the perpendicular bisectors meet in C.
Source: Burmester 1888; McCarthy and Soh 2011, Geometric Design of Linkages.
"""

from __future__ import annotations

import math

import numpy as np

from linkwright.core.arrays import Complexes
from linkwright.equations.matrix import Entries
from linkwright.equations.steps import Step
from linkwright.equations.terms import Term, root, symbol
from linkwright.synthesis.motion_generation.families import POWERS
from linkwright.synthesis.motion_generation.generate import MotionDerivation
from linkwright.synthesis.steps.writing import (
    Writer,
    coordinates,
    decimals,
    degrees,
    examine,
    matrix,
    numbers,
    product,
    small,
)
from linkwright.words import Message, _, pgettext

#: Most poses of which every pole is printed.
MOST_POLES = 5
#: Turns (rad) below which two poses are parallel, and have no pole.
PARALLEL = 1e-9
#: Share of a circle's radius within which its points lie on it.
MET = 1e-9


def motion(w: Writer, d: MotionDerivation) -> None:
    """The poses, their poles, the curves or points of Burmester, and the circles of the pins that were taken."""
    _requirements(w, d)
    free = bool(np.isnan(d.phi).any())
    if not free and len(d.p) <= MOST_POLES:
        _poles(w, d)
    if d.circle_curve is not None:
        _curves(w, d)
    elif d.points is not None:
        _points(w, d)
    else:
        step = w.step(_("Dyads"))
        step.note(w.translate(_family(d, w.found.counts.get("dyads", 0))))
    _circles(w, d)
    if not w.found.best.linkage.guides:
        examine(w, w.found.best)


def _family(d: MotionDerivation, dyads: int) -> Message:
    if np.isnan(d.phi).any():
        return _("Some angles are free; they are unknowns like pins and pivots.")
    if len(d.p) == 2:
        return _(
            "Two poses: every body point lies on a circle about any point of the bisector of its two "
            "places; {dyads} dyads were sampled, and all their pairs examined.",
            dyads=dyads,
        )
    if len(d.p) == 3:
        return _(
            "Three poses: every body point has a circle through its three places; {dyads} dyads were "
            "sampled within the region, and all their pairs examined.",
            dyads=dyads,
        )
    return _(
        "{count} poses cannot all be met exactly: dyads of least squares, from Burmester's points "
        "of many sets of five poses; {dyads} different ones were found.",
        count=len(d.p),
        dyads=dyads,
    )


def _requirements(w: Writer, d: MotionDerivation) -> None:
    step = w.step(pgettext("synthesis_steps", "Given"))
    step.note(
        w.translate(_("{count} poses: place of the coupler point P, and angle φ of the coupler.", count=len(d.p)))
    )
    free = w.translate(pgettext("synthesis_steps", "free"))
    angles = [free if math.isnan(each) else degrees([each])[0] for each in d.phi]
    columns = [
        (w.translate(_("pose")), numbers(len(d.p))),
        (w.over("x"), w.lengths(d.p.real)),
        (w.over("y"), w.lengths(d.p.imag)),
        ("φ / °", angles),
    ]
    w.table(step, _("Poses of the coupler"), columns)


def _poles(w: Writer, d: MotionDerivation) -> None:
    """Poles of all pairs of poses: the points that have the same place in both."""
    step = w.step(_("Poles"))
    step.note(
        w.translate(
            _(
                "A body that goes from pose j to pose k turns about the pole P_jk, the point that "
                "has the same place in both. Pins and pivots subtend at the poles half "
                "these turns:"
            )
        )
    )
    pairs, places, turns = [], [], []
    for j in range(len(d.p)):
        for k in range(j + 1, len(d.p)):
            turn = d.phi[k] - d.phi[j]
            unit = np.exp(1j * turn)
            pairs.append(f"P_{j + 1}{k + 1}")
            turns.append(turn)
            parallel = abs(unit - 1) < PARALLEL
            places.append(np.nan if parallel else (d.p[k] - unit * d.p[j]) / (1 - unit))
    at: Complexes = np.array(places)
    columns = [
        (w.translate(_("pole")), pairs),
        ("φ_k − φ_j / °", degrees(turns)),
        (w.over("x"), [text.replace("nan", "∞") for text in w.lengths(at.real)]),
        (w.over("y"), [text.replace("nan", "∞") for text in w.lengths(at.imag)]),
    ]
    w.table(step, _("Poles of the poses"), columns)


def _curves(w: Writer, d: MotionDerivation) -> None:
    """Equations of the circle- and centre-point curve of four poses, and both chosen pairs in them."""
    assert d.circle_curve is not None and d.centre_curve is not None
    step = w.step(_("Circle-point and centre-point curve"))
    step.note(
        w.translate(
            _(
                "Of four poses, the body points whose positions lie on a circle are the circle-point "
                "curve (at pose 1), the centres of those circles are the centre-point curve: both "
                "are cubics, where the determinant of the three bisectors vanishes. With u and v the "
                "coordinates from P in pose 1, in units of {size}, the sum of coefficient times term "
                "is zero:",
                size=w.length_text(d.size),
            )
        )
    )
    powers = [_power(i, j) for i, j in POWERS]
    columns = [
        (w.translate(_("term")), powers),
        (w.translate(_("circle points")), decimals(d.circle_curve, 6)),
        (w.translate(_("centre points")), decimals(d.centre_curve, 6)),
    ]
    w.table(step, _("Coefficients of both curves"), columns)
    best = w.found.best
    rows = []
    pins = [("A", "O1"), ("B", "O2")]
    for pin, pivot in pins:
        if pivot not in best.linkage.points:
            continue
        first, centre = best.positions[pin][0] - d.p[0], best.linkage.points[pivot] - d.p[0]
        for name, place, curve in ((pin, first, d.circle_curve), (pivot, centre, d.centre_curve)):
            u, v = place.real / d.size, place.imag / d.size
            left = sum(c * u**i * v**j for c, (i, j) in zip(curve, POWERS, strict=True))
            rows.append((name, f"{u:.6f}", f"{v:.6f}", small([left], 100.0)[0]))
    step.note(w.translate(_("The pins and the pivots that were taken, put in:")))
    table = list(zip(*rows, strict=True))
    heads = (w.translate(_("point")), "u", "v", w.translate(_("left side")))
    w.table(step, _("The chosen points on the curves"), list(zip(heads, table, strict=True)), "<>>>")


def _power(i: int, j: int) -> str:
    parts = [name + {1: "", 2: "²", 3: "³"}[n] for name, n in (("u", i), ("v", j)) if n]
    return "".join(parts) or "1"


def _points(w: Writer, d: MotionDerivation) -> None:
    """Burmester's four points of five poses."""
    assert d.points is not None and d.centres is not None and d.real is not None and d.slides is not None
    step = w.step(_("Burmester's points"))
    step.note(
        w.translate(
            _(
                "Five poses: the condition of a circle is linear in seven products of point and "
                "centre; two quadratic relations between these leave four solutions. A is the pin in "
                "pose 1, O the centre of its circle:"
            )
        )
    )
    at = d.points + d.p[0]
    kinds = [
        w.translate(_("complex") if not real else (_("real, a straight line") if slides else _("real, a circle")))
        for real, slides in zip(d.real, d.slides, strict=True)
    ]
    columns = [(w.translate(_("solution")), numbers(len(at)))]
    for name, values in (("A", at), ("O", d.centres)):
        shown = [w.lengths([part]) if real else ["–"] for part, real in zip(values.real, d.real, strict=True)]
        other = [w.lengths([part]) if real else ["–"] for part, real in zip(values.imag, d.real, strict=True)]
        columns += [
            (w.over(f"x_{name}"), [each[0] for each in shown]),
            (w.over(f"y_{name}"), [each[0] for each in other]),
        ]
    columns.append((w.translate(pgettext("synthesis_steps", "kind")), kinds))
    w.table(step, _("Burmester's points of the five poses"), columns, ">>>>><")


def _circles(w: Writer, d: MotionDerivation) -> None:
    """The positions of both pins, and their circle's centre from the bisectors."""
    best = w.found.best
    step = w.step(_("Positions of the pins, and the fixed pivots"))
    step.note(w.translate(_("Places of both pins in every pose:")))
    columns = [(w.translate(_("pose")), numbers(len(d.p))), *coordinates(w, best, ("A", "B"))]
    w.table(step, _("Positions of the moving points"), columns)
    for pin, pivot in (("A", "O1"), ("B", "O2")):
        if pivot in best.linkage.points:
            _centre(w, step, best.positions[pin], (pin, pivot))
        else:
            _line(w, step, best.positions[pin])
    w.picture("construction")


def _centre(w: Writer, step: Step, positions: Complexes, names: tuple[str, str]) -> None:
    """The bisectors as equations of the centre, their solution, and the radius in every pose."""
    pin, pivot = names
    places = positions * w.scale
    centre = w.found.best.linkage.points[pivot] * w.scale
    far = np.abs(places - centre)
    met = np.abs(far - far[0]).max() <= MET * far[0]
    unknown = [f"x_{pivot}", f"y_{pivot}"]
    if met:
        rows = 2 * (places[1:] - places[0])
        right = np.abs(places[1:]) ** 2 - np.abs(places[0]) ** 2
        step.note(
            w.translate(
                _(
                    "The perpendicular bisectors of {pin}1 {pin}j meet in {pivot}: 2 ({pin}j − "
                    "{pin}1)·{pivot} = {pin}j² − {pin}1²",
                    pin=pin,
                    pivot=pivot,
                )
            )
        )
        known = matrix(np.stack([rows.real, rows.imag], 1), 4)
        product(step, known, Entries.of(unknown), "=", matrix(right, 4))
    else:
        step.note(
            w.translate(
                _(
                    "The bisectors of {pin}1 {pin}j do not meet in one point; {pivot} is the centre with "
                    "the smallest sum of squared differences of the distances:",
                    pin=pin,
                    pivot=pivot,
                )
            )
        )
    x, y = (
        symbol(name, value if abs(value) > MET * far[0] else 0.0)
        for name, value in zip(unknown, (centre.real, centre.imag), strict=True)
    )
    step.give(x, w.unit)
    step.give(y, w.unit)
    first = [
        symbol(f"{axis}_{pin}1", value)
        for axis, value in (("x", float(places[0].real)), ("y", float(places[0].imag)))
    ]
    radius: Term = root((first[0] - x).squared + (first[1] - y).squared)
    step.find(symbol(f"l_{pivot}{pin}", float(far[0])), radius, w.unit)
    off = 0.0 if met else float(np.abs(far - far[0]).max())
    radii = ", ".join(w.lengths(far / w.scale))
    step.note(
        w.translate(
            _(
                "Distances {pivot} {pin} in the poses: {radii} {unit}; they differ by at most {off} {unit}.",
                pin=pin,
                pivot=pivot,
                radii=radii,
                unit=w.unit,
                off=f"{off:.4g}",
            )
        )
    )


def _line(w: Writer, step: Step, positions: Complexes) -> None:
    """The straight line of a pin that slides."""
    chord = positions[np.abs(positions - positions[0]).argmax()] - positions[0]
    unit = chord / abs(chord)
    off = ((positions - positions[0]) * unit.conj()).imag
    step.note(
        w.translate(
            _(
                "B slides: its places lie on a straight line at the angle {angle}°, off by at most {off} {unit}.",
                angle=f"{math.degrees(np.angle(unit)):.4f}",
                off=small([np.abs(off).max() * w.scale], abs(chord) * w.scale)[0],
                unit=w.unit,
            )
        )
    )
