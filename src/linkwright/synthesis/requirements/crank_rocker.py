"""Crank-rockers from swing angle and quick-return ratio; quick-return mechanisms with a swinging block.

In the rocker's limit positions B₁, B₂ crank and coupler lie in one line: |O1 B₁| = b + a, |O1 B₂| = b - a, and the
angle between them is θ = π (K - 1)/(K + 1). So O1 lies on the circle from which B₁B₂ subtends θ: a family of one
number, from which the one with the largest smallest transmission angle is taken.
Sources: Alt 1932 (Totlagenkonstruktion); Brodell and Soni 1970, J. Mechanisms 5; VDI 2130.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from linkwright.core.arrays import Complexes, Flags
from linkwright.core.quantity import number
from linkwright.synthesis.candidates import Assessment, assess_four_bars, four_bar_candidate
from linkwright.synthesis.linkage import Guide, Linkage
from linkwright.synthesis.names import LINK_RATIO_UNMET, ONLY_WITH
from linkwright.synthesis.requirements.slider_crank import angle_between_limits, not_negative, positive
from linkwright.synthesis.result import Candidate, Derivation, Synthesis, SynthesisError, require_integers
from linkwright.words import _

SAMPLES = 20_001
#: A rocker swings less than half a turn.
LARGEST_SWING = math.pi
#: Longest over shortest link, where nothing else is demanded and the family has it.
USUAL_RATIO = 5.0
#: How far below its border the nearest quick-return angle lies.
BELOW = 2e-3
#: Quick-return ratios of the nearest slotted levers, where a demand lies beyond what they can have.
MIN_RATIO, MAX_RATIO = 1.05, 1000.0


@dataclass(frozen=True)
class CrankRockerDerivation(Derivation):
    """A crank-rocker's demands (0: not given), θ (rad), the rocker's length (m), and in units of the rocker, whose
    pivot lies at 0 and whose limit positions are symmetric about the y axis: the crank's pivot and the centre of the
    circle on which it lies (None for θ = 0). ``link_ratio``: the limit that was held."""

    swing_angle: float
    quick_return_ratio: float
    frame: float
    rocker: float
    theta: float
    rocker_length: float
    pivot: complex
    centre: complex | None
    link_ratio: float


@dataclass(frozen=True)
class QuickReturnDerivation(Derivation):
    """A slotted lever's demands, θ = its swing (rad), crank and arm (m); with a stroke the guide's distance from the
    lever's pivot and the rod (m)."""

    quick_return_ratio: float
    frame: float
    theta: float
    crank: float
    arm: float
    stroke: float
    height: float
    rod: float


def crank_rocker(
    swing_angle: float,
    quick_return_ratio: float,
    frame: float = 0.0,
    *,
    rocker: float = 0.0,
    link_ratio: float | None = None,
    count: int = 3,
) -> Synthesis:
    """The crank-rockers of a swing angle (rad), quick-return ratio K and length of the frame or the rocker (m).

    The first has the best smallest transmission angle of those whose longest link is at most ``link_ratio`` times the
    shortest (without that limit the best may lie at infinity); the others stand evenly over the family. Where it is
    not given the ratio is 5 if the family has that, else the smallest that it has. With both lengths they are the few
    of the family that have them, and a ``link_ratio`` that is given.

    Raises:
        SynthesisError: no crank-rocker has this swing and K (0 < ψ < π, K ≥ 1); ``nearest``: those of the largest
            K that the swing allows; or none has both lengths; ``nearest``: those of the frame alone; or none has the
            ``link_ratio``; ``nearest``: that of the smallest ratio.
    """
    require_integers(count=count)
    positive(swing_angle=swing_angle, **({} if link_ratio is None else {"link_ratio": link_ratio}))
    not_negative(frame=frame, rocker=rocker)
    if not frame and not rocker:
        raise SynthesisError(
            _(
                "a crank-rocker needs the length of its frame or of its rocker; give frame: 300 mm or rocker: 200 mm",
                code="synthesize.crank_rocker.length",
            )
        )
    theta = angle_between_limits(quick_return_ratio)
    pivots, limits = _family(swing_angle, theta)
    both = bool(frame and rocker)
    if both and swing_angle < LARGEST_SWING and _good(swing_angle, theta).any():
        chosen = _at_distance(swing_angle, theta, frame / rocker)
        if not len(chosen) or not _right(chosen, limits, swing_angle, theta).any():
            raise _not_both(swing_angle, quick_return_ratio, frame, rocker)
        pivots = chosen
    facts, pins = _assess(pivots, limits)
    lengths = np.abs(pivots)
    good = (facts.kind == 0) & _limit_positions_right(pivots, pins, swing_angle, theta)
    if swing_angle >= LARGEST_SWING or not good.any():
        raise _none(swing_angle, quick_return_ratio, frame or rocker, count)
    smallest_ratio = float(facts.ratio[good].min())
    usual = math.inf if both else USUAL_RATIO
    within = good & (facts.ratio <= (usual if link_ratio is None else link_ratio * (1 + 1e-12)))
    if not within.any() and link_ratio is not None:
        nearest = crank_rocker(
            swing_angle, quick_return_ratio, frame, rocker=rocker, link_ratio=smallest_ratio, count=1
        )
        raise SynthesisError(
            LINK_RATIO_UNMET.format(value=f"{link_ratio:g}", minimum=f"{math.ceil(1e3 * smallest_ratio) / 1e3:g}"),
            nearest,
        )
    notes = (
        ()
        if within.any()
        else (
            _(
                "no member of the family has its longest link within five times its shortest; the "
                "smallest ratio is {minimum}",
                code="synthesize.link_ratio",
                minimum=f"{smallest_ratio:.4g}",
            ),
        )
    )
    limit = usual if link_ratio is None else link_ratio
    if not within.any():
        limit = 1.05 * smallest_ratio
        within = good & (facts.ratio <= limit)
    score = np.where(within, facts.transmission, -1.0)
    best = int(score.argmax())
    usable = np.flatnonzero(within & (score > 0.5 * score[best]))
    evenly = np.linspace(0, len(usable) - 1, count + 1).astype(int)[1:-1]
    others = np.flatnonzero(within) if both else usable[evenly]
    found = []
    for i in [best, *(int(each) for each in others if each != best)][:count]:
        scale = rocker or frame / lengths[i]
        turn = scale * np.exp(-1j * np.angle(-pivots[i]))
        o1, o2 = 0j, -pivots[i] * turn
        a, b = (pins[0][i] - pivots[i]) * turn, (pins[1][i] - pivots[i]) * turn
        values = {"swing_angle [rad]": swing_angle, "quick_return_ratio": quick_return_ratio}
        found.append(four_bar_candidate(o1, a, b, complex(o2), facts, i, 0.0, values=values))
    derivation = CrankRockerDerivation(
        swing_angle,
        quick_return_ratio,
        frame,
        rocker,
        theta,
        rocker or frame / float(lengths[best]),
        complex(pivots[best]),
        _circle_centre(complex(pivots[best]), swing_angle, theta),
        limit,
    )
    return Synthesis(
        "crank_rocker", tuple(found), counts={"family": int(good.sum())}, notes=notes, derivation=derivation
    )


def _none(swing: float, k: float, frame: float, count: int) -> SynthesisError:
    """The refusal with the crank-rockers of the swing (or the largest that goes) and the largest K it allows.

    θ stays below π/2 + ψ/2: there the crank's pivot comes to lie on the rocker's circle.
    """
    possible = min(swing, 0.99 * LARGEST_SWING)
    border = (math.pi + possible) / 2
    theta = min((1 - BELOW) * border, angle_between_limits(k))
    while not _good(possible, theta).any():
        theta *= 1 - BELOW
    near = _ratio(theta)
    nearest = crank_rocker(possible, near, frame, count=count)
    rule = (
        _(
            "no crank-rocker has the swing angle {swing} deg with K = {k}; the swing must be below "
            "180 deg (the nearest solution swings {near_swing} deg with K = {near})",
            code="synthesize.crank_rocker.range",
        )
        if possible < swing
        else _(
            "no crank-rocker has the swing angle {swing} deg and K = {k} on one circuit; with this "
            "swing K stays below {most} (the nearest solution has K = {near})",
            code="synthesize.crank_rocker.none",
        )
    )
    values = {"swing": f"{math.degrees(swing):g}", "k": f"{k:g}", "most": f"{_ratio(border):.5g}"}
    message = rule.format(near_swing=number(possible, "angle", 5), near=f"{near:.5g}", **values)
    return SynthesisError(message, nearest)


def _ratio(theta: float) -> float:
    return (math.pi + theta) / (math.pi - theta)


def _not_both(swing: float, k: float, frame: float, rocker: float) -> SynthesisError:
    """The refusal of a frame and a rocker, with the nearest rocker that the frame may have."""
    theta = angle_between_limits(k)
    rockers = frame / np.abs(_family(swing, theta)[0][_good(swing, theta)])
    near = float(rockers[np.abs(rockers - rocker).argmin()])
    message = {"frame": number(frame, "length"), "rocker": number(rocker, "length"), "near": number(near, "length")}
    return SynthesisError(
        _(
            "with this swing angle and K a frame of {frame} mm has no rocker of {rocker} mm; the "
            "nearest solution has one of {near} mm",
            code="synthesize.crank_rocker.both",
            **message,
        ),
        crank_rocker(swing, k, frame, rocker=near),
    )


def _good(swing: float, theta: float) -> Flags:
    """Which of the family are crank-rockers of one circuit with the swing and θ."""
    return _right(*_family(swing, theta), swing, theta)


def _right(pivots: Complexes, limits: Complexes, swing: float, theta: float) -> Flags:
    """Which crank pivots give crank-rockers of one circuit with the swing and θ."""
    facts, pins = _assess(pivots, limits)
    return np.asarray((facts.kind == 0) & _limit_positions_right(pivots, pins, swing, theta))


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


def _circle_centre(pivot: complex, swing: float, theta: float) -> complex | None:
    """Centre of the circle through both limit positions from whose points they subtend θ, on the pivot's
    side."""
    if theta == 0:
        return None
    height, half = math.cos(swing / 2), math.sin(swing / 2)
    both = [1j * (height + s * half / math.tan(theta)) for s in (1, -1)]
    return min(both, key=lambda centre: abs(abs(pivot - centre) - half / math.sin(theta)))


def _at_distance(swing: float, theta: float, distance: float) -> Complexes:
    """The crank pivots of the family at a distance from the rocker's pivot, where two circles meet; not their mirror
    images."""
    height, half = math.cos(swing / 2), math.sin(swing / 2)
    if theta == 0:
        return np.array([1j * height + math.sqrt(distance**2 - height**2)] if distance > height else [], complex)
    found = []
    for sign in (1, -1):
        centre, radius = height + sign * half / math.tan(theta), half / math.sin(theta)
        up = (distance**2 + centre**2 - radius**2) / (2 * centre) if centre else math.inf
        if abs(up) < distance:
            aside = math.sqrt(distance**2 - up**2)
            found.append(aside + 1j * up)
    return np.array(found, complex)


def _assess(pivots: Complexes, limits: Complexes) -> tuple[Assessment, tuple[Complexes, Complexes]]:
    """Facts of the family in its first limit position, and positions (N, 1) of A and B there."""
    far, near = np.abs(pivots - limits[0]), np.abs(pivots - limits[1])
    far_end = np.where(far >= near, limits[0], limits[1])
    crank = 0.5 * np.abs(far - near)
    a = pivots + crank * (far_end - pivots) / np.maximum(np.abs(far_end - pivots), 1e-300)
    pins = (a[:, None], far_end[:, None])
    with np.errstate(invalid="ignore", divide="ignore"):
        return assess_four_bars(pivots, *pins, np.zeros(len(pivots), complex)), pins


def _limit_positions_right(pivots: Complexes, pins: tuple[Complexes, Complexes], swing: float, theta: float) -> Flags:
    """Whether the four-bar of one circuit has the swing and θ: its own limit positions, from its lengths."""
    a, d = np.abs(pins[0][:, 0] - pivots), np.abs(pivots)
    b, c = np.abs(pins[1][:, 0] - pins[0][:, 0]), 1.0
    with np.errstate(invalid="ignore", divide="ignore"):
        ends, sides = (
            [np.arccos(np.clip((near * near + d * d - far * far) / (2 * near * d), -1, 1)) for near, far in pairs]
            for pairs in (((c, b + a), (c, b - a)), ((b + a, c), (b - a, c)))
        )
    right_swing = np.abs(np.abs(ends[0] - ends[1]) - swing) < 1e-9
    return np.asarray(right_swing & (np.abs(np.abs(sides[0] - sides[1]) - theta) < 1e-9) & (a > 1e-9))


def quick_return(quick_return_ratio: float, frame: float, *, stroke: float = 0.0, rod: float = 0.0) -> Synthesis:
    """A crank with a slotted lever (RPR): crank r = d sin(θ/2), the lever swings θ = π (K - 1)/(K + 1).

    With a ``stroke`` (m) the lever's arm is H / (2 sin(θ/2)), and a ram on a guide across the lever's middle position
    follows it by a rod (default: half the arm or more); the guide halves the sagitta s of the arm's end, which makes
    the largest pressure angle smallest. A rod shorter than s / (2 cos(θ/2)) would turn the ram back before the lever.
    ``frame``: distance of the pivots, m.

    Raises:
        SynthesisError: K ≤ 1, or so large that the crank is as long as the frame; a rod that is too short, or without
            a stroke.
    """
    positive(frame=frame)
    not_negative(stroke=stroke, rod=rod)
    if rod and not stroke:
        raise SynthesisError(ONLY_WITH.format(demand="rod", needs="stroke"))
    theta = angle_between_limits(quick_return_ratio)
    if theta <= 0:
        near = quick_return(MIN_RATIO, frame, stroke=stroke)
        raise SynthesisError(
            _(
                "a crank with a slotted lever has K > 1; ask for a larger quick-return ratio (the "
                "nearest solution has {near})",
                code="synthesize.quick_return.one",
                near=f"{MIN_RATIO:g}",
            ),
            near,
        )
    if math.cos(theta / 2) < 1e-6:
        near = quick_return(MAX_RATIO, frame, stroke=stroke)
        raise SynthesisError(
            _(
                "K = {value} asks for a crank as long as its distance from the lever's pivot; ask for a "
                "smaller quick-return ratio (the nearest solution has {near})",
                code="synthesize.quick_return.most",
                value=f"{quick_return_ratio:g}",
                near=f"{MAX_RATIO:g}",
            ),
            near,
        )
    crank = frame * math.sin(theta / 2)
    points = {"O1": 0j, "O3": -1j * frame, "A": complex(crank)}
    lever = (complex(crank) + 1j * frame) / abs(complex(crank) + 1j * frame)
    links: dict[str, tuple[str, ...]] = {"crank": ("O1", "A"), "die": ("A",), "lever": ("O3", "E")}
    guides = {"slot": Guide("lever", "O3", ("O3", "E"), "die", "A")}
    assembly = {"slot": "forward"}
    arm = stroke / (2 * math.sin(theta / 2)) if stroke else frame + 1.2 * crank
    points["E"] = -1j * frame + arm * lever
    height = 0.0
    if stroke:
        height = arm * (1 + math.cos(theta / 2)) / 2
        sink = points["E"].imag + frame - height
        shortest = (arm - height) / math.cos(theta / 2)
        length = rod or max(arm / 2, 1.1 * shortest)
        if length < shortest * (1 - 1e-9):
            near = quick_return(quick_return_ratio, frame, stroke=stroke, rod=shortest)
            raise SynthesisError(
                _(
                    "the rod is too short: the ram would turn back before the lever does; give {minimum} m or "
                    "more (the nearest solution has that)",
                    code="synthesize.quick_return.rod",
                    minimum=f"{shortest:.6g}",
                ),
                near,
            )
        points["F"] = complex(points["E"].real + math.sqrt(length**2 - sink**2), height - frame)
        links |= {"link": ("E", "F"), "ram": ("F",)}
        guides["guide"] = Guide("frame", "O3", 0.0, "ram", "F", height)
        assembly["F"] = "forward"
    linkage = Linkage("quick_return", points, ("O1", "O3"), links, ("crank", "O1"), guides=guides, assembly=assembly)
    values = {"crank [m]": crank, "swing_angle [rad]": theta, "quick_return_ratio": quick_return_ratio}
    if stroke:
        values |= {"arm [m]": arm, "stroke [m]": stroke}
    transmission = math.pi / 2
    if stroke:
        length = abs(points["F"] - points["E"])
        transmission = math.acos(arm * (1 - math.cos(theta / 2)) / 2 / length)
    ratio = max(frame, arm) / min(crank, arm)
    each = Candidate(linkage, 0.0, "crank_slotted_lever", (), True, transmission, ratio, values=values)
    derivation = QuickReturnDerivation(
        quick_return_ratio,
        frame,
        theta,
        crank,
        arm,
        stroke,
        height,
        abs(points["F"] - points["E"]) if stroke else 0.0,
    )
    return Synthesis("quick_return", (each,), derivation=derivation)
