"""Symbols of kinematic drawings on a cam's sheet, at places in millimetres of paper."""

from __future__ import annotations

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.pictures.labels import TO_UNITS
from linkwright.pictures.picture import Picture, Vec
from linkwright.pictures.symbols.base import SYMBOLS, vec
from linkwright.sheets.scene import draw_elements

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
