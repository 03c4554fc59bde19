"""Velocity and acceleration polygons to scale, next to the position they belong to."""

from __future__ import annotations

from abc import abstractmethod
from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from typing import ClassVar

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.quantity import per_mm, significant
from linkwright.kinematics.motion import Motion
from linkwright.pictures.drawing import BLUE, GREEN, ORANGE, PURPLE, TEAL, Drawing, arrow_rules
from linkwright.pictures.labels import Label
from linkwright.pictures.picture import indexed, joined
from linkwright.pictures.sketch import Sketch
from linkwright.pictures.symbols.base import vec
from linkwright.plotting.diagrams.base import DIAGRAMS, Kind, Request
from linkwright.plotting.diagrams.motion_vectors import MotionPolygon, acceleration_polygon, velocity_polygon
from linkwright.plotting.diagrams.names import with_index
from linkwright.plotting.diagrams.scaled_page import (
    BAR,
    MILLIMETRE,
    Cell,
    Written,
    key,
    page,
    page_width,
    position_cell,
    scale_of_picture,
    scale_title,
    side_by_side,
    units,
)
from linkwright.plotting.diagrams.source import PlotInput
from linkwright.words import _

#: Longest extent of the polygon on the paper, mm.
POLYGON = 110.0
#: Minimum width of a column of sizes, units.
COLUMN = 168.0
#: Letters of the pole, the first one that no point has.
POLES = ("p", "π", "o", "p*")
#: Letters above the symbols of parts of an acceleration.
ABOVE = {"normal": "n", "tangential": "t", "coriolis": "k", "sliding": "r"}
#: Roles of vectors with their colours and dashes, mm.
LOOKS = {
    "absolute": (BLUE, ""),
    "relative": (ORANGE, ""),
    "normal": (GREEN, "6 3"),
    "tangential": (ORANGE, "6 3"),
    "coriolis": (PURPLE, "6 3"),
    "sliding": (TEAL, "6 3"),
}
CSS = "".join(arrow_rules(role, colour, 1.8, dash) for role, (colour, dash) in LOOKS.items())
#: What the parts of a polygon are.
ROLES = {
    "absolute": _("absolute"),
    "relative": _("relative"),
    "normal": _("normal aⁿ"),
    "tangential": _("tangential aᵗ"),
    "coriolis": _("Coriolis aᵏ"),
    "sliding": _("sliding"),
}


class MotionPolygons(Kind):
    """A polygon with its pole, images of all points, and the vectors between them, drawn to a round scale."""

    unit: ClassVar[str]
    letter: ClassVar[str]
    prime: ClassVar[str] = ""
    single = _("a polygon shows one mechanism at one position; give one result", code="picture.one_mechanism")

    @abstractmethod
    def polygon(self, motion: Motion) -> MotionPolygon:
        """The polygon of a motion's first position."""

    def draw(self, sources: Sequence[PlotInput], request: Request) -> Drawing:
        motion = sources[0].at(request.at)
        polygon = self.polygon(motion)
        scale = scale_of_picture(polygon.places, POLYGON)
        return self._page(sources[0], motion, polygon, scale, request)

    def _page(
        self, source: PlotInput, motion: Motion, polygon: MotionPolygon, scale: float, request: Request
    ) -> Drawing:
        say = request.say
        scale_text = scale_title(say(_("polygon")), self.letter, f"{significant(scale)} {per_mm(self.unit)}")
        bar = f"{significant(BAR * MILLIMETRE * scale)} {self.unit}"
        cells = [position_cell(motion, say), Cell(_sketch(polygon, scale, self.prime), (scale_text,), bar)]
        roles = {step.role for step in polygon.steps}
        subject = f"{say(self.title)}, {source.place_text(motion, say)}"
        title = request.titled(source.label, subject)
        return page(
            cells,
            2,
            [
                key([(say(ROLES[role]), f"lw-{role}") for role in LOOKS if role in roles]),
                *_columns(_table(polygon, self.unit), page_width(cells, 2)),
            ],
            request.heading(title),
            title,
            CSS,
        )


@DIAGRAMS.register("velocity_polygon")
class VelocityPolygon(MotionPolygons):
    """Velocities of all points from one pole p, and relative velocities between them."""

    title = _("velocity polygon")
    options = ("at",)
    unit, letter = "m/s", "v"

    def polygon(self, motion: Motion) -> MotionPolygon:
        return velocity_polygon(motion, 0)


@DIAGRAMS.register("acceleration_polygon")
class AccelerationPolygon(MotionPolygons):
    """Accelerations of all points from one pole p′; normal, tangential, Coriolis and sliding parts dashed."""

    title = _("acceleration polygon")
    options = ("at",)
    unit, letter, prime = "m/s²", "a", "′"

    def polygon(self, motion: Motion) -> MotionPolygon:
        return acceleration_polygon(motion, 0)


def _sketch(polygon: MotionPolygon, scale: float, prime: str) -> Sketch:
    """Vectors and names; the vectors of a flat polygon stand side by side."""
    sketch = Sketch()
    for step, (start, end) in zip(polygon.steps, arrows(polygon, scale), strict=True):
        sketch.arrow(units(start), units(end), f"lw-{step.role}")
    for names, image in gathered(polygon, scale, prime):
        sketch.circle(vec(units(image)), 1.8, "lw-point")
        sketch.labels.append(Label(", ".join(names), (vec(units(image)),), size=13.0, clearance=5.0, leader=False))
    sketch.write_names()
    return sketch


def arrows(polygon: MotionPolygon, scale: float) -> list[tuple[Floats, Floats]]:
    """Starts and ends of the vectors in paper mm from the pole."""
    return side_by_side([(step.start / scale, step.end / scale) for step in polygon.steps])


def image_names(points: Iterable[str], prime: str = "") -> tuple[str, dict[str, str]]:
    """Names of the pole and of the images of points: small letters, of which no two are the same.

    The pole is p, or where a point's image is p: π, then o. Points whose small letters are the same keep their links'
    names, or their capitals.
    """
    own_points = list(points)
    ways: tuple[Callable[[str], str], ...] = (lambda point: point.rpartition(".")[2].lower(), str.lower, str)
    names: dict[str, str] = {}
    for way in ways:
        tried = {point: with_index(way(point)) for point in own_points if point not in names}
        count = Counter([*tried.values(), *names.values()])
        names |= {point: name for point, name in tried.items() if count[name] == 1 or way is str}
    pole = next(each for each in POLES if each not in names.values())
    return pole + prime, {point: names[point] + prime for point in own_points}


def gathered(polygon: MotionPolygon, scale: float, prime: str) -> list[tuple[list[str], Floats]]:
    """Images with their names; those at one place share a label. The pole comes first."""
    pole, letters = image_names(polygon.images, prime)
    found: list[tuple[list[str], Floats]] = [([pole], np.zeros(2))]
    for name, image in polygon.images.items():
        place = image / scale
        near = next((names for names, other in found if np.hypot(*(other - place)) < 0.6), None)
        if near is None:
            found.append(([letters[name]], place))
        else:
            near.append(letters[name])
    return found


def _table(polygon: MotionPolygon, unit: str) -> list[Written]:
    """Group by group the sizes of the vectors in the colours of their roles, those of zero size left out."""
    largest = max(step.size for step in polygon.steps)
    found: list[Written] = []
    for name in dict.fromkeys(step.group for step in polygon.steps):
        sizes: list[Written] = [
            (
                joined(
                    indexed(step.letter, step.name, ABOVE.get(step.role, "")), f" = {significant(step.size)} {unit}"
                ),
                f"lw-{step.role}-name",
            )
            for step in polygon.steps
            if step.group == name and step.size > 1e-9 * largest
        ]
        found += [(name, "lw-legend"), *sizes] if sizes else []
    return found


def _columns(texts: list[Written], width: float) -> list[list[tuple[Written, float]]]:
    """Texts in lines of columns that are read downwards."""
    columns = int(width // COLUMN)
    rows = -(-len(texts) // columns)
    return [[(text, number * width / columns) for number, text in enumerate(texts[row::rows])] for row in range(rows)]
