"""Crank-rockers from swing angle and quick-return ratio; quick-return mechanisms with a swinging block.

In the rocker's limit positions B₁, B₂ crank and coupler lie in one line: |O1 B₁| = b + a, |O1 B₂| = b - a, and the
angle between them is θ = π (K - 1)/(K + 1). So O1 lies on the circle from which B₁B₂ is seen under θ: a family of one
number, from which the one with the largest smallest transmission angle is taken.
Sources: Alt 1932 (Totlagenkonstruktion); Brodell and Soni 1970, J. Mechanisms 5; VDI 2130.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from linkwright.synthesis.assessment import Assessment, assess_four_bars
from linkwright.synthesis.build import four_bar_candidate
from linkwright.synthesis.demands import whole
from linkwright.synthesis.linkage import Guide, Linkage
from linkwright.synthesis.requirements.slider_crank import angle_between_limits, not_negative, positive
from linkwright.synthesis.result import Candidate, Synthesis, note, refuse

Complexes = NDArray[np.complex128]
Floats = NDArray[np.float64]
SAMPLES = 20_001


def crank_rocker(
    swing_angle: float, quick_return_ratio: float, frame: float, *, link_ratio: float = 5.0, count: int = 3
) -> Synthesis:
    """The crank-rockers of a swing angle (rad), quick-return ratio K and frame length (m).

    The first has the best smallest transmission angle of those whose longest link is at most ``link_ratio`` times the
    shortest (without that limit the best may lie at infinity); the others stand evenly over the family.

    Raises:
        SynthesisError: no crank-rocker has this swing and K (0 < ψ < π, 1 ≤ K < 3).
    """
    whole(count=count)
    positive(swing_angle=swing_angle, frame=frame)
    theta = angle_between_limits(quick_return_ratio)
    if not swing_angle < math.pi or not theta < math.pi / 2:
        raise refuse(
            "crank_rocker.range", swing=f"{math.degrees(swing_angle):g}", k=f"{quick_return_ratio:g}"
        )
    pivots, limits = _family(swing_angle, theta)
    facts, pins = _assess(pivots, limits)
    lengths = np.abs(pivots)
    wanted = _limit_positions_right(pivots, pins, swing_angle, theta)
    good = (facts.kind == 0) & wanted
    if not good.any():
        raise refuse("crank_rocker.none", swing=f"{math.degrees(swing_angle):g}", k=f"{quick_return_ratio:g}")
    within = good & (facts.ratio <= link_ratio)
    notes = () if within.any() else (note("link_ratio", least=f"{facts.ratio[good].min():.4g}"),)
    if not within.any():
        within = good & (facts.ratio <= 1.05 * facts.ratio[good].min())
    score = np.where(within, facts.transmission, -1.0)
    best = int(score.argmax())
    usable = np.flatnonzero(within & (score > 0.5 * score[best]))
    others = usable[np.linspace(0, len(usable) - 1, count + 1).astype(int)[1:-1]] if count > 1 else []
    found = []
    for i in [best, *(int(each) for each in others if each != best)]:
        scale = frame / lengths[i]
        turn = scale * np.exp(-1j * np.angle(-pivots[i]))
        o1, o2 = 0j, -pivots[i] * turn
        a, b = (pins[0][i] - pivots[i]) * turn, (pins[1][i] - pivots[i]) * turn
        values = {"swing_angle [rad]": swing_angle, "quick_return_ratio": quick_return_ratio}
        found.append(four_bar_candidate(o1, a, b, complex(o2), facts, i, 0.0, values=values))
    return Synthesis("crank_rocker", tuple(found), counts={"family": int(good.sum())}, notes=notes)


def _family(swing: float, theta: float) -> tuple[Complexes, Complexes]:
    """Crank pivots on the circle, the rocker's pivot at 0, and the rocker's unit limit positions B₁, B₂."""
    limits = np.exp(1j * np.array([math.pi / 2 - swing / 2, math.pi / 2 + swing / 2]))
    chord = abs(limits[0] - limits[1])
    middle = limits.mean()
    if theta == 0:
        along = np.geomspace(1e-3, 1e3, SAMPLES)
        pivots = middle + (chord / 2 + chord * along)
    else:
        radius = chord / (2 * math.sin(theta))
        around = np.linspace(0, 2 * np.pi, SAMPLES)[:-1]
        both = [middle + s * 1j * radius * math.cos(theta) + radius * np.exp(1j * around) for s in (1, -1)]
        pivots = np.concatenate(both)
    return np.asarray(pivots), limits


def _assess(pivots: Complexes, limits: Complexes) -> tuple[Assessment, tuple[Complexes, Complexes]]:
    """Facts of the family in its first limit position, and positions (N, 1) of A and B there."""
    far, near = np.abs(pivots - limits[0]), np.abs(pivots - limits[1])
    far_end = np.where(far >= near, limits[0], limits[1])
    crank = 0.5 * np.abs(far - near)
    a = pivots + crank * (far_end - pivots) / np.maximum(np.abs(far_end - pivots), 1e-300)
    pins = (a[:, None], far_end[:, None])
    with np.errstate(invalid="ignore", divide="ignore"):
        return assess_four_bars(pivots, *pins, np.zeros(len(pivots), complex)), pins


def _limit_positions_right(
    pivots: Complexes, pins: tuple[Complexes, Complexes], swing: float, theta: float
) -> NDArray[np.bool_]:
    """Whether the four-bar of one circuit has the swing and θ: its own limit positions, from its lengths."""
    a, d = np.abs(pins[0][:, 0] - pivots), np.abs(pivots)
    b, c = np.abs(pins[1][:, 0] - pins[0][:, 0]), 1.0
    ends = [np.arccos(np.clip((c * c + d * d - reach**2) / (2 * c * d), -1, 1)) for reach in (b + a, b - a)]
    sides = [
        np.arccos(np.clip((reach**2 + d * d - c * c) / (2 * reach * d), -1, 1)) for reach in (b + a, b - a)
    ]
    right_swing = np.abs(np.abs(ends[0] - ends[1]) - swing) < 1e-9
    return np.asarray(right_swing & (np.abs(np.abs(sides[0] - sides[1]) - theta) < 1e-9) & (a > 1e-9))


def quick_return(
    quick_return_ratio: float, frame: float, *, stroke: float = 0.0, rod: float = 0.0
) -> Synthesis:
    """A crank with a slotted lever (RPR): crank r = d sin(θ/2), the lever swings θ = π (K - 1)/(K + 1).

    With a ``stroke`` (m) the lever's arm is H / (2 sin(θ/2)), and a ram on a guide across the lever's middle position
    follows it by a rod (default: half the arm or more); the guide halves the sagitta s of the arm's end, which makes
    the largest pressure angle smallest. A rod shorter than s / (2 cos(θ/2)) would turn the ram back before the lever.
    ``frame``: distance of the pivots, m.

    Raises:
        SynthesisError: K ≤ 1, or so large that the crank is as long as the frame; a rod that is too short.
    """
    positive(frame=frame)
    not_negative(stroke=stroke, rod=rod)
    theta = angle_between_limits(quick_return_ratio)
    if theta <= 0:
        raise refuse("quick_return.one")
    if math.cos(theta / 2) < 1e-6:
        raise refuse("quick_return.most", given=f"{quick_return_ratio:g}")
    crank = frame * math.sin(theta / 2)
    points = {"O1": 0j, "O3": -1j * frame, "A": complex(crank)}
    lever = (complex(crank) + 1j * frame) / abs(complex(crank) + 1j * frame)
    links: dict[str, tuple[str, ...]] = {"crank": ("O1", "A"), "die": ("A",), "lever": ("O3", "E")}
    guides = {"slot": Guide("lever", "O3", ("O3", "E"), "die", "A")}
    assembly = {"slot": "forward"}
    arm = stroke / (2 * math.sin(theta / 2)) if stroke else frame + 1.2 * crank
    points["E"] = -1j * frame + arm * lever
    if stroke:
        height = arm * (1 + math.cos(theta / 2)) / 2
        sink = points["E"].imag + frame - height
        least = (arm - height) / math.cos(theta / 2)
        length = rod or max(arm / 2, 1.1 * least)
        if length < least * (1 - 1e-9):
            raise refuse("quick_return.rod", least=f"{least:.6g}")
        points["F"] = complex(points["E"].real + math.sqrt(length**2 - sink**2), height - frame)
        links |= {"link": ("E", "F"), "ram": ("F",)}
        guides["guide"] = Guide("frame", "O3", 0.0, "ram", "F", height)
        assembly["F"] = "forward"
    linkage = Linkage(
        "quick_return", points, ("O1", "O3"), links, ("crank", "O1"), guides=guides, assembly=assembly
    )
    values = {"crank [m]": crank, "swing_angle [rad]": theta, "quick_return_ratio": quick_return_ratio}
    if stroke:
        values |= {"arm [m]": arm, "stroke [m]": stroke}
    transmission = math.pi / 2
    if stroke:
        length = abs(points["F"] - points["E"])
        transmission = math.acos(arm * (1 - math.cos(theta / 2)) / 2 / length)
    ratio = max(frame, arm) / min(crank, arm)
    each = Candidate(linkage, 0.0, "crank_slotted_lever", (), True, transmission, ratio, values=values)
    return Synthesis("quick_return", (each,))
