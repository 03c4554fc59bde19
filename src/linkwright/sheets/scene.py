"""A machine's drawing on a sheet: the symbols of pictures/symbols in the lines of GB/T 4457.4."""

from __future__ import annotations

from collections.abc import Iterable

from linkwright.pictures.svg.element import Element
from linkwright.pictures.svg.strokes import strokes
from linkwright.plot.drawing.scene import Scene
from linkwright.sheets.labels import TO_UNITS
from linkwright.sheets.picture import Circle, Fill, Line, Pen, Picture

#: Line and filling of the classes of drawings; those that are not named are thin and not filled.
_STYLES: dict[str, tuple[Pen, Fill]] = {
    "lw-bar": ("thick", ""), "lw-plate": ("thick", ""), "lw-block": ("thick", "paper"), "lw-pin": ("thin", "paper"),
    "lw-mass-ring": ("thin", "paper"), "lw-point": ("thin", "ink"), "lw-weld": ("thin", "ink"),
    "lw-mass": ("thin", "ink"), "lw-support": ("thin", "paper"), "lw-rim": ("thin", ""),
    "lw-ground": ("thick", ""), "lw-strand": ("thick", ""), "lw-pitch": ("chain", ""), "lw-gear": ("thin", ""),
    "lw-spring": ("thin", ""), "lw-load-ring": ("thin", "paper"),
}  # fmt: skip
#: Layers of which other positions of the machine show their lines.
_OUTLINED = ("bodies", "blocks")


def draw_elements(picture: Picture, elements: Iterable[Element], pen: Pen | None = None) -> None:
    """Elements in units of symbols as lines in mm; with a ``pen`` all lines in it and nothing filled."""
    for stroke in strokes(elements):
        own, fill = _STYLES.get(stroke.style, ("thin", "ink" if stroke.style.endswith("-head") else ""))
        if pen is not None:
            own, fill = pen, ""
        points = stroke.points / TO_UNITS
        if stroke.radius is not None:
            picture.items.append(Circle(points[0], stroke.radius * abs(1.0 / TO_UNITS[0]), own, fill))
        else:
            picture.items.append(Line(points, own, stroke.closed, fill))


def draw_machine(picture: Picture, scene: Scene, index: int) -> None:
    """The machine at one position in full."""
    draw_elements(picture, scene.at(index))


def outline_machine(picture: Picture, scene: Scene, index: int, pen: Pen) -> None:
    """The moving links at another position, by their lines alone."""
    for layer, link, parts in scene.layered():
        if link == "frame" or layer not in _OUTLINED:
            continue
        transform = scene.machine.view.transform(scene.machine.placed[link], index)
        x, y, turn = transform
        shapes = [element for part in parts for element in part.shape.elements]
        moved = Element("g", (("transform", f"translate({x} {y}) rotate({turn})"),), tuple(shapes))
        draw_elements(picture, [moved], pen)
