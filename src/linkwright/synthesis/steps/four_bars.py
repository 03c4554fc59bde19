"""What a four-bar is examined by: Grashof's condition, transmission angle, branch and order at its positions."""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np

from linkwright.core.arrays import Complexes, Floats
from linkwright.equations.steps import Step
from linkwright.equations.terms import TWO, Term, arccosine
from linkwright.synthesis.names import TYPE_NAMES
from linkwright.synthesis.result import Candidate
from linkwright.synthesis.steps.writing import Writer, decimals, degrees, numbers
from linkwright.words import _


def four_bar_lengths(w: Writer, each: Candidate) -> tuple[Term, Term, Term, Term]:
    """Symbols of input, coupler, output and frame of a four-bar: a, b, c, d."""
    points = each.linkage.points
    ends = (("O1", "A"), ("A", "B"), ("O2", "B"), ("O1", "O2"))
    a, b, c, d = (
        w.length(name, abs(points[last] - points[first])) for name, (first, last) in zip("abcd", ends, strict=True)
    )
    return a, b, c, d


def examine(w: Writer, each: Candidate) -> None:
    """The step that examines a four-bar: Grashof, transmission angle, and the branch at its positions."""
    step = w.step(_("Grashof's condition, transmission angle and branch"))
    sides = four_bar_lengths(w, each)
    grashof(w, step, sides, each)
    if each.turns:
        transmission(w, step, sides)
    else:
        angle = f"{math.degrees(each.transmission_angle):.2f}"
        step.say(
            w.say(
                _(
                    "The input does not turn fully; between its first and its last position the "
                    "transmission angle never falls below {angle}°.",
                    angle=angle,
                )
            )
        )
    if len(each.positions.get("A", ())) > 1:
        branches(w, step, each)


def grashof(w: Writer, step: Step, sides: tuple[Term, ...], each: Candidate) -> None:
    """Sum of the shortest and the longest link against that of the others."""
    low, *middle, high = sorted(sides, key=lambda term: term.amount)
    step.say(w.say(_("Shortest and longest link, and the other two (a input, b coupler, c output, d frame):")))
    for index, (first, second) in enumerate(((low, high), tuple(middle)), 1):
        total = first + second
        step.find(w.length("S", total.value / w.scale, str(index)), total, w.unit)
    gap = low.amount + high.amount - middle[0].amount - middle[1].amount
    kind = TYPE_NAMES[each.grashof_type]
    if abs(gap) <= 1e-12 * high.amount:
        step.say(w.say(_("Both sums are equal: the linkage has a change point.")))
    elif gap < 0:
        step.say(
            w.say(
                _(
                    "The first sum is smaller, and {shortest} is the shortest link: a {kind}.",
                    kind=kind,
                    shortest=low.plain,
                )
            )
        )
    else:
        step.say(w.say(_("The first sum is larger, so no link turns fully: a {kind}.", kind=kind)))


def transmission(w: Writer, step: Step, sides: tuple[Term, ...]) -> None:
    """Transmission angles where the input lies along the frame: the smallest is one of them."""
    a, b, c, d = sides
    step.say(w.say(_("The angle between coupler and output is extreme where the input lies along the frame:")))
    for index, diagonal in (("1", d - a), ("2", d + a)):
        cosine = (b.squared + c.squared - diagonal.squared) / (TWO * b * c)
        step.find(w.angle("μ", math.acos(max(-1.0, min(1.0, cosine.value))), index), arccosine(cosine), "°")
    found = [item.value for item in step.equations[-2:]]
    smallest = min(min(angle, 180.0 - angle) for angle in found)
    step.say(w.say(_("Smallest transmission angle: {angle}°.", angle=f"{smallest:.2f}")))


def signed_transmission(each: Candidate) -> Floats:
    """Angle from the coupler B→A to the output B→O2 at every position, rad, its sign that of the branch."""
    a, b, o2 = each.positions["A"], each.positions["B"], each.linkage.points["O2"]
    return np.asarray(np.angle((o2 - b) / (a - b)))


def _one_way(angle: Floats) -> Floats:
    """Angles without jumps, in the direction in which they come within one turn where there is one, rad."""
    for sign in (1.0, -1.0):
        steps = np.mod(sign * np.diff(angle) + 1e-9, 2 * np.pi) - 1e-9
        if steps.sum() < 2 * np.pi:
            return np.asarray(angle[0] + sign * np.append(0.0, np.cumsum(steps)))
    return np.unwrap(angle)


def branches(w: Writer, step: Step, each: Candidate) -> None:
    """Input angle, transmission angle with its sign, and the lengths again at every position."""
    points, a = each.linkage.points, each.positions["A"]
    if "B" not in each.positions or "O2" not in points or each.linkage.guides:
        return
    o1, o2, b = points["O1"], points["O2"], each.positions["B"]
    turned = np.degrees(_one_way(np.angle(a - o1)))
    step.say(
        w.say(
            _(
                "Input angle θ and transmission angle μ with the sign of its side; the link lengths "
                "from the coordinates:"
            )
        )
    )
    columns = [
        (w.say(_("position")), numbers(len(a))),
        ("θ / °", decimals(turned, 4)),
        ("μ / °", degrees(signed_transmission(each))),
        (w.over("|O1A|"), w.lengths(np.abs(a - o1))),
        (w.over("|AB|"), w.lengths(np.abs(b - a))),
        (w.over("|O2B|"), w.lengths(np.abs(b - o2))),
    ]
    w.table(step, _("Transmission angle with its sign, and link lengths in every position"), columns)
    step.say(
        w.say(
            _("μ keeps its sign and θ runs one way: all positions lie on one branch, in their order.")
            if not each.defects
            else _("The positions do not lie on one branch in their order: see the defects of the candidates.")
        )
    )


def coordinates(w: Writer, each: Candidate, names: Iterable[str]) -> list[tuple[str, list[str]]]:
    """Columns with the coordinates of moving points at every position."""
    columns = []
    for name in names:
        places: Complexes = each.positions[name]
        columns += [(w.over(f"x_{name}"), w.lengths(places.real)), (w.over(f"y_{name}"), w.lengths(places.imag))]
    return columns
