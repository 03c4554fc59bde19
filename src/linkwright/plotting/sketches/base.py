"""What sketches have in common: paper on which symbols and labels are put, and the registry of kinds."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TypeVar

import numpy as np
from numpy.typing import ArrayLike

from linkwright.errors import require_language
from linkwright.parts.base import Problem
from linkwright.pictures.drawing import Drawing, Sketch
from linkwright.pictures.picture import Vec
from linkwright.pictures.symbols.base import placed, points, vec
from linkwright.registry import Registry
from linkwright.words import _

#: Room that a drawing takes, across and down.
WIDE, HIGH = 560.0, 380.0
DrawnBy = Callable[[Problem, str], Drawing]
SKETCHES: Registry[DrawnBy] = Registry(_("sketch"), "linkwright.plotting.sketches")
_Drawn = TypeVar("_Drawn", bound=Callable[..., Drawing])


def sketched(*kinds: str) -> Callable[[_Drawn], _Drawn]:
    """Decorator that registers a function of problem and language as the sketch of kinds of calculations."""

    def registered(draw: _Drawn) -> _Drawn:
        for kind in kinds:
            SKETCHES.register(kind)(draw)
        return draw

    return registered


def sketch(problem: Problem, language: str = "en") -> Drawing | None:
    """The sketch of a calculation, None where its kind has none; raises LinkwrightError where it cannot be drawn."""
    require_language(language)
    kind = problem.kind
    return SKETCHES[kind](problem, language) if kind in SKETCHES else None


def scale_of(places: Iterable[ArrayLike], wide: float = WIDE, high: float = HIGH) -> float:
    """Pixels per metre with which places (n, 2) fill the room; 1 where all are one place."""
    span = np.ptp(np.vstack([points(each) for each in places]), axis=0)
    factors = [room / size for room, size in zip((wide, high), span, strict=True) if size > 0]
    return min(factors, default=1.0)


def roller_support(paper: Sketch, at: Vec, toward: Vec = (0.0, 1.0), size: float = 18.0) -> None:
    """A triangle on rollers, which holds across the ground alone; the ground lies in the direction ``toward``."""
    half, radius = 0.62 * size, 3.4
    paper.line(placed([(0, 0), (size, -half), (size, half)], at, toward), "lw-support", closed=True)
    for y in (-0.55 * half, 0.55 * half):
        paper.circle(vec(placed([(size + radius, y)], at, toward)[0]), radius, "lw-pin")
    paper.put("wall", at=vec(placed([(size + 2 * radius, 0)], at, toward)[0]), toward=toward, size=0.9 * size)
