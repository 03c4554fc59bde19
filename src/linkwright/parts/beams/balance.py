"""Equations of equilibrium of a beam and polynomials as they are written on a line."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from linkwright.core.arrays import Floats
from linkwright.core.table import ROUNDING
from linkwright.equations.steps import Step
from linkwright.parts.base import signed
from linkwright.parts.beams.elastic import DistributedLoad, Point, SupportCondition


def balance_laws(
    step: Step,
    supports: Mapping[str, SupportCondition],
    length: float,
    points: Sequence[Point],
    spreads: Sequence[DistributedLoad],
) -> None:
    """ΣF = 0 and ΣM = 0 about the first support, the reactions as unknowns."""
    own = supports.items()
    about = next(iter(supports.values())).x
    bearing = [(name, each) for name, each in own if each.deflection or not each.slope]
    forces = [(1.0, f"{name}.F") for name, _ in bearing]
    moments = [(each.x - about, f"{name}.F") for name, each in bearing if abs(each.x - about) > ROUNDING * length]
    moments += [(1.0, f"{name}.M") for name, each in own if each.slope or each.torsional_stiffness]
    known = [p.force for p in points] + [(s.first + s.last) / 2 * (s.end - s.start) for s in spreads]
    turning = [p.couple + p.force * (p.x - about) for p in points]
    turning += [line_moment(s) - about * (s.first + s.last) / 2 * (s.end - s.start) for s in spreads]
    for name, unknown, parts in (("ΣF", forces, known), ("ΣM", moments, turning)):
        left = " ".join(
            f"{'+' if c > 0 else '−'} {'' if abs(c) == 1.0 else f'{abs(c):.6g}·'}{each}" for c, each in unknown
        ).removeprefix("+ ")
        rest = signed(parts)
        rest = "" if rest == "0" else f" − {rest[1:]}" if rest[0] == "−" else f" + {rest}"
        if left:
            step.law(f"{name} = {left}{rest} = 0")


def polynomial_text(coefficients: Sequence[float] | Floats, largest: float, length: float) -> str:
    """A polynomial in ξ, terms that are nothing but rounding left out."""
    text = ""
    for power, c in enumerate(coefficients):
        if abs(c) * length**power <= 1e-12 * largest or c == 0.0:
            continue
        mark = (" − " if c < 0 else " + ") if text else ("−" if c < 0 else "")
        unknown = "" if power == 0 else "·ξ" if power == 1 else f"·ξ{'²³⁴⁵'[power - 2]}"
        text += f"{mark}{abs(c):.6g}{unknown}"
    return text or "0"


def line_moment(spread: DistributedLoad) -> float:
    """Moment of a line load about x = 0."""
    a, b = spread.start, spread.end
    rate = (spread.last - spread.first) / (b - a)
    return (spread.first - rate * a) * (b * b - a * a) / 2 + rate * (b**3 - a**3) / 3


def rounded(parts: Sequence[float]) -> float:
    total = math.fsum(parts)
    return 0.0 if abs(total) < 1e-9 * max((abs(p) for p in parts), default=0.0) else total
