"""Dimension lines of links and between points."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from linkwright.errors import RequestError
from linkwright.kinematics.names import find_point
from linkwright.plot.drawing.labels import Label, Obstacles
from linkwright.plot.drawing.machine import Machine
from linkwright.plot.svg.element import Floats
from linkwright.plot.symbols.base import SYMBOLS, Shape, Vec, placed

Dimension = str | tuple[str, str]
_OFFSETS = (24.0, -24.0, 40.0, -40.0, 58.0, -58.0)


@dataclass(frozen=True)
class Dimensioned:
    """A dimension line and its label."""

    shape: Shape
    label: Label


def dimension_lines(
    machine: Machine, wanted: Iterable[Dimension], index: int, ink: list[Floats]
) -> list[Dimensioned]:
    """Dimension lines on the side where they cross least of what is drawn.

    ``wanted``: a link with a length (``crank``), or two points (``("O1", "O3")``).
    """
    found: list[Dimensioned] = []
    for each in wanted:
        (a, b), value = _ends(machine, each, index)
        shapes = [(SYMBOLS["dimension_line"](start=a, end=b, offset=offset), offset) for offset in _OFFSETS]
        taken = Obstacles.of([*ink, *(line for one in found for line in one.shape.ink)])
        shape, offset = min(shapes, key=lambda pair: _crossing(pair[0], taken) + 0.3 * abs(pair[1]))
        found.append(
            Dimensioned(shape, Label(length_text(value), _middle(a, b, offset), "lw-value", 12.0, 5.0))
        )
    return found


def length_text(metres: float) -> str:
    """``1.25 m`` from one metre upwards, ``60.5 mm`` below."""
    return f"{metres:.6g} m" if float(f"{metres:.6g}") >= 1.0 else f"{1000 * metres:.6g} mm"


def _ends(machine: Machine, wanted: Dimension, index: int) -> tuple[tuple[Vec, Vec], float]:
    mechanism = machine.motion.mechanism
    if isinstance(wanted, str):
        names = list(mechanism.link(wanted.removesuffix(".length")).points)[:2]
        if len(names) < 2:
            raise RequestError(f'link "{wanted}" has one point, so it has no length; name two points instead')
        pair = [(wanted.removesuffix(".length"), name) for name in names]
    else:
        pair = [find_point(mechanism, name) for name in wanted]
    a, b = (machine.paper(*each, index) for each in pair)
    return (a, b), float(np.hypot(b[0] - a[0], b[1] - a[1])) / machine.view.scale


def _crossing(shape: Shape, taken: Obstacles) -> float:
    """Ink near points along a dimension line."""
    if not shape.ink:
        return 0.0
    line = shape.ink[0]
    share = np.linspace(0.0, 1.0, 15)[:, None]
    dots = line[0] + share * (line[-1] - line[0])
    return float(taken.under(np.hstack([dots - 4.0, dots + 4.0])).sum())


def _middle(a: Vec, b: Vec, offset: float) -> tuple[Vec, ...]:
    length = float(np.hypot(b[0] - a[0], b[1] - a[1])) or 1.0
    along = ((b[0] - a[0]) / length, (b[1] - a[1]) / length)
    shares: Sequence[float] = (0.5, 0.4, 0.6, 0.3, 0.7)
    rows = placed([(share * length, offset) for share in shares], a, along)
    return tuple((float(x), float(y)) for x, y in rows)
