"""Velocity and acceleration polygons to scale, beside the position they belong to."""

from __future__ import annotations

from abc import abstractmethod
from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from typing import ClassVar

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.quantity import significant
from linkwright.errors import LinkwrightError, RequestError
from linkwright.kinematics.motion import Motion
from linkwright.pictures.diagram import COLOURS, INK, Axes, Figure
from linkwright.plot.diagrams.axes import wrapped
from linkwright.plot.diagrams.base import DIAGRAMS, Kind, Request
from linkwright.plot.diagrams.motion_vectors import MotionPolygon, acceleration_polygon, velocity_polygon
from linkwright.plot.diagrams.position import draw_position, name_position, position_cell
from linkwright.plot.diagrams.scaled_page import (
    BAR,
    INCH,
    LEAST,
    LINE,
    Cell,
    Labels,
    arrow,
    colour_key,
    headed,
    page,
    scale_of_picture,
    side_by_side,
    symbol,
    with_index,
)
from linkwright.plot.diagrams.source import Source
from linkwright.words import Say

#: Longest extent of the polygon on the paper, mm.
POLYGON = 110.0
#: Letters of the pole, the first one that no point has.
POLES = ("p", "π", "o", "p*")
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
            raise RequestError("picture.one_mechanism")
        motion = sources[0].at(request.at)
        polygon = self.polygon(motion)
        images = np.array([np.zeros(2), *polygon.images.values(), *(step.end for step in polygon.steps)])
        if float(np.ptp(images, axis=0).max()) <= 0:
            raise LinkwrightError("picture.nothing_moves")
        return self._sheet(sources[0], motion, polygon, scale_of_picture(images, POLYGON), request)

    def _sheet(
        self, source: Source, motion: Motion, polygon: MotionPolygon, scale: float, request: Request
    ) -> Figure:
        say = request.say
        ink, millimetre, position = position_cell(motion, say)
        places = np.array([np.zeros(2), *(place for pair in _arrows(polygon, scale) for place in pair)])
        title = f"{say('polygon')}: {symbol('μ', self.letter)} = {significant(scale)} {self.unit}/mm"
        cells = [position, Cell(places, title, bar=f"{significant(BAR * scale)} {self.unit}")]
        subject = f"{say(f'kind.{self.name}')}, {source.place_text(motion, say)}"
        heading = request.titled(source.label, subject)
        texts = _table(polygon, self.unit)
        wide = max(LEAST, sum(float(cell.size[0]) for cell in cells))
        columns = int(wide // 42)
        rows = -(-len(texts) // columns)
        heading = wrapped(heading if request.title is None else request.title, wide / INCH)
        head = 4.0 + 4.6 * (heading.count("\n") + 1) if heading else 2.0
        figure, (left, right) = page(cells, 2, foot=LINE * rows + 9, head=head)
        draw_position(left, motion, 0, factor=1 / millimetre)
        name_position(left, ink)
        draw_polygon(right, polygon, scale, self.prime)
        colour_key(figure, _used(polygon, say), LINE * rows + 4)
        _write(figure, texts, columns)
        headed(figure, heading)
        return figure


@DIAGRAMS.register("velocity_polygon")
class VelocityPolygon(MotionPolygons):
    """Velocities of all points from one pole p, and relative velocities between them."""

    options = ("at",)
    unit, letter = "m/s", "v"

    def polygon(self, motion: Motion) -> MotionPolygon:
        return velocity_polygon(motion, 0)


@DIAGRAMS.register("acceleration_polygon")
class AccelerationPolygon(MotionPolygons):
    """Accelerations of all points from one pole p′; normal, tangential, Coriolis and sliding parts dashed."""

    options = ("at",)
    unit, letter, prime = "m/s²", "a", "′"

    def polygon(self, motion: Motion) -> MotionPolygon:
        return acceleration_polygon(motion, 0)


def draw_polygon(axes: Axes, polygon: MotionPolygon, scale: float, prime: str) -> None:
    """Vectors and names, in paper mm from the pole; those of a flat polygon stand side by side."""
    labels = Labels(axes)
    for step, (start, end) in zip(polygon.steps, _arrows(polygon, scale), strict=True):
        colour, dash, width = LOOKS[step.role]
        arrow(axes, start, end, colour, dash=dash, width=width)
        labels.line(start, end)
    middle = np.mean([np.zeros(2), *polygon.images.values()], axis=0) / scale
    for names, image in gathered(polygon, scale, prime):
        axes.plot([image[0]], [image[1]], "o", color=INK, markersize=2.4, zorder=4)
        labels.put(", ".join(names), [image], away=image - middle)


def _arrows(polygon: MotionPolygon, scale: float) -> list[tuple[Floats, Floats]]:
    return side_by_side([(step.start / scale, step.end / scale) for step in polygon.steps])


def image_names(points: Iterable[str], prime: str = "") -> tuple[str, dict[str, str]]:
    """Names of the pole and of the images of points: small letters, of which no two are the same.

    The pole is p, or where a point's image is p: π, then o. Points whose small letters are the same keep their links'
    names, or their capitals.
    """
    given = list(points)
    ways: tuple[Callable[[str], str], ...] = (lambda point: point.rpartition(".")[2].lower(), str.lower, str)
    names: dict[str, str] = {}
    for way in ways:
        tried = {point: with_index(way(point)) for point in given if point not in names}
        count = Counter([*tried.values(), *names.values()])
        names |= {point: name for point, name in tried.items() if count[name] == 1 or way is str}
    pole = next(each for each in POLES if each not in names.values())
    return pole + prime, {point: names[point] + prime for point in given}


def gathered(polygon: MotionPolygon, scale: float, prime: str) -> list[tuple[list[str], Floats]]:
    """Images with their names; those at one place share a label. The pole comes first."""
    pole, letters = image_names(polygon.images, prime)
    found: list[tuple[list[str], Floats]] = [([pole], np.zeros(2))]
    for key, image in polygon.images.items():
        place = image / scale
        near = next((names for names, other in found if np.hypot(*(other - place)) < 0.6), None)
        if near is None:
            found.append(([letters[key]], place))
        else:
            near.append(letters[key])
    return found


def _table(polygon: MotionPolygon, unit: str) -> list[tuple[str, str]]:
    """Group by group the sizes of the vectors with the colour of their role, those of zero size left out."""
    largest = max(step.size for step in polygon.steps)
    found: list[tuple[str, str]] = []
    for group in dict.fromkeys(step.group for step in polygon.steps):
        sizes = [
            (
                f"{symbol(step.letter, step.name, ABOVE.get(step.role, ''))} = {significant(step.size)} {unit}",
                LOOKS[step.role][0],
            )
            for step in polygon.steps
            if step.group == group and step.size > 1e-9 * largest
        ]
        if sizes:
            found += [(group.replace("$", r"\$"), INK), *sizes]
    return found


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
