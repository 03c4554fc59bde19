"""Steps of crank-rockers and drag links, which follow from the limit positions of their output."""

from __future__ import annotations

import math

from linkwright.equations.steps import Step
from linkwright.equations.terms import ONE, TWO, Pair, Term, arccosine, cosine, root, sine, tangent
from linkwright.synthesis.requirements.crank_rocker import CrankRockerDerivation
from linkwright.synthesis.requirements.drag_link import DragLinkDerivation
from linkwright.synthesis.steps.closed_forms import HALF_TURN, extreme_position_angle
from linkwright.synthesis.steps.writing import Writer, examine, four_bar_lengths
from linkwright.words import _, pgettext


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
    step.say(
        w.say(
            _(
                "The limit positions B1 and B2 of the rocker pin lie symmetrically about the y axis, "
                "the rocker's pivot at the origin; their chord is"
            )
        )
    )
    half = swing / TWO
    chord = step.find(w.length("s", 2 * d.rocker_length * math.sin(d.swing_angle / 2)), TWO * c * sine(half), w.unit)
    if d.centre is None:
        step.say(
            w.say(
                _(
                    "With K = 1 the angle θ is zero: crank and coupler have the same direction in both "
                    "limit positions, and the crank's pivot lies on the line B1 B2."
                )
            )
        )
        return
    step.say(
        w.say(
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
    step.say(w.say(_("Its centre M lies on the y axis, at the height")))
    step.find(w.length("y", d.centre.imag * d.rocker_length, "M"), height, w.unit)


def _pivot(w: Writer, d: CrankRockerDerivation, lengths: tuple[Term, Term]) -> None:
    """The crank's pivot on the circle, and crank and coupler from its distances."""
    step = w.step(_("Choice of the crank's pivot"))
    limit = "" if math.isinf(d.link_ratio) else f"{d.link_ratio:.4g}"
    family = w.found.counts.get("family", 0)
    step.say(
        w.say(
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
    step.say(w.say(_("Its distances from B1 and B2 are the sum and the difference of coupler and crank:")))
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
    step.say(
        w.say(
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
    step.say(
        w.say(_("While the follower makes its slow half turn between the ends of the stroke, the driver turns by"))
    )
    beta = step.find(w.angle("β", d.slow_turn), TWO * HALF_TURN * ratio / (ONE + ratio), "°")
    step.say(
        w.say(
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
    step.say(w.say(_("The follower's pin at both ends (driver turned by 180°), from the driver's pivot:")))
    end = Pair(c * cosine(psi), c * sine(psi))
    found = []
    for index, x, y in (("1", frame + end.x, end.y), ("2", frame - end.x, -end.y)):
        place = (w.length("x", x.value / w.scale, index), w.length("y", y.value / w.scale, index))
        found.append(Pair(step.find(place[0], x, w.unit), step.find(place[1], y, w.unit)))
    first, second = found
    last = phi + beta
    along = first.x * cosine(phi) + first.y * sine(phi) - second.x * cosine(last) - second.y * sine(last)
    square = first.x.squared + first.y.squared - second.x.squared - second.y.squared
    step.say(
        w.say(
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
