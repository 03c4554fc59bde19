"""Animated elements in the language of SMIL, and small curves with a cursor that runs with the drawing."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.outputs import QUANTITIES, Output
from linkwright.core.quantity import significant
from linkwright.pictures.drawing import Box
from linkwright.pictures.picture import Line, SvgNode, Text, name_runs
from linkwright.pictures.svg import Element, coordinates, element, group, number, width
from linkwright.pictures.symbols.arrows import arrow_points
from linkwright.pictures.symbols.base import SYMBOLS, points
from linkwright.plotting.diagrams.axes import unit_of
from linkwright.plotting.drawing.scene import Scene
from linkwright.plotting.drawing.vectors import Torques, Vectors
from linkwright.words import _


def animate_element(attribute: str, values: Sequence[str], seconds: float) -> Element:
    """An ``animate`` element that runs for ever."""
    return element("animate", {"attributeName": attribute, **_timing(values, seconds)})


def shifted(shifts: Floats, seconds: float, content: Sequence[SvgNode]) -> Element:
    """A group whose shift (n, 2) is animated; without animation it is at the first."""
    if np.ptp(shifts, axis=0).max() < 0.005:
        return group(content, transform=shift_text(shifts[0]))
    return group([_shifting(shifts, seconds), *content], transform=shift_text(shifts[0]))


def shift_text(shift: Floats) -> str:
    """A shift as the text of a ``transform`` attribute."""
    return f"translate({number(float(shift[0]))} {number(float(shift[1]))})"


def _shifting(shifts: Floats, seconds: float) -> Element:
    values = [f"{number(x)} {number(y)}" for x, y in shifts.tolist()]
    kind = {"attributeName": "transform", "type": "translate"}
    return element("animateTransform", {**kind, **_timing(values, seconds)})


def _turning(degrees: Floats, seconds: float) -> Element:
    values = [number(each) for each in degrees.tolist()]
    kind = {"attributeName": "transform", "type": "rotate", "additive": "sum"}
    return element("animateTransform", {**kind, **_timing(values, seconds)})


def moving_links(scene: Scene, frames: Sequence[int], seconds: float) -> list[SvgNode]:
    """The machine with every link moving over the frames."""
    found: list[SvgNode] = []
    for layer, link, parts in scene.layered():
        shapes = [each for part in parts for each in part.shape.elements]
        if link == "frame":
            found.append(group(shapes, f"lw-{layer}"))
            continue
        placed = scene.machine.placed[link]
        origin = scene.machine.view.paper(placed.origin[list(frames)])
        way = placed.direction[list(frames)]
        turn = -np.degrees(np.unwrap(np.arctan2(way[:, 1], way[:, 0])))
        if np.ptp(turn) > 0.005:
            still = f"{shift_text(origin[0])} rotate({number(float(turn[0]))})"
            moves = [_shifting(origin, seconds), _turning(turn, seconds)]
            found.append(group([*moves, *shapes], f"lw-{layer}", transform=still))
        else:
            turned = group(shapes, f"lw-{layer}", transform=f"rotate({number(float(turn[0]))})")
            found.append(shifted(origin, seconds, [turned]))
    return found


def moving_vectors(
    scene: Scene, family: Vectors, scale: float, frames: Sequence[int], seconds: float
) -> list[SvgNode]:
    """Arrows that follow their points and change with the motion."""
    found: list[SvgNode] = []
    for name in family.values:
        ends = [family.ends(name, index, scene.machine.view, scale) for index in frames]
        shown = [(np.zeros(2),) * 2 if each is None else each for each in ends]
        pairs = [arrow_points((float(a[0]), float(a[1])), (float(b[0]), float(b[1]))) for a, b in shown]
        for kind, places in (("line", [p[0] for p in pairs]), ("head", [p[1] for p in pairs])):
            texts = [coordinates(each) for each in places]
            shape = element("polyline", {"class": f"{family.style}-{kind}", "points": texts[0]})
            found.append(shape.holding(animate_element("points", texts, seconds)))
    return found


def moving_torques(scene: Scene, torques: Torques, frames: Sequence[int], seconds: float) -> list[SvgNode]:
    """Arcs that follow their places; of the two senses only the present one is visible."""
    found: list[SvgNode] = []
    rows = list(frames)
    for name, values in torques.values.items():
        places = scene.machine.view.paper(torques.places[name][rows])
        for turning in (1, -1):
            visibility = ["visible" if np.sign(value) == turning else "hidden" for value in values[rows]]
            if "visible" not in visibility:
                continue
            arc = SYMBOLS["moment"](turning=turning, radius=torques.radius, style=torques.style)
            switch = animate_element("visibility", visibility, seconds)
            content = group([switch, *arc.elements], visibility=visibility[0])
            found.append(shifted(places, seconds, [content]))
    return found


def moving_lines(style: str, lines: Sequence[Floats], seconds: float) -> Element:
    """A polyline that changes its shape, such as a spring."""
    texts = [coordinates(line) for line in lines]
    shape = element("polyline", {"class": style, "points": texts[0]})
    return shape.holding(animate_element("points", texts, seconds))


def _timing(values: Sequence[str], seconds: float) -> dict[str, str]:
    return {"values": ";".join(values), "dur": f"{seconds:.4g}s", "repeatCount": "indefinite"}


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
        """The cursor's place after a share of the motion."""
        return self.left + share * self.width

    def cursor(self, x: float = 0.0) -> Element:
        """The cursor at x."""
        return element("line", {"class": "lw-input-line", "x1": x, "x2": x, "y1": self.top, "y2": self.bottom})


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
    quantity = output.sentence(alone=alone).translate(language) if output.kind in QUANTITIES else output.column
    unit = unit_of(output.dimension, [values])
    low, high = (significant(end * unit.factor) for end in ends)
    return _("{quantity}: {low} … {high}", quantity=unit.label(quantity), low=low, high=high).translate(language)


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
