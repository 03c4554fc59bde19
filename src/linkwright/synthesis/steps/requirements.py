"""Steps of the tasks that formulas solve: slider-crank, slotted lever, toggle, and from limit positions."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from linkwright.equations.steps import Step
from linkwright.equations.terms import (
    FOUR,
    ONE,
    TWO,
    ZERO,
    Pair,
    Term,
    arccosine,
    arcsine,
    arctangent,
    cosine,
    number,
    root,
    sine,
    tangent,
)
from linkwright.synthesis.requirements.crank_rocker import CrankRockerDerivation, QuickReturnDerivation
from linkwright.synthesis.requirements.drag_link import DragLinkDerivation
from linkwright.synthesis.requirements.slider_crank import SliderCrankDerivation
from linkwright.synthesis.requirements.toggle import ToggleDerivation
from linkwright.synthesis.steps.writing import Writer, decimals, degrees, examine, four_bar_lengths
from linkwright.words import _, pgettext

HALF_TURN = number(180.0, degrees=True)
#: Angles of a toggle that its table shows, in parts of the stroke.
SHOWN = 7


def extreme_position_angle(w: Writer, step: Step, ratio: Term, radians: float) -> Term:
    """θ = 180° (K - 1)/(K + 1)."""
    step.note(
        w.translate(
            _(
                "The fast stroke takes the crank angle 180° − θ, the slow one 180° + θ, so K = (180° "
                "+ θ)/(180° − θ), and"
            )
        )
    )
    theta = w.angle("θ", radians)
    return step.find(theta, HALF_TURN * (ratio - ONE) / (ratio + ONE), "°")


def rounded(w: Writer, names: Sequence[str], lengths: Sequence[float], after: Sequence[float]) -> None:
    """The step in which lengths (m) are rounded; from there on the rounded ones are used."""
    step = w.step(_("Rounded lengths"))
    step.note(w.translate(_("From here on with the rounded lengths:")))
    columns = [
        (w.translate(pgettext("synthesis_steps", "length")), list(names)),
        (w.over(w.translate(_("calculated"))), w.lengths(lengths)),
        (w.over(w.translate(_("rounded"))), w.lengths(after)),
    ]
    w.table(step, _("Rounding of the lengths"), columns, "<>>")


def slider_crank(w: Writer, d: SliderCrankDerivation) -> None:
    """Crank, rod and offset from the stroke; then stroke, K and transmission angles again from the lengths."""
    r, rod, e = w.length("r", d.crank), w.length("l", d.rod), w.length("e", d.offset)
    stroke = w.length("H", d.stroke)
    step = w.step(pgettext("synthesis_steps", "Given"))
    step.give(stroke, w.unit)
    {"ratios": _from_ratios, "quick_return": _from_quick_return, "transmission": _from_transmission}[d.way](
        w, d, step, (stroke, r, rod, e)
    )
    w.picture("construction")
    if d.rounded is not None:
        rounded(w, ("r", "l", "e"), (d.crank, d.rod, d.offset), d.rounded)
        r, rod, e = (w.length(name, each) for name, each in zip("rle", d.rounded, strict=True))
    _slider_check(w, (r, rod, e))


def _from_ratios(w: Writer, d: SliderCrankDerivation, parent: Step, terms: tuple[Term, ...]) -> None:
    stroke, r, rod, e = terms
    lam = parent.give(w.value("λ", d.rod_ratio), "")
    eps = parent.give(w.value("ε", d.offset_ratio), "") if d.offset_ratio else ZERO
    step = w.step(_("Link lengths"))
    step.note(
        w.translate(
            _(
                "In the limit positions crank and rod lie in one line, at l + r and l − r from the "
                "crank's pivot. With l = λ r and e = ε r the stroke is"
            )
        )
    )
    outer = root((lam + ONE).squared - eps.squared) if d.offset_ratio else lam + ONE
    inner = root((lam - ONE).squared - eps.squared) if d.offset_ratio else lam - ONE
    step.relate(w.length("H", d.stroke), r * (outer - inner) if d.offset_ratio else TWO * r)
    step.find(r, stroke / (outer - inner) if d.offset_ratio else stroke / TWO, w.unit)
    step.find(rod, lam * r, w.unit)
    if d.offset_ratio:
        step.find(e, eps * r, w.unit)


def _from_quick_return(w: Writer, d: SliderCrankDerivation, parent: Step, terms: tuple[Term, ...]) -> None:
    stroke, r, rod, e = terms
    ratio = parent.give(w.value("K", d.quick_return_ratio), "")
    parent.give(e, w.unit)
    step = w.step(_("Angle between the crank's limit directions"))
    angle = math.pi * (d.quick_return_ratio - 1) / (d.quick_return_ratio + 1)
    theta = extreme_position_angle(w, step, ratio, angle)
    step = w.step(_("Link lengths"))
    step.note(
        w.translate(
            _(
                "The crank's pivot and both limit positions of the slider pin are a triangle with "
                "the sides l + r and l − r, the angle θ between them and the side H opposite, at the "
                "height e. Its area and the law of cosines give"
            )
        )
    )
    less = stroke * e / sine(theta)
    more = stroke.squared / TWO + stroke * e / tangent(theta)
    difference = step.find(w.value("q", less.value, "1"), less, f"{w.unit}²")
    total = step.find(w.value("q", more.value, "2"), more, f"{w.unit}²")
    step.relate(rod.squared - r.squared, difference)
    step.relate(rod.squared + r.squared, total)
    step.find(r, root((total - difference) / TWO), w.unit)
    step.find(rod, root((total + difference) / TWO), w.unit)


def _from_transmission(w: Writer, d: SliderCrankDerivation, parent: Step, terms: tuple[Term, ...]) -> None:
    stroke, r, rod, e = terms
    minimum = parent.give(w.angle("μ", d.transmission_angle, "min"), "°")
    if d.offset:
        parent.give(e, w.unit)
    step = w.step(_("Link lengths"))
    step.note(
        w.translate(
            _(
                "The transmission angle is smallest where the crank is perpendicular to the guide on "
                "the side away from it: cos μ_min = (r + e)/l."
            )
        )
    )
    if d.offset:
        step.relate(stroke, root((rod + r).squared - e.squared) - root((rod - r).squared - e.squared))
        step.note(
            w.translate(_("With l = (r + e)/cos μ_min the stroke grows with r; bisection of this equation gives"))
        )
        step.give(r, w.unit)
    else:
        step.find(r, stroke / TWO, w.unit)
    step.find(rod, (r + e) / cosine(minimum), w.unit)


def _slider_check(w: Writer, lengths: tuple[Term, Term, Term]) -> None:
    """Limit positions, stroke, K, and the transmission angles of both strokes."""
    r, rod, e = lengths
    step = w.step(_("Check with the lengths found"))
    step.note(
        w.translate(
            _(
                "Limit positions of the slider pin along the guide, from the foot of the crank's "
                "pivot; the stroke is their distance:"
            )
        )
    )
    far, near = rod + r, rod - r
    places = [
        step.find(w.length("x", _side(each, e).value / w.scale, index), _side(each, e), w.unit)
        for index, each in (("1", far), ("2", near))
    ]
    step.find(w.length("H", (places[0] - places[1]).value / w.scale), places[0] - places[1], w.unit)
    if not e.is_zero:
        turn = arcsine(e / near) - arcsine(e / far)
        theta = step.find(w.angle("θ", math.radians(turn.value)), turn, "°")
        ratio = (HALF_TURN + theta) / (HALF_TURN - theta)
        step.find(w.value("K", ratio.value), ratio, "")
    step.note(
        w.translate(
            _(
                "The crank turns fully: r + e = {sum} is at most l = {rod}.",
                sum=w.length_text((r + e).value / w.scale),
                rod=w.length_text(rod.amount / w.scale),
            )
        )
    )
    step.note(
        w.translate(
            _(
                "Smallest transmission angle of the slow (s) and of the fast (f) stroke, with the "
                "crank perpendicular to the guide on the guide's side and on the other one:"
            )
            if not e.is_zero
            else _("Smallest transmission angle, with the crank perpendicular to the guide:")
        )
    )
    for index, across in (("s", r - e), ("f", r + e)) if not e.is_zero else (("min", r),):
        angle = arccosine(across / rod)
        step.find(w.angle("μ", math.radians(angle.value), index), angle, "°")


def _side(hypotenuse: Term, e: Term) -> Term:
    """The side along the guide."""
    return hypotenuse if e.is_zero else root(hypotenuse.squared - e.squared)


def quick_return(w: Writer, d: QuickReturnDerivation) -> None:
    """Crank and arm of a slotted lever from K, the distance of its pivots and the stroke."""
    step = w.step(pgettext("synthesis_steps", "Given"))
    ratio = step.give(w.value("K", d.quick_return_ratio), "")
    frame = step.give(w.length("d", d.frame), w.unit)
    stroke = step.give(w.length("H", d.stroke), w.unit) if d.stroke else ZERO
    step = w.step(_("Angle between the crank's limit directions"))
    theta = extreme_position_angle(w, step, ratio, d.theta)
    step = w.step(_("Link lengths"))
    step.note(
        w.translate(
            _("In the limit positions the lever is tangent to the circle of the crank pin; the lever swings by θ:")
        )
    )
    half = sine(theta / TWO)
    crank = step.find(w.length("r", d.crank), frame * half, w.unit)
    if d.stroke:
        _ram(w, d, step, theta, stroke)
    w.picture("construction")
    step = w.step(_("Check with the lengths found"))
    step.note(w.translate(_("From crank and frame again:")))
    swing = TWO * arcsine(crank / frame)
    found = step.find(w.angle("θ", math.radians(swing.value)), swing, "°")
    again = (HALF_TURN + found) / (HALF_TURN - found)
    step.find(w.value("K", again.value), again, "")


def _ram(w: Writer, d: QuickReturnDerivation, step: Step, theta: Term, stroke: Term) -> None:
    """The lever's arm, the place of the guide and the rod."""
    step.note(w.translate(_("The end of the arm travels the chord of its arc, which is the stroke:")))
    arm = step.find(w.length("L", d.arm), stroke / (TWO * sine(theta / TWO)), w.unit)
    step.note(
        w.translate(
            _(
                "The guide halves the sagitta s of that arc, so that the rod is inclined equally to "
                "both sides. Distance y of the guide from the lever's pivot, and the sagitta:"
            )
        )
    )
    step.find(w.length("y", d.height), arm * (ONE + cosine(theta / TWO)) / TWO, w.unit)
    sagitta = arm * (ONE - cosine(theta / TWO))
    height = step.find(w.length("s", sagitta.value / w.scale), sagitta, w.unit)
    step.note(
        w.translate(_("With the rod l (as demanded, else at least half the arm) the ram's largest pressure angle is"))
    )
    rod = step.give(w.length("l", d.rod), w.unit)
    angle = arcsine(height / (TWO * rod))
    step.find(w.angle("α", math.radians(angle.value), "max"), angle, "°")


def toggle(w: Writer, d: ToggleDerivation) -> None:
    """Angle and links of a toggle from its force ratio, and the ratio over the stroke."""
    step = w.step(pgettext("synthesis_steps", "Given"))
    ratio = step.give(w.value("n", d.force_ratio), "")
    distance = step.give(w.length("s", d.distance), w.unit)
    stroke = step.give(w.length("H", d.stroke), w.unit)
    step = w.step(_("Link lengths"))
    step.note(
        w.translate(
            _("Virtual work of the force F on the knee and P on the slider: P/F = 1/(2 tan α), so at the ratio n")
        )
    )
    alpha = step.find(w.angle("α", d.alpha), arctangent(ONE / (TWO * ratio)), "°")
    step.note(w.translate(_("The slider is s = 2 l (1 − cos α) = 4 l sin²(α/2) before the dead point:")))
    link = step.find(w.length("l", d.link), distance / (FOUR * sine(alpha / TWO).squared), w.unit)
    step.note(w.translate(_("Over the full stroke H = 4 l sin²(α_0/2), so that it begins at")))
    step.find(w.angle("α", d.first_angle, "0"), TWO * arcsine(root(stroke / (FOUR * link))), "°")
    step = w.step(_("Check with the lengths found"))
    step.note(w.translate(_("Distance before the dead point and force ratio at some angles:")))
    angles = np.unique(np.append(np.linspace(d.first_angle, d.alpha / 4, SHOWN), d.alpha))[::-1]
    rows = [
        ("α / °", degrees(angles)),
        (w.over(w.translate(_("distance before the dead point"))), w.lengths(2 * d.link * (1 - np.cos(angles)))),
        ("P/F", decimals(1 / (2 * np.tan(angles)), 4)),
    ]
    w.table(step, _("Force ratio over the stroke"), rows)


def crank_rocker(w: Writer, d: CrankRockerDerivation) -> None:
    """The circle of the crank's pivots, the pivot that was taken, the lengths, and K and ψ again from them."""
    step = w.step(pgettext("synthesis_steps", "Given"))
    swing = step.give(w.angle("ψ", d.swing_angle), "°")
    ratio = step.give(w.value("K", d.quick_return_ratio), "")
    if d.frame:
        step.give(w.length("d", d.frame), w.unit)
    if d.rocker:
        step.give(w.length("c", d.rocker), w.unit)
    theta = extreme_position_angle(w, w.step(_("Angle between the crank's limit directions")), ratio, d.theta)
    _circle(w, d, swing, theta)
    a, b, c, frame = four_bar_lengths(w, w.found.best)
    _pivot(w, d, (a, b))
    w.picture("construction")
    _limits_again(w, (a, b, c, frame))
    examine(w, w.found.best)


def _circle(w: Writer, d: CrankRockerDerivation, swing: Term, theta: Term) -> None:
    """Chord, radius and centre of the circle from which the limit positions subtend θ."""
    step = w.step(_("Auxiliary circle of the crank's pivots"))
    c = step.give(w.length("c", d.rocker_length), w.unit)
    step.note(
        w.translate(
            _(
                "The limit positions B1 and B2 of the rocker pin lie symmetrically about the y axis, "
                "the rocker's pivot at the origin; their chord is"
            )
        )
    )
    half = swing / TWO
    chord = step.find(w.length("s", 2 * d.rocker_length * math.sin(d.swing_angle / 2)), TWO * c * sine(half), w.unit)
    if d.centre is None:
        step.note(
            w.translate(
                _(
                    "With K = 1 the angle θ is zero: crank and coupler have the same direction in both "
                    "limit positions, and the crank's pivot lies on the line B1 B2."
                )
            )
        )
        return
    step.note(
        w.translate(
            _(
                "From every point of a circle over this chord, B1 and B2 subtend the angle θ "
                "(inscribed angle); its radius is"
            )
        )
    )
    radius = chord / (TWO * sine(theta))
    step.find(w.length("R", radius.value / w.scale), radius, w.unit)
    aside = chord / (TWO * tangent(theta))
    up = c * cosine(half)
    above = d.centre.imag >= math.cos(d.swing_angle / 2)
    height = up + aside if above else up - aside
    step.note(w.translate(_("Its centre M lies on the y axis, at the height")))
    step.find(w.length("y", d.centre.imag * d.rocker_length, "M"), height, w.unit)


def _pivot(w: Writer, d: CrankRockerDerivation, lengths: tuple[Term, Term]) -> None:
    """The crank's pivot on the circle, and crank and coupler from its distances."""
    step = w.step(_("Choice of the crank's pivot"))
    limit = "" if math.isinf(d.link_ratio) else f"{d.link_ratio:.4g}"
    family = w.found.counts.get("family", 0)
    step.note(
        w.translate(
            _(
                "Frame and rocker are both given, so the crank's pivot lies where the circle about the "
                "rocker's pivot with the frame as radius meets this circle; {count} such points give a crank-rocker.",
                count=family,
            )
            if d.frame and d.rocker
            else _(
                "The crank's pivot O1 may lie anywhere on it where the linkage is a crank-rocker of one "
                "circuit: of {count} points examined, the one with the largest smallest transmission angle was "
                "taken, with the longest link at most {limit} times the shortest.",
                count=family,
                limit=limit,
            )
        )
    )
    place = d.pivot * d.rocker_length
    x, y = (step.give(w.length("x", place.real, "O1"), w.unit), step.give(w.length("y", place.imag, "O1"), w.unit))
    c, half = w.length("c", d.rocker_length), w.angle("ψ", d.swing_angle) / TWO
    step.note(w.translate(_("Its distances from B1 and B2 are the sum and the difference of coupler and crank:")))
    up, aside = c * cosine(half), c * sine(half)
    found = []
    for index, across in (("1", x - aside), ("2", x + aside)):
        distance = root(across.squared + (y - up).squared)
        found.append(step.find(w.length("l", distance.value / w.scale, index), distance, w.unit))
    low, high = sorted(found, key=lambda term: term.amount)
    a, b = lengths
    step.find(a, (high - low) / TWO, w.unit)
    step.find(b, (high + low) / TWO, w.unit)
    frame = root(x.squared + y.squared)
    step.find(w.length("d", abs(place)), frame, w.unit)


def _limits_again(w: Writer, sides: tuple[Term, Term, Term, Term]) -> None:
    """Swing angle and K from the lengths by the law of cosines."""
    a, b, c, d = sides
    step = w.step(_("Check with the lengths found"))
    step.note(
        w.translate(
            _(
                "The law of cosines with b + a and b − a gives the rocker's and the crank's angle in "
                "both limit positions; their differences are ψ and θ:"
            )
        )
    )
    for name, near in (("ψ", c), ("φ", None)):
        ends = []
        for index, far in (("1", b + a), ("2", b - a)):
            if near is None:
                ratio = (far.squared + d.squared - c.squared) / (TWO * far * d)
            else:
                ratio = (c.squared + d.squared - far.squared) / (TWO * c * d)
            angle = arccosine(ratio)
            ends.append(step.find(w.angle(name, math.radians(angle.value), index), angle, "°"))
        low, high = sorted(ends, key=lambda term: term.amount)
        if name == "ψ":
            step.find(w.angle("ψ", math.radians(high.amount - low.amount)), high - low, "°")
        else:
            theta = step.find(w.angle("θ", math.radians(high.amount - low.amount)), high - low, "°")
            again = (HALF_TURN + theta) / (HALF_TURN - theta)
            step.find(w.value("K", again.value), again, "")


def drag_link(w: Writer, d: DragLinkDerivation) -> None:
    """The driver's turn on the slow half turn of the follower, the lengths from both ends, and what was searched."""
    step = w.step(pgettext("synthesis_steps", "Given"))
    ratio = step.give(w.value("K", d.quick_return_ratio), "")
    frame = step.give(w.length("d", d.frame), w.unit)
    step = w.step(_("Both ends of the slow half turn"))
    step.note(
        w.translate(
            _("While the follower makes its slow half turn between the ends of the stroke, the driver turns by")
        )
    )
    beta = step.find(w.angle("β", d.slow_turn), TWO * HALF_TURN * ratio / (ONE + ratio), "°")
    step.note(
        w.translate(
            _(
                "Three numbers remain free: the follower's length and the angles of follower and "
                "driver at the beginning. Of all drag links of one circuit whose longest link is at "
                "most {ratio} times the shortest, the one with the largest smallest transmission "
                "angle was searched (on a grid that is refined about its best):",
                ratio=f"{d.link_ratio:g}",
            )
        )
    )
    c = step.give(w.length("c", abs(d.b - d.frame)), w.unit)
    psi = step.give(w.angle("ψ", d.follower_angle), "°")
    phi = step.give(w.angle("φ", d.driver_angle), "°")
    _drag_lengths(w, step, (frame, c, psi, phi, beta))
    examine(w, w.found.best)


def _drag_lengths(w: Writer, step: Step, terms: tuple[Term, ...]) -> None:
    frame, c, psi, phi, beta = terms
    a, b, _unused, _unused2 = four_bar_lengths(w, w.found.best)
    step.note(w.translate(_("The follower's pin at both ends (driver turned by 180°), from the driver's pivot:")))
    end = Pair(c * cosine(psi), c * sine(psi))
    found = []
    for index, x, y in (("1", frame + end.x, end.y), ("2", frame - end.x, -end.y)):
        place = (w.length("x", x.value / w.scale, index), w.length("y", y.value / w.scale, index))
        found.append(Pair(step.find(place[0], x, w.unit), step.find(place[1], y, w.unit)))
    first, second = found
    last = phi + beta
    along = first.x * cosine(phi) + first.y * sine(phi) - second.x * cosine(last) - second.y * sine(last)
    square = first.x.squared + first.y.squared - second.x.squared - second.y.squared
    step.note(
        w.translate(
            _(
                "The coupler has the same length at both ends; equating both gives the driver's "
                "length, and each end gives the coupler:"
            )
        )
    )
    above = step.find(w.value("q", square.value, "1"), square, f"{w.unit}²")
    below = step.find(w.length("q", along.value / w.scale, "2"), along, w.unit)
    step.find(a, above / (TWO * below), w.unit)
    for end, turned in ((first, phi), (second, last)):
        coupler = Pair(end.x - a * cosine(turned), end.y - a * sine(turned))
        step.find(b, root(coupler.x.squared + coupler.y.squared), w.unit)
