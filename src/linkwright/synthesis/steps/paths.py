"""Steps of paths, straight lines, dwells and free curves: what was sought, and what can be checked by hand."""

from __future__ import annotations

import math

import numpy as np

from linkwright.core.quantity import number
from linkwright.equations.steps import Step
from linkwright.equations.terms import Pair, symbol, total
from linkwright.synthesis.free_curve.generate import FreeCurveDerivation
from linkwright.synthesis.names import TYPE_NAMES
from linkwright.synthesis.path_generation.exact import NinePointDerivation
from linkwright.synthesis.path_generation.generate import PathDerivation
from linkwright.synthesis.requirements.dwell import DwellDerivation
from linkwright.synthesis.requirements.straight_line import FOUR_BARS, StraightLineDerivation
from linkwright.synthesis.result import error_texts
from linkwright.synthesis.steps.writing import (
    Writer,
    coordinates,
    decimals,
    degrees,
    examine,
    four_bar_lengths,
    numbers,
    small,
)
from linkwright.words import _, pgettext

#: Points of a free curve that are shown.
SHOWN = 12
#: Path points whose squares are written out.
WRITTEN = 9


def path(w: Writer, d: PathDerivation) -> None:
    """Points, unknowns, and the coupler point at every one of them."""
    points = d.demand.points
    step = w.step(pgettext("synthesis_steps", "Given"))
    step.note(w.translate(_("{count} points that the coupler point P shall pass in this order.", count=len(points))))
    columns = [
        (w.translate(_("point")), numbers(len(points))),
        (w.over("x"), w.lengths(points.real)),
        (w.over("y"), w.lengths(points.imag)),
    ]
    if d.demand.timed:
        columns.append(("θ / °", degrees(d.demand.angles)))
    w.table(step, _("Points of the path"), columns)
    step = w.step(_("What is searched, and how"))
    step.note(
        w.translate(
            _(
                "P = O1 + a e^(iθ) + p e^(iδ) with the crank a and the vector p on the coupler. For "
                "given ratios of the lengths and crank angles the place, size and direction of the "
                "linkage follow from linear least squares; only ratios and angles are iterated."
            )
        )
    )
    unknowns = 2 * len(points) - d.demand.excess
    equations = 2 * len(points)
    step.note(
        w.translate(
            _(
                "{equations} equations for {unknowns} unknowns: the sum of squared distances is made "
                "smallest, from many starts; {optima} optima were compared.",
                equations=equations,
                unknowns=unknowns,
                optima=d.optima,
            )
            if d.demand.excess > 0
            else _(
                "{equations} equations for {unknowns} unknowns: the points can be passed exactly, in many "
                "ways; {optima} solutions from many starts were compared.",
                equations=equations,
                unknowns=unknowns,
                optima=d.optima,
            )
        )
    )
    if d.demand.pivot is not None:
        step.note(w.translate(_("The crank's pivot is given.")))
    _coupler_point(w)
    _points_met(w)
    examine(w, w.found.best)


def _coupler_point(w: Writer) -> None:
    """Pivots, and the coupler point in the axes of the coupler."""
    step = w.step(_("The linkage found"))
    points = w.found.best.linkage.points
    for name in ("O1", "O2"):
        for axis, value in (("x", points[name].real), ("y", points[name].imag)):
            step.give(symbol(f"{axis}_{name}", value * w.scale), w.unit)
    for term in four_bar_lengths(w, w.found.best):
        step.give(term, w.unit)
    along = points["B"] - points["A"]
    local = (points["P"] - points["A"]) * along.conjugate() / abs(along)
    step.note(w.translate(_("The coupler point from A, along AB (ξ) and to the left of it (η):")))
    for axis, value in (("ξ", local.real), ("η", local.imag)):
        step.give(symbol(axis, value * w.scale), w.unit)


def _points_met(w: Writer) -> None:
    """Pins and coupler point at every demanded point, its distance, and the sum of squares."""
    found, best = w.found, w.found.best
    target = found.target
    assert target is not None
    step = w.step(_("Error at every position"))
    step.note(w.translate(_("Pins and coupler point at every point:")))
    w.table(
        step,
        _("Positions of the moving points"),
        [(w.translate(_("point")), numbers(len(target))), *coordinates(w, best, "ABP")],
    )
    places = best.positions["P"]
    off = np.abs(places - target)
    columns = [
        (w.translate(_("point")), numbers(len(target))),
        (w.over("x"), w.lengths(target.real)),
        (w.over("y"), w.lengths(target.imag)),
        (w.over("x_P"), w.lengths(places.real)),
        (w.over("y_P"), w.lengths(places.imag)),
        (w.over(w.translate(_("distance"))), small(off * w.scale, found.extent * w.scale)),
    ]
    w.table(step, _("Deviation at every position"), columns)
    size = found.extent * w.scale
    if off.max() * w.scale > 1e-9 * size and len(off) <= WRITTEN:
        terms = [w.length("e", float(each), str(i + 1)).squared for i, each in enumerate(off)]
        value = float((off**2).sum()) * w.scale**2
        step.find(symbol("Σe²", value), total(terms), f"{w.unit}²")
    else:
        step.note(w.translate(_("Sum of squared distances: {squares} m².", squares=error_texts(best)[0])))
    w.picture("structural_error")


def nine_points(w: Writer, d: NinePointDerivation) -> None:
    """Nine points: all classes of cognates, and the check of the lengths in every position."""
    step = w.step(pgettext("synthesis_steps", "Given"))
    columns = [
        (w.translate(_("point")), numbers(len(d.points))),
        (w.over("x"), w.lengths(d.points.real)),
        (w.over("y"), w.lengths(d.points.imag)),
    ]
    w.table(step, _("Points of the path"), columns)
    step = w.step(_("What is searched, and how"))
    step.note(
        w.translate(
            _(
                "Nine points leave no number free: all {classes} of 1442 classes of cognates were "
                "found by continuation, {real} of them real; their {examined} four-bars, with both "
                "inputs and all cognates, were examined, {sound} are without defects.",
                classes=d.classes,
                real=d.real,
                examined=d.examined,
                sound=d.sound,
            )
        )
    )
    _coupler_point(w)
    step = w.step(_("Error at every position"))
    step.note(
        w.translate(
            _(
                "P lies at the nine points; the lengths |O1A|, |AB| and |O2B| from these coordinates "
                "are the same in all of them:"
            )
        )
    )
    best = w.found.best
    w.table(
        step,
        _("Positions of the moving points"),
        [(w.translate(_("point")), numbers(len(d.points))), *coordinates(w, best, "ABP")],
    )
    examine(w, best)


def straight_line(w: Writer, d: StraightLineDerivation) -> None:
    """The proportions of the linkage, its scale, and the distance from the line along the stretch."""
    best = w.found.best
    kind = best.linkage.kind
    step = w.step(pgettext("synthesis_steps", "Given"))
    step.give(w.length("s", d.length), w.unit)
    step.give(w.length("δ", d.allowed), w.unit)
    step.note(
        w.translate(
            _(
                "The kind of linkage is demanded; the longest stretch of its path that is straight enough is "
                "made as long as demanded."
            )
            if d.compared == 1
            else _(
                "{count} classical linkages were compared, each by the longest stretch of its path that "
                "is straight enough; there is one in {good} of them.",
                count=d.compared,
                good=len(w.found),
            )
        )
    )
    step = w.step(_("Link lengths"))
    step.note(
        w.translate(
            (
                _(
                    "Peaucellier's linkage: arms L, rhombus s and crank r equal to the frame keep P at "
                    "the distance (L² − s²)/(2 r) from the arms' pivot, on a straight line. Its lengths "
                    "are in the last table."
                )
                if kind == "peaucellier"
                else _("{kind}'s proportions, with the unit m that makes the stretch as long as demanded:")
            ).format(kind=kind.capitalize())
        )
    )
    if kind in FOUR_BARS:
        _proportions(w, step, kind)
    _along(w, best.positions["P"], best.deviations)
    if kind in FOUR_BARS:
        examine(w, best)


def _proportions(w: Writer, step: Step, kind: str) -> None:
    shape = FOUR_BARS[kind]
    sides = four_bar_lengths(w, w.found.best)
    unit = symbol("m", sides[3].amount / shape.frame)
    step.give(unit, w.unit)
    for term, share in zip(sides, (shape.crank, shape.coupler, shape.output, shape.frame), strict=True):
        step.find(term, symbol(f"{share:.6g}", share) * unit, w.unit)


def _along(w: Writer, places: np.ndarray, off: np.ndarray) -> None:
    """Coordinates of the drawing point along the stretch, and its distance from the line."""
    step = w.step(_("Error at every position"))
    step.note(
        w.translate(
            _(
                "The drawing point along the stretch, and its distance from the line through the "
                "first of these points:"
            )
        )
    )
    columns = [
        (w.translate(_("position")), numbers(len(places))),
        (w.over("x_P"), w.lengths(places.real)),
        (w.over("y_P"), w.lengths(places.imag)),
        (w.over(w.translate(_("distance"))), small(off * w.scale, float(np.ptp(np.abs(places))) * w.scale)),
    ]
    w.table(step, _("Deviation at every position"), columns)
    step.note(w.translate(_("Maximum distance from the line: {error}.", error=w.length_text(w.found.best.error))))
    w.picture("structural_error")


def dwell(w: Writer, d: DwellDerivation) -> None:
    """The arc of the coupler curve, the radius at several positions of the rest, and what the output deviates."""
    best = w.found.best
    step = w.step(pgettext("synthesis_steps", "Given"))
    step.give(w.angle("θ", d.crank_angle), "°")
    step.give(w.angle("ψ", d.swing_angle), "°")
    step.give(w.length("d", d.frame), w.unit)
    step = w.step(_("What is searched, and how"))
    step.note(
        w.translate(
            _(
                "{tried} crank-rockers with random coupler points were tried, and of each the "
                "stretch over this crank angle that is nearest to a circular arc; for the best "
                "{arcs} the output's pivot was searched so that it swings as demanded.",
                tried=d.tried,
                arcs=d.arcs,
            )
        )
    )
    step = w.step(_("The arc of the coupler curve"))
    step.note(
        w.translate(
            _(
                "While P runs along this arc, a link of the length ρ keeps its other end Q in the "
                "centre C, and the output rests:"
            )
        )
    )
    centre = Pair(w.length("x", d.centre.real, "C"), w.length("y", d.centre.imag, "C"))
    step.give(centre.x, w.unit)
    step.give(centre.y, w.unit)
    step.give(w.length("ρ", d.radius), w.unit)
    places = best.positions["P"]
    far = np.abs(places - d.centre)
    columns = [
        (w.translate(_("position")), numbers(len(places))),
        ("θ / °", degrees(d.crank, 3)),
        (w.over("x_P"), w.lengths(places.real)),
        (w.over("y_P"), w.lengths(places.imag)),
        (w.over("|CP|"), w.lengths(far)),
        (w.over("|CP| − ρ"), small((far - d.radius) * w.scale, d.radius * w.scale)),
        ("Δψ / °", decimals(np.degrees(best.deviations), 5)),
    ]
    w.table(step, _("Positions during the rest"), columns)
    step.note(
        w.translate(
            _(
                "During the rest the output deviates by at most ±{error}°; over the turn it swings {swing}°.",
                error=number(best.error, "angle", 4),
                swing=number(d.swing_angle, "angle"),
            )
        )
    )
    w.picture("structural_error")


def free_curve(w: Writer, d: FreeCurveDerivation) -> None:
    """The measure, the search's demands, and how far the drawn curve lies from some points of the given one."""
    best = w.found.best
    step = w.step(pgettext("synthesis_steps", "Given"))
    points = len(d.curve)
    step.note(
        w.translate(
            _("A closed curve by {points} corners; its centroid S and root mean square radius R:", points=points)
            if d.closed
            else _("An open curve by {points} corners; its centroid S and root mean square radius R:", points=points)
        )
    )
    for name, value in (("x_S", d.centroid.real), ("y_S", d.centroid.imag), ("R", d.radius)):
        letter, _unused, index = name.partition("_")
        step.give(w.length(letter, value, index), w.unit)
    step = w.step(_("What is searched, and how"))
    step.note(
        w.translate(
            _(
                "Error: mean nearest distance from the curve to the drawn curve, plus that back, "
                "divided by R. Centroid and R of both curves are the same."
            )
        )
    )
    step.note(
        w.translate(
            _(
                "Linkages are random structures, improved by descent and changed again: transmission "
                "angles of at least {angle}°, every joint within {size} R of S; in {seconds} s "
                "{attempts} were tried and {designs} different ones remained.",
                angle=f"{math.degrees(d.transmission_angle):g}",
                size=f"{d.size:g}",
                seconds=f"{d.seconds:g}",
                attempts=d.attempts,
                designs=d.designs,
            )
        )
    )
    step.note(
        w.translate(
            _(
                "First candidate: {kind}, {links} links, {joints} joints.",
                kind=TYPE_NAMES[best.grashof_type],
                joints=f"{best.values['joints']:g}",
                links=f"{best.values['links']:g}",
            )
        )
    )
    step = w.step(_("Error at every position"))
    chosen = np.unique(np.linspace(0, len(d.curve) - 1, SHOWN).round().astype(int))
    points, drawn = d.curve[chosen], best.curve
    assert drawn is not None
    nearest = drawn[np.abs(points[:, None] - drawn).argmin(1)]
    columns = [
        (w.translate(_("point")), numbers(len(points))),
        (w.over("x"), w.lengths(points.real)),
        (w.over("y"), w.lengths(points.imag)),
        (w.over("x_P"), w.lengths(nearest.real)),
        (w.over("y_P"), w.lengths(nearest.imag)),
        (w.over(w.translate(_("distance"))), small(np.abs(nearest - points) * w.scale, d.radius * w.scale)),
    ]
    step.note(w.translate(_("Some corners of the curve, and the nearest point of the drawn curve:")))
    w.table(step, _("Deviation at every position"), columns)
    step.note(
        w.translate(
            _(
                "Error {error} (in lengths {mean}), largest nearest distance {worst}.",
                error=f"{best.error:.4g}",
                mean=w.length_text(best.error * d.radius),
                worst=w.length_text(best.worst * d.radius),
            )
        )
    )
