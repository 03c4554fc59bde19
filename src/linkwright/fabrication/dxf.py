"""Plates as DXF: millimetres, 1 : 1, outlines as closed polylines with true arcs, holes as circles, in layers."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any

from linkwright.exporters.dxf import STYLE, content_of, new_document
from linkwright.fabrication.cut_lines import CutLines
from linkwright.fabrication.engraving import Engraving
from linkwright.shapes.loop import Loop
from linkwright.words.characters import one_line

#: Layers with their colours (numbers of the AutoCAD colour index): what is engraved and cut inside goes before the
#: outline, as nothing holds a plate that is cut out.
LAYERS = {"engrave": 5, "holes": 3, "cut": 1, "sheet": 8}
MM = 1e3


def dxf_of(lines: Iterable[CutLines], sheet: Loop | None = None) -> bytes:
    """The file of some plates; ``sheet``: the edge of the sheet on which they lie."""
    found = list(lines)
    words = "".join(name.text for each in found for name in each.names)
    document = new_document({name: LAYERS[name] for name in LAYERS if name != "sheet" or sheet is not None}, words)
    space = document.modelspace()
    for each in found:
        for name in each.names:
            _add_text(space, name)
        for centre, radius in each.holes:
            place = (MM * centre.real, MM * centre.imag)
            space.add_circle(place, MM * radius, dxfattribs={"layer": "holes"})
        for loop in each.inner:
            _add_loop(space, loop, "holes")
        for loop in each.outer:
            _add_loop(space, loop, "cut")
    if sheet is not None:
        _add_loop(space, sheet, "sheet")
    return content_of(document)


def _add_loop(space: Any, loop: Loop, layer: str) -> None:
    corners = [(MM * each.start.real, MM * each.start.imag, each.bulge) for each in loop.edges]
    space.add_lwpolyline(corners, format="xyb", close=True, dxfattribs={"layer": layer})


def _add_text(space: Any, text: Engraving) -> None:
    from ezdxf.enums import TextEntityAlignment

    attributes = {"layer": "engrave", "style": STYLE, "height": MM * text.height, "rotation": math.degrees(text.turn)}
    entity = space.add_text(one_line(text.text).replace("%%", "%%%%%%"), dxfattribs=attributes)
    entity.set_placement((MM * text.at.real, MM * text.at.imag), align=TextEntityAlignment.MIDDLE_CENTER)
