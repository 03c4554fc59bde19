"""Slider-cranks from their stroke and what else is demanded: closed forms.

With crank r, rod l, offset e the slider's limit positions are B₁ = √((l + r)² - e²) and B₂ = √((l - r)² - e²) from
the foot of the crank's pivot, the stroke H = B₁ - B₂; the crank's directions there enclose θ = π (K - 1)/(K + 1).
The crank turns fully where r + e ≤ l. The smallest transmission angle is cos μ = (r + e)/l.
Sources: Volmer, Getriebetechnik; Norton, Design of Machinery, ch. 3 and 4.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from linkwright.core.arguments import real
from linkwright.core.quantity import number
from linkwright.synthesis.candidates import assess_slider_cranks, candidate, slider_crank
from linkwright.synthesis.names import NOT_POSITIVE, TOO_ROUNDED, TRANSMISSION_RANGE
from linkwright.synthesis.result import Derivation, Synthesis, SynthesisError
from linkwright.words import _

ROUND = 1e-12


@dataclass(frozen=True)
class SliderCrankDerivation(Derivation):
    """A slider-crank's demands (m, rad), its crank and rod (m), and whether they come from ``ratios``,
    ``quick_return`` or ``transmission``."""

    way: str
    stroke: float
    crank: float
    rod: float
    offset: float
    rod_ratio: float = 0.0
    offset_ratio: float = 0.0
    quick_return_ratio: float = 0.0
    transmission_angle: float = 0.0
    rounded: tuple[float, float, float] | None = None


def rounded_slider_crank(found: Synthesis, rounding: float) -> Synthesis:
    """The slider-crank with its lengths rounded to multiples of a length (m); ``error``: what its stroke is off.

    Raises:
        SynthesisError: a length vanishes, or the crank does not turn any more; ``nearest``: without rounding.
    """
    positive(rounding=rounding)
    derivation = found.derivation
    assert isinstance(derivation, SliderCrankDerivation)
    lengths = derivation.crank, derivation.rod, derivation.offset
    crank, rod, offset = (multiple(each, rounding) for each in lengths)
    if not crank or crank + offset > rod:
        raise SynthesisError(TOO_ROUNDED.format(value=f"{1e3 * rounding:g}"), found)
    return _result(replace(derivation, rounded=(crank, rod, offset)))


def multiple(length: float, rounding: float) -> float:
    """The nearest multiple of a length."""
    return rounding * round(length / rounding)


def slider_crank_from_ratios(stroke: float, rod_ratio: float, offset_ratio: float = 0.0) -> Synthesis:
    """The slider-crank of a stroke (m) with λ = l/r and ε = e/r.

    H = r [√((λ + 1)² - ε²) - √((λ - 1)² - ε²)].

    Raises:
        SynthesisError: λ < 1 + ε, so that the crank cannot turn; the nearest has λ = 1 + ε.
    """
    positive(stroke=stroke, rod_ratio=rod_ratio)
    not_negative(offset_ratio=offset_ratio)
    if rod_ratio < 1 + offset_ratio - ROUND or rod_ratio <= 1:
        minimum = max(1 + offset_ratio, 1.001)
        nearest = slider_crank_from_ratios(stroke, minimum, offset_ratio)
        raise SynthesisError(
            _(
                "rod ratio λ = {value} is too small for the crank to turn; it needs λ ≥ 1 + ε = {minimum} "
                "(the nearest solution has that)",
                code="synthesize.slider_crank.ratio",
                value=f"{rod_ratio:g}",
                minimum=f"{1 + offset_ratio:g}",
            ),
            nearest,
        )
    inner = max((rod_ratio - 1) ** 2 - offset_ratio**2, 0.0)
    crank = stroke / (math.sqrt((rod_ratio + 1) ** 2 - offset_ratio**2) - math.sqrt(inner))
    return _result(
        SliderCrankDerivation(
            "ratios",
            stroke,
            crank,
            rod_ratio * crank,
            offset_ratio * crank,
            rod_ratio=rod_ratio,
            offset_ratio=offset_ratio,
        )
    )


def slider_crank_from_quick_return(stroke: float, quick_return_ratio: float, offset: float) -> Synthesis:
    """The slider-crank of a stroke and offset (m) with the quick-return ratio K.

    In the triangle O B₁ B₂ with the sides l + r and l - r, the angle θ between them and the side H at distance e:
    l² - r² = e H / sin θ, l² + r² = H²/2 + e H / tan θ. The offset is at most H / tan θ: there l - r = e.

    Raises:
        SynthesisError: K and offset contradict each other; the nearest has the largest K (or offset) that goes.
    """
    positive(stroke=stroke, offset=offset)
    theta = angle_between_limits(quick_return_ratio)
    angle = math.atan2(stroke, offset)
    largest = (math.pi + angle) / (math.pi - angle)
    if theta <= 0:
        near = min(1.02, largest)
        nearest = slider_crank_from_quick_return(stroke, near, offset)
        raise SynthesisError(
            _(
                "a slider-crank with offset has K > 1, and K = {value} is demanded; give offset 0 with a "
                "rod ratio or a transmission angle, or a larger K (the nearest solution has K = {near}; "
                "a longer rod comes nearer)",
                code="synthesize.slider_crank.no_quick_return",
                value=f"{quick_return_ratio:g}",
                near=f"{near:.6g}",
            ),
            nearest,
        )
    if theta >= math.pi / 2 or offset > stroke / math.tan(theta) * (1 + ROUND):
        nearest = slider_crank_from_quick_return(stroke, largest, offset)
        raise SynthesisError(
            _(
                "stroke and offset allow no quick-return ratio {value}; at most K = {most} (the nearest "
                "solution has that)",
                code="synthesize.slider_crank.quick_return",
                value=f"{quick_return_ratio:g}",
                most=f"{largest:.6g}",
            ),
            nearest,
        )
    difference = offset * stroke / math.sin(theta)
    total = stroke**2 / 2 + offset * stroke / math.tan(theta)
    crank, rod = math.sqrt((total - difference) / 2), math.sqrt((total + difference) / 2)
    return _result(
        SliderCrankDerivation("quick_return", stroke, crank, rod, offset, quick_return_ratio=quick_return_ratio)
    )


def slider_crank_from_transmission(stroke: float, transmission_angle: float, offset: float = 0.0) -> Synthesis:
    """The slider-crank of a stroke and offset (m) whose transmission angle never falls below the given one (rad).

    l = (r + e)/cos μ; r from the stroke, in closed form for e = 0 (r = H/2), else by bisection: the stroke grows
    with r.

    Raises:
        SynthesisError: the angle is not between 0 and π/2.
    """
    positive(stroke=stroke)
    not_negative(offset=offset)
    if not 0 < transmission_angle < math.pi / 2:
        raise SynthesisError(TRANSMISSION_RANGE.format(value=number(transmission_angle, "angle")))
    slope = math.cos(transmission_angle)

    def excess(crank: float) -> float:
        rod = (crank + offset) / slope
        inner = max((rod - crank) ** 2 - offset**2, 0.0)
        return math.sqrt((rod + crank) ** 2 - offset**2) - math.sqrt(inner) - stroke

    low, high = 0.0, stroke / 2
    for _unused in range(200):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if excess(middle) < 0 else (low, middle)
    crank = high if offset else stroke / 2
    rod = (crank + offset) / slope
    return _result(
        SliderCrankDerivation("transmission", stroke, crank, rod, offset, transmission_angle=transmission_angle)
    )


def angle_between_limits(quick_return_ratio: float) -> float:
    """θ = π (K - 1)/(K + 1), rad; raises SynthesisError for K < 1 and infinite K."""
    positive(quick_return_ratio=quick_return_ratio)
    if not quick_return_ratio >= 1:
        raise SynthesisError(
            _(
                "the quick-return ratio {value} is below 1; it is slow time over fast time, 1 or more; "
                "with the crank turning the other way it is {inverse}",
                code="synthesize.quick_return_below_one",
                value=f"{quick_return_ratio:g}",
                inverse=f"{1 / quick_return_ratio:.6g}",
            )
        )
    return math.pi * ((quick_return_ratio - 1) / (quick_return_ratio + 1))


def positive(**values: float) -> None:
    """Raises SynthesisError for a value that is not positive and finite."""
    for name, value in values.items():
        if not 0 < real(name, value, finite=False) < math.inf:
            raise SynthesisError(NOT_POSITIVE.format(name=name, value=f"{value:g}"))


def not_negative(**values: float) -> None:
    """Raises SynthesisError for a value that is negative or not finite."""
    for name, value in values.items():
        if not 0 <= real(name, value, finite=False) < math.inf:
            raise SynthesisError(
                _(
                    "{name} is {value}; it must not be negative",
                    code="synthesize.negative",
                    name=name,
                    value=f"{value:g}",
                )
            )


def _result(derivation: SliderCrankDerivation) -> Synthesis:
    crank, rod, offset = derivation.rounded or (derivation.crank, derivation.rod, derivation.offset)
    reach, near_squared = math.sqrt((rod + crank) ** 2 - offset**2), max((rod - crank) ** 2 - offset**2, 0.0)
    tip = complex(reach, offset)
    pin = crank * tip / abs(tip)
    linkage = slider_crank(0, pin, tip, 1)
    a, b, o1 = np.array([[pin]]), np.array([[tip]]), np.array([0j])
    facts = assess_slider_cranks(o1, a, b, np.array([1 + 0j]), np.array([offset]))
    theta = abs(math.atan2(offset, math.sqrt(near_squared)) - math.atan2(offset, reach))
    values = {
        "crank [m]": crank,
        "rod [m]": rod,
        "offset [m]": offset,
        "stroke [m]": reach - math.sqrt(near_squared),
        "quick_return_ratio": (math.pi + theta) / (math.pi - theta),
    }
    turn = np.linspace(0, 2 * np.pi, 181)
    height = crank * np.sin(turn) - offset
    slide = crank * np.cos(turn) + np.sqrt(np.maximum(rod**2 - height**2, 0))
    curve = np.stack([turn, slide])
    error = abs(values["stroke [m]"] - derivation.stroke) if derivation.rounded else 0.0
    found = candidate(linkage, facts, 0, error, worst=error, curve=curve, values=values)
    name = "deviation" if derivation.rounded else "none"
    return Synthesis("slider_crank", (found,), name, derivation=derivation)
