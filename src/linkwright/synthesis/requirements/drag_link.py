"""Drag links (double cranks) from their quick-return ratio.

The follower's half turn between the two ends of a slider's stroke takes the driver 2π/(1 + K) on one side. With the
follower at ψ and ψ + π, C₁ = d + c e^{iψ}, C₂ = d - c e^{iψ}, and the driver at φ and φ + β, β = 2π K/(1 + K),

    a = (|C₁|² - |C₂|²) / (2 Re(e^{-iφ} (C₁ - e^{-iβ} C₂))),  b = |a e^{iφ} - C₁|

follow from c/d, ψ and φ; of the movable ones the one with the largest smallest transmission angle is taken, from a
grid refined around its best.
Source: the condition is the law of cosines at both ends; the aim is Tsai's (1983, J. Mechanisms, Transmissions 105).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from linkwright.core.arrays import Complexes, Floats
from linkwright.synthesis.candidates import TYPES, Assessment, assess_four_bars, four_bar_candidate
from linkwright.synthesis.requirements.slider_crank import angle_between_limits, positive
from linkwright.synthesis.result import Derivation, Synthesis, SynthesisError
from linkwright.words import _

GRID, ROUNDS, BEST = 60_000, 40, 60
DOUBLE = TYPES.index("double_crank")


@dataclass(frozen=True)
class DragLinkDerivation(Derivation):
    """A drag link's demands, the driver's turn β during the slow half turn, the follower's and driver's angle ψ and φ
    at its beginning (rad), and the pins at its beginning and end (m, O1 at 0, O2 on the x axis)."""

    quick_return_ratio: float
    frame: float
    link_ratio: float
    slow_turn: float
    follower_angle: float
    driver_angle: float
    a: complex
    a_end: complex
    b: complex
    b_end: complex


def drag_link(quick_return_ratio: float, frame: float, *, link_ratio: float = 5.0) -> Synthesis:
    """The drag link of a quick-return ratio K and frame length (m) with the best transmission angle.

    ``link_ratio``: the longest link is at most so many times the shortest.

    Raises:
        SynthesisError: K < 1, or no drag link found with this K (``nearest``: the one of the largest K that was
            found with these links, or of the smallest ratio of links with this K where K = 1 asks for more).
    """
    positive(frame=frame, link_ratio=link_ratio)
    theta = angle_between_limits(quick_return_ratio)
    best, value = _best(theta, link_ratio)
    if value <= 0:
        raise _none(quick_return_ratio, frame, link_ratio)
    facts, _ = _score(best[None], math.pi + theta, link_ratio)
    o1, a, b, o2 = (each * frame for each in _places(best[None], math.pi + theta))
    values = {"quick_return_ratio": quick_return_ratio, "follower_angle [rad]": float(best[1])}
    each = four_bar_candidate(complex(o1[0]), a[0], b[0], complex(o2[0]), facts, 0, 0.0, values=values)
    derivation = DragLinkDerivation(
        quick_return_ratio,
        frame,
        link_ratio,
        math.pi + theta,
        float(best[1]),
        float(best[2]),
        complex(a[0, 0]),
        complex(a[0, 1]),
        complex(b[0, 0]),
        complex(b[0, 1]),
    )
    return Synthesis("drag_link", (each,), derivation=derivation)


def _none(quick_return_ratio: float, frame: float, link_ratio: float) -> SynthesisError:
    """The refusal with the largest K that these links reach, or K = 1 with the smallest ratio of links."""
    low, high = 1.0, quick_return_ratio
    if _best(0.0, link_ratio)[1] <= 0:
        wider = link_ratio
        while _best(0.0, wider)[1] <= 0:
            wider *= 1.2
        values = {"ratio": f"{link_ratio:g}", "minimum": f"{wider:.4g}"}
        return SynthesisError(
            _(
                "no drag link was found whose longest link is at most {ratio} times its shortest; allow "
                "{minimum} (the nearest solution has that, with K = 1)",
                code="synthesize.drag_link.links",
                **values,
            ),
            drag_link(1.0, frame, link_ratio=wider),
        )
    while high / low > 1.005:
        middle = math.sqrt(low * high)
        reached = _best(angle_between_limits(middle), link_ratio)[1] > 0
        low, high = (middle, high) if reached else (low, middle)
    nearest = drag_link(low, frame, link_ratio=link_ratio)
    return SynthesisError(
        _(
            "no drag link was found with K = {k} and the demanded ratio of links; at most K = {most} "
            "was reached (the nearest solution has that): lower K or allow a larger link_ratio",
            code="synthesize.drag_link.none",
            k=f"{quick_return_ratio:g}",
            most=f"{low:.4g}",
        ),
        nearest,
    )


def _best(theta: float, link_ratio: float) -> tuple[Floats, float]:
    """The free numbers with the largest minimum transmission angle, and that angle; -1 where none moves."""
    rng = np.random.default_rng(0)
    longest = math.log(min(max(link_ratio, 1.0), 12.0))
    low, high = np.zeros(3), np.array([longest, 2 * math.pi, 2 * math.pi])
    x = rng.uniform(low, high, (GRID, 3))
    width = (high - low) / 8
    best, value = x[0], -1.0
    for _unused in range(ROUNDS):
        _, score = _score(x, math.pi + theta, link_ratio)
        order = np.argsort(-score)[:BEST]
        if score[order[0]] > value:
            best, value = x[order[0]], float(score[order[0]])
        x = np.concatenate([best[None], x[order].repeat(12, 0) + rng.normal(0, 1, (12 * len(order), 3)) * width])
        width = width * 0.6
    return best, value


def _places(x: Floats, beta: float) -> tuple[Complexes, Complexes, Complexes, Complexes]:
    """O1, A and B at both ends of the stroke (N, 2), O2; frame 1 along x."""
    c, psi, phi = np.exp(x[:, 0]), x[:, 1], x[:, 2]
    end = c * np.exp(1j * psi)
    first, second = 1 + end, 1 - end
    with np.errstate(divide="ignore", invalid="ignore"):
        crank = (np.abs(first) ** 2 - np.abs(second) ** 2) / (
            2 * (np.exp(-1j * phi) * (first - np.exp(-1j * beta) * second)).real
        )
    crank = np.where(np.isfinite(crank) & (crank > 0) & (crank < 50), crank, 1e-3)
    pins = crank[:, None] * np.exp(1j * (phi[:, None] + np.array([0.0, beta])))
    zero = np.zeros(len(x), complex)
    return zero, pins, np.stack([first, second], 1), zero + 1


def _score(x: Floats, beta: float, link_ratio: float) -> tuple[Assessment, Floats]:
    """Facts, and the smallest transmission angle where the linkage is a drag link of one circuit, else -1."""
    o1, a, b, o2 = _places(x, beta)
    facts = assess_four_bars(o1, a, b, o2)
    good = (facts.kind == DOUBLE) & ~facts.circuit & (facts.ratio <= link_ratio)
    return facts, np.where(good, facts.transmission, -1.0)
