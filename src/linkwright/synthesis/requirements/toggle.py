"""Toggle linkages from the ratio of output to input force.

Two links of length l, the angle α of each to the slider's line; a force F on the knee across the line gives the
slider P = F / (2 tan α) (principle of virtual work). With the ratio n = P/F wanted at the distance s before the
dead point: tan α = 1/(2 n), s = 2 l (1 - cos α), and over a stroke H the angle begins at cos α₀ = cos α - (H -
s)/(2 l). Source: Niemann, Maschinenelemente; any textbook's virtual work of the toggle.
"""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass

import numpy as np

from linkwright.synthesis.candidates import slider_crank
from linkwright.synthesis.requirements.slider_crank import positive
from linkwright.synthesis.result import Candidate, Derivation, Synthesis, SynthesisError
from linkwright.words import _


@dataclass(frozen=True)
class ToggleDerivation(Derivation):
    """A toggle's demands (m), the angle α at which it has the force ratio (rad), the links' length (m) and the angle
    at the beginning of the stroke (rad)."""

    force_ratio: float
    distance: float
    stroke: float
    alpha: float
    link: float
    first_angle: float


def toggle(force_ratio: float, distance: float, stroke: float) -> Synthesis:
    """The toggle whose force ratio P/F is reached at a ``distance`` (m) before the dead point, over a ``stroke`` (m).

    The knee is turned by its first link; the input's span goes from the beginning of the stroke to the dead point.

    Raises:
        SynthesisError: the stroke is not longer than the distance, or longer than the links allow.
    """
    positive(force_ratio=force_ratio, distance=distance, stroke=stroke)
    if stroke < distance:
        nearest = toggle(force_ratio, distance, distance)
        raise SynthesisError(
            _(
                "the stroke {stroke} m is shorter than the distance {distance} m at which the force "
                "ratio is wanted (the nearest solution has a stroke of that distance)",
                code="synthesize.toggle.stroke",
                stroke=f"{stroke:g}",
                distance=f"{distance:g}",
            ),
            nearest,
        )
    alpha = math.atan(1 / (2 * force_ratio))
    length = distance / (4 * math.sin(alpha / 2) ** 2)
    begin = 1 - stroke / (2 * length)
    if begin <= 0:
        longest = 2 * length
        raise SynthesisError(
            _(
                "the force ratio at that distance gives links for a stroke of at most {most} m; the "
                "nearest solution has a stroke just below it",
                code="synthesize.toggle.too_long",
                most=f"{longest:.6g}",
            ),
            toggle(force_ratio, distance, 0.95 * longest),
        )
    first = 2 * math.asin(math.sqrt(stroke / (4 * length)))
    knee = cmath.rect(length, first)
    linkage = slider_crank(0, knee, complex(2 * length * begin), 1, span=(0.002 * first, first), turns=False)
    angle = np.linspace(first, alpha / 4, 181)
    curve = np.stack([2 * length * np.cos(angle), 1 / (2 * np.tan(angle))])
    values = {"link [m]": length, "angle [rad]": alpha, "first_angle [rad]": first, "force_ratio": force_ratio}
    transmission = math.pi / 2 - first
    found = Candidate(linkage, 0.0, "toggle", (), False, transmission, 1.0, curve=curve, values=values)
    derivation = ToggleDerivation(force_ratio, distance, stroke, alpha, length, first)
    return Synthesis("toggle", (found,), derivation=derivation)
