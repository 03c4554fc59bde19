"""Velocity and acceleration polygons to scale, beside the position they belong to."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Sequence
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from linkwright.errors import LinkwrightError, RequestError
from linkwright.kinematics.cycle import Floats
from linkwright.kinematics.motion import Motion
from linkwright.plot.diagrams.axes import wrapped
from linkwright.plot.diagrams.base import DIAGRAMS, Kind, Request
from linkwright.plot.diagrams.labels import Labels
from linkwright.plot.diagrams.motion_vectors import MotionPolygon, acceleration_polygon, velocity_polygon
from linkwright.plot.diagrams.paper import (
    INCH,
    LEAST,
    LINE,
    Cell,
    arrow,
    colour_key,
    headed,
    page,
    scale_for,
    symbol,
)  # fmt: skip
from linkwright.plot.diagrams.picture import COLOURS, INK, new_figure
from linkwright.plot.diagrams.position import Ink, draw_position
from linkwright.plot.diagrams.source import Source
from linkwright.plot.diagrams.units import significant
from linkwright.words import Say

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

#: Longest extent of the position and of the polygon on the paper, mm.
POSITION, POLYGON = 75.0, 110.0
RIGHT = np.array([1.0, 0.0])
#: Letters above the symbols of parts of an acceleration.
ABOVE = {"normal": "n", "tangential": "t", "coriolis": "k", "sliding": "r"}
LOOKS = {
    "absolute": (COLOURS[0], "-", 1.5),
    "relative": (COLOURS[1], "-", 1.2),
    "normal": (COLOURS[2], (0, (5, 2)), 1.1),
    "tangential": (COLOURS[1], (0, (5, 2)), 1.1),
    "coriolis": (COLOURS[3], (0, (5, 2)), 1.1),
    "sliding": (COLOURS[4], (0, (5, 2)), 1.1),
}


class MotionPolygons(Kind):
    """A polygon with its pole, images of all points, and the vectors between them, drawn to a round scale."""

    unit: ClassVar[str]
    letter: ClassVar[str]
    prime: ClassVar[str] = ""

    @abstractmethod
    def polygon(self, motion: Motion) -> MotionPolygon:
        """The polygon of a motion's first position."""

    def draw(self, sources: Sequence[Source], request: Request) -> Figure:
        if len(sources) > 1:
            raise RequestError("a polygon shows one mechanism at one position; give one result")
        motion = sources[0].at(request.at)
        polygon = self.polygon(motion)
        images = np.array([np.zeros(2), *polygon.images.values(), *(step.end for step in polygon.steps)])
        largest = float(np.ptp(images, axis=0).max())
        if largest <= 0:
            raise LinkwrightError(
                "nothing moves at this position, so there is no polygon; choose another input: at=…"
            )
        scale = scale_for(largest, POLYGON)
        return self._sheet(sources[0], motion, polygon, scale, request)

    def _sheet(
        self, source: Source, motion: Motion, polygon: MotionPolygon, scale: float, request: Request
    ) -> Figure:
        say = request.say
        places = _places(motion)
        length = scale_for(float(np.ptp(places, axis=0).max()), POSITION)
        images = (
            np.array([np.zeros(2), *polygon.images.values(), *(step.end for step in polygon.steps)]) / scale
        )
        texts = _table(polygon, self.unit)
        title = f"{source.label}: {say(f'kind.{self.name}')}, {source.place_text(motion, say)}"
        cells = [
            Cell(
                places / length, f"{say('position')}: {symbol('μ', 'l')} = {significant(length * 1e3)} mm/mm"
            ),
            Cell(
                images, f"{say('polygon')}: {symbol('μ', self.letter)} = {significant(scale)} {self.unit}/mm"
            ),
        ]
        wide = max(LEAST, sum(float(cell.size[0]) for cell in cells))
        columns = int(wide // 42)
        rows = -(-len(texts) // columns)
        heading = wrapped(title if request.title is None else request.title, wide / INCH)
        head = 4.0 + 4.6 * (heading.count("\n") + 1) if heading else 2.0
        figure, (left, right) = page(cells, 2, foot=LINE * rows + 9, head=head)
        _name_position(left, draw_position(left, motion, 0, factor=1 / length))
        draw_polygon(right, polygon, scale, self.prime)
        colour_key(figure, _used(polygon, say), LINE * rows + 4)
        _write(figure, texts, columns)
        headed(figure, heading)
        return figure


@DIAGRAMS.register("velocity_polygon")
class VelocityPolygon(MotionPolygons):
    """Velocities of all points from one pole p, and relative velocities between them."""

    name = "velocity_polygon"
    options = ("at",)
    unit, letter = "m/s", "v"

    def polygon(self, motion: Motion) -> MotionPolygon:
        return velocity_polygon(motion, 0)


@DIAGRAMS.register("acceleration_polygon")
class AccelerationPolygon(MotionPolygons):
    """Accelerations of all points from one pole p′; normal, tangential, Coriolis and sliding parts dashed."""

    name = "acceleration_polygon"
    options = ("at",)
    unit, letter, prime = "m/s²", "a", "′"

    def polygon(self, motion: Motion) -> MotionPolygon:
        return acceleration_polygon(motion, 0)


def draw_polygon(axes: Axes, polygon: MotionPolygon, scale: float, prime: str) -> None:
    """Vectors and names, in paper mm from the pole."""
    labels = Labels(axes)
    for step in polygon.steps:
        colour, dash, width = LOOKS[step.role]
        arrow(axes, step.start / scale, step.end / scale, colour, dash=dash, width=width)
        labels.line(step.start / scale, step.end / scale)
    middle = np.mean([np.zeros(2), *polygon.images.values()], axis=0) / scale
    for names, image in _gathered(polygon, scale, prime):
        axes.plot([image[0]], [image[1]], "o", color=INK, markersize=2.4, zorder=4)
        labels.put(", ".join(names), [image], away=image - middle)


def _name_position(axes: Axes, ink: Ink) -> None:
    labels = Labels(axes)
    for line in ink.lines:
        labels.line(line[0], line[1])
    for _, place in ink.names:
        labels.line(place - RIGHT, place + RIGHT)
    for text, place in ink.names:
        labels.put(text, [place])


def _gathered(polygon: MotionPolygon, scale: float, prime: str) -> list[tuple[list[str], Floats]]:
    """Images with their names; those at one place share a label. The pole comes first."""
    found: list[tuple[list[str], Floats]] = [([f"p{prime}"], np.zeros(2))]
    for key, image in polygon.images.items():
        place = image / scale
        name = f"{key.lower()}{prime}"
        near = next((names for names, other in found if np.hypot(*(other - place)) < 0.6), None)
        if near is None:
            found.append(([name], place))
        else:
            near.append(name)
    return found


def _places(motion: Motion) -> Floats:
    return draw_position(new_figure((1, 1)).subplots(), motion, 0, factor=1.0).cloud


def _table(polygon: MotionPolygon, unit: str) -> list[tuple[str, str]]:
    """Sizes of the vectors with the colour of their role, those of zero size left out."""
    largest = max(step.size for step in polygon.steps)
    return [
        (
            f"{symbol(step.letter, step.name, ABOVE.get(step.role, ''))} = {significant(step.size)} {unit}",
            LOOKS[step.role][0],
        )
        for step in sorted(polygon.steps, key=lambda each: list(LOOKS).index(each.role))
        if step.size > 1e-9 * largest
    ]


def _used(polygon: MotionPolygon, say: Say) -> list[tuple[str, str]]:
    roles = {step.role for step in polygon.steps}
    return [(say(f"role.{role}"), look[0]) for role, look in LOOKS.items() if role in roles]


def _write(figure: Figure, texts: list[tuple[str, str]], columns: int) -> None:
    """The vectors' sizes below the pictures, in columns."""
    wide, tall = (float(each) * INCH for each in figure.get_size_inches())
    rows = -(-len(texts) // columns)
    for number, (text, colour) in enumerate(texts):
        column, row = divmod(number, rows)
        x, y = (4.0 + column * (wide - 4.0) / columns) / wide, (LINE * (rows - row - 1) + 2.5) / tall
        figure.text(x, y, text, fontsize=7.8, color=colour, va="bottom", parse_math=True)
