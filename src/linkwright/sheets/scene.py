"""Machines and symbols on a sheet, in the lines of GB/T 4457.4."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.pictures.labels import TO_UNITS
from linkwright.pictures.picture import Circle, Fill, Line, Pen, Picture, Vec
from linkwright.pictures.symbols.base import SYMBOLS, vec
from linkwright.plot.drawing.scene import Scene

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


def draw_elements(picture: Picture, elements: Iterable[Line | Circle], style: str = "") -> None:
    """Lines and circles in units of symbols as those of the sheet; with a ``style`` all in it and nothing filled."""
    for each in elements:
        own, fill = _STYLES.get(each.style, ("thin", "ink" if each.style.endswith("-head") else ""))
        picture.items.append(
            replace(
                each.placed(np.zeros(2), scale=vec(1.0 / TO_UNITS)),
                style=style or own,
                fill="" if style else fill,
            )
        )


def draw_machine(picture: Picture, scene: Scene, index: int) -> None:
    """The machine at one position in full."""
    draw_elements(picture, (item for _, item in scene.items(index)))


def outline_machine(picture: Picture, scene: Scene, index: int, style: str) -> None:
    """The moving links at another position, by their lines alone."""
    outlines = (
        item for part, item in scene.items(index) if part.carrier != "frame" and part.layer in _OUTLINED
    )
    draw_elements(picture, outlines, style)


#: Half the length of the walls between which a stem slides, and their distance, in units of symbols.
_HALF, _ROOM = 20.0, 5.0


def frame_pin(picture: Picture, at: Floats, toward: Vec) -> None:
    """A pin on the frame, which lies in the direction ``toward``."""
    place = vec(at * TO_UNITS)
    for shape in (SYMBOLS["fixed_pivot"](at=place, toward=_turned(toward)), SYMBOLS["pin"](at=place)):
        draw_elements(picture, shape.elements)


def guide(picture: Picture, at: Floats, along: Floats) -> None:
    """The hatched walls between which a rod slides."""
    place = {"at": vec(at * TO_UNITS), "along": _turned(vec(along))}
    for side in (-1, 1):
        walls = SYMBOLS["ground_guide"](**place, start=-_HALF, end=_HALF, height=_ROOM, side=side)
        draw_elements(picture, walls.elements)


def _turned(way: Vec) -> Vec:
    """A direction in the axes of symbols, whose y is down."""
    return vec(np.sign(TO_UNITS) * way)
