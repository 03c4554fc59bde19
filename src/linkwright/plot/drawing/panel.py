"""Small curves under a moving drawing, with a cursor that runs with it."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.dataclass import dataclass
from linkwright.core.outputs import Output
from linkwright.core.quantity import significant
from linkwright.pictures.drawing import Box
from linkwright.pictures.picture import Line, SvgNode, Text, name_runs
from linkwright.pictures.svg.element import Element, element
from linkwright.pictures.svg.text import width
from linkwright.pictures.symbols.base import points
from linkwright.plot.diagrams.axes import unit_of
from linkwright.words import has, say

HEIGHT, GAP, SIZE = 78.0, 26.0, 12.0


@dataclass(frozen=True)
class Panel:
    """Curves in rows under a box: still elements, extent, and the cursor's places."""

    elements: tuple[SvgNode, ...]
    extent: Floats
    left: float
    width: float
    top: float
    bottom: float

    def cursor_x(self, share: float) -> float:
        """Where the cursor stands after a share of the motion."""
        return self.left + share * self.width

    def cursor(self, x: float = 0.0) -> Element:
        """The cursor at x."""
        return element(
            "line", {"class": "lw-input-line", "x1": x, "x2": x, "y1": self.top, "y2": self.bottom}
        )


def panel(
    results: Mapping[Output, Floats],
    box: Box,
    language: str,
    *,
    alone: bool,
    ends: Callable[[Output], tuple[float, float]],
) -> Panel:
    """Rows of curves under the box; ``alone``: whether there
    is one driver; ``ends``: smallest and largest value of a result."""
    left, span = box[0], max(box[2] - box[0], 260.0)
    y = box[3] + GAP
    elements: list[SvgNode] = []
    right = left + span
    for output, values in results.items():
        text = _caption(output, values, ends(output), language, alone=alone)
        elements += _row(text, values, left, span, y)
        right = max(right, left + 4.0 + width(text, SIZE))
        y += HEIGHT + GAP
    extent = points([(left, box[3] + GAP - 1.4 * SIZE), (right, y - GAP + SIZE)])
    return Panel(tuple(elements), extent, left, span, box[3] + GAP, y - GAP)


def _caption(output: Output, values: Floats, ends: tuple[float, float], language: str, *, alone: bool) -> str:
    """The quantity with its unit, and its ends."""
    said = output.sentence(alone=alone).say(language) if has(f"quantity.{output.kind}") else output.column
    unit = unit_of(output.dimension, [values])
    low, high = (significant(end * unit.factor) for end in ends)
    return say("drawing.curve", language, quantity=unit.label(said), low=low, high=high)


def _row(text: str, values: Floats, left: float, span: float, top: float) -> list[SvgNode]:
    low, high = float(np.nanmin(values)), float(np.nanmax(values))
    reach = (high - low) or 1.0
    x = left + span * np.arange(len(values)) / max(len(values) - 1, 1)
    curve = np.stack([x, top + HEIGHT * (0.96 - 0.9 * (values - low) / reach)], axis=1)
    frame = points([(left, top), (left, top + HEIGHT), (left + span, top + HEIGHT)])
    elements: list[SvgNode] = [Line(frame, "lw-axis"), Line(curve, "lw-trace")]
    if low < 0 < high:
        zero = top + HEIGHT * (0.96 - 0.9 * (0.0 - low) / reach)
        elements.append(Line(points([(left, zero), (left + span, zero)]), "lw-leader"))
    elements.append(Text((left + 4.0, top - 4.0), name_runs(text), "lw-value", SIZE))
    return elements
