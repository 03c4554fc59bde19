"""Linkages whose coupler point draws a straight line: the classical proportions, measured, and Peaucellier's.

- Hoecken: frame 2, crank 1, coupler and rocker 2.5; P on A–B produced, A P = 5.
- Chebyshev: frame 2, crossed arms 2.5, coupler 1; P in its middle.
- Watt: arms and coupler 1, at right angles in the middle position, frame √5; P in the coupler's middle.
- Roberts: arms 1.2, frame 2, coupler 1; P the apex of the coupler's triangle with sides 1.2, on the frame's line.
- Peaucellier (exact): arms L, rhombus s, crank r = frame; P stays at (L² - s²)/(2 r) from the arms' pivot.

Source: Artobolevsky, Mechanisms in Modern Engineering Design, vol. 1; Norton, Design of Machinery, sec. 3.8.
"""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass, replace

import numpy as np

from linkwright.core.arrays import Complexes
from linkwright.synthesis.candidates import assess_four_bars, coupler_unit, four_bar_candidate, path_of_four_bar
from linkwright.synthesis.linkage import Linkage
from linkwright.synthesis.names import NOT_POSITIVE
from linkwright.synthesis.requirements.slider_crank import positive
from linkwright.synthesis.result import Candidate, Derivation, Synthesis, SynthesisError
from linkwright.words import _

SAMPLES = 361
#: Positions of the stretch that are shown.
SHOWN = 9


@dataclass(frozen=True)
class Proportions:
    """Lengths in any unit, the side of B (+1: left of A→O2), the coupler point and the searched input range, rad."""

    frame: float
    crank: float
    coupler: float
    output: float
    side: int
    point: complex
    span: tuple[float, float]


FOUR_BARS = {
    "hoecken": Proportions(2.0, 1.0, 2.5, 2.5, 1, 5.0 + 0j, (0.6, 2 * math.pi - 0.6)),
    "chebyshev": Proportions(2.0, 2.5, 1.0, 2.5, -1, 0.5 + 0j, (0.0, 1.8)),
    "watt": Proportions(math.sqrt(5.0), 1.0, 1.0, 1.0, 1, 0.5 + 0j, (-1.5, 1.5)),
    "roberts": Proportions(2.0, 1.2, 1.0, 1.2, 1, 0.5 - 1j * math.sqrt(1.19), (0.2, 2.2)),
}
KINDS = (*FOUR_BARS, "peaucellier")


@dataclass(frozen=True)
class StraightLineDerivation(Derivation):
    """Length of the stretch and deviation allowed (m), and how many linkages were compared."""

    length: float
    allowed: float
    compared: int


def straight_line(length: float, *, deviation: float | None = None, kind: str | None = None) -> Synthesis:
    """Straight-line linkages for a stretch of ``length`` (m) that stays within ``deviation`` (m) of its line.

    Of every kind the longest stretch that is straight enough is taken, so that the linkage is as small as can be;
    deviation: a thousandth of the length where it is not given. ``error``: the largest distance from the line, m.
    Ranked by size.

    Raises:
        SynthesisError: an unknown kind, or none is straight enough (``nearest``: the straightest found).
    """
    positive(length=length)
    if kind is not None and kind not in KINDS:
        raise SynthesisError(
            _(
                'there is no straight-line linkage "{kind}"; known: {known}',
                code="synthesize.straight_line.kind",
                kind=kind,
                known=tuple(KINDS),
            )
        )
    allowed = (0.001 * length if deviation is None else deviation) / length
    if not allowed > 0:
        raise SynthesisError(NOT_POSITIVE.format(name="deviation", value=f"{allowed * length:g}"))
    names = KINDS if kind is None else (kind,)
    good, within = _straight(names, length, allowed), allowed
    while not good:
        within *= 1.5
        good = _straight(names, length, within)
    derivation = StraightLineDerivation(length, allowed * length, len(names))
    result = Synthesis("straight_line", good, "deviation", extent=length, derivation=derivation)
    if within > allowed:
        allowed_text, smallest_error = f"{allowed * length:.4g}", f"{good[0].error:.4g}"
        raise SynthesisError(
            _(
                "{kind} has no segment that stays within {allowed} m; allow a larger deviation (the "
                "nearest solution has {minimum} m)",
                code="synthesize.straight_line.none",
                kind=str(kind),
                allowed=allowed_text,
                minimum=smallest_error,
            ),
            result,
        )
    return result


def _straight(names: tuple[str, ...], length: float, allowed: float) -> tuple[Candidate, ...]:
    """Those of the linkages that are straight enough, smallest first."""
    found = [_peaucellier(length) if name == "peaucellier" else _four_bar(name, length, allowed) for name in names]
    good = [each for each in found if each is not None]
    return tuple(sorted(good, key=lambda each: each.linkage.longest()))


def _four_bar(name: str, length: float, allowed: float) -> Candidate | None:
    shape = FOUR_BARS[name]
    theta = np.linspace(*shape.span, SAMPLES)
    a = shape.crank * np.exp(1j * theta)
    unit = coupler_unit(a, shape.coupler, shape.output, complex(shape.frame), shape.side)
    path = a + shape.point * unit
    first, last, off = longest_stretch(path, allowed)
    if last == first:
        return None
    scale = length / (path[last] - path[first])
    ends = [first, (first + last) // 2, last]
    pins, joints = a[ends] * scale, (a + shape.coupler * unit)[ends] * scale
    o2 = complex(shape.frame * scale)
    facts = assess_four_bars(np.array([0j]), pins[None], joints[None], np.array([o2]))
    curve = path_of_four_bar(0, pins[0], joints[0], o2, path[first] * scale)
    values = {"input_range [rad]": float(theta[last] - theta[first])}
    error = off * abs(scale)
    found = four_bar_candidate(
        0, pins, joints, o2, facts, 0, error, p=complex(path[first] * scale), worst=error, curve=curve, values=values
    )
    shown = np.linspace(first, last, SHOWN).round().astype(int)
    positions = {"A": a[shown] * scale, "B": (a + shape.coupler * unit)[shown] * scale, "P": path[shown] * scale}
    off_line = (positions["P"] - positions["P"][0]).imag
    return replace(found, linkage=replace(found.linkage, kind=name), positions=positions, deviations=off_line)


def longest_stretch(path: Complexes, allowed: float) -> tuple[int, int, float]:
    """Ends of the longest stretch that deviates at most ``allowed`` times its chord, and its deviation."""
    best, found = 0.0, (0, 0, 0.0)
    for first in range(len(path) - 2):
        chord = path[first + 2 :] - path[first]
        far = np.abs(chord)
        if not np.nanmax(far, initial=0.0) > best:
            continue
        unit = chord / np.where(far > 0, far, 1)
        off = np.abs(((path[first:][None] - path[first]) * unit.conj()[:, None]).imag)
        inside = np.tri(len(chord), len(path) - first, 2, dtype=bool)
        worst = np.where(inside, off, 0.0).max(1)
        good = np.where((worst <= allowed * far) & np.isfinite(far), far, 0.0)
        last = int(good.argmax())
        if good[last] > best:
            best, found = float(good[last]), (first, first + 2 + last, float(worst[last]))
    return found


def _peaucellier(length: float) -> Candidate:
    """Arms 2.5, rhombus 1.2, crank 1, in units that give a travel of ``length`` between ±40° of the crank."""
    half = math.radians(40)
    arm, side, crank = 2.5, 1.2, 1.0
    power = arm**2 - side**2
    scale = length / (power / crank * math.tan(half / 2))
    pin = crank + cmath.rect(crank, half)
    across = 1j * pin / abs(pin)
    middle = pin / abs(pin) * (abs(pin) + power / abs(pin)) / 2
    height = math.sqrt(arm**2 - abs(middle) ** 2)
    points = {"O1": crank + 0j, "O2": 0j, "A": pin, "B": middle + height * across, "C": middle - height * across}
    points["P"] = pin / abs(pin) ** 2 * power
    linkage = Linkage(
        "peaucellier",
        {name: scale * place for name, place in points.items()},
        ("O1", "O2"),
        {
            "crank": ("O1", "A"),
            "upper_arm": ("O2", "B"),
            "lower_arm": ("O2", "C"),
            "side_1": ("A", "B"),
            "side_2": ("A", "C"),
            "side_3": ("B", "P"),
            "side_4": ("C", "P"),
        },
        ("crank", "O1"),
        span=(-half, half),
    )
    turn = np.linspace(-half, half, 91)
    pins = crank + crank * np.exp(1j * turn)
    curve = scale * power * pins / np.abs(pins) ** 2
    sine = math.sin(math.acos((side**2 + arm**2 - abs(pin) ** 2) / (2 * side * arm)))
    values = {"input_range [rad]": 2 * half}
    shown = np.linspace(0, len(turn) - 1, SHOWN).round().astype(int)
    positions = {"A": scale * pins[shown], "P": curve[shown]}
    return Candidate(
        linkage,
        0.0,
        "peaucellier",
        (),
        False,
        math.asin(sine),
        arm / crank,
        curve=curve,
        values=values,
        positions=positions,
        deviations=(curve[shown] - curve[0]).real,
    )
