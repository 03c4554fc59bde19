"""Gears in mesh and racks as DXF, at true scale in millimetres."""

from __future__ import annotations

import math
from pathlib import Path

from linkwright.export.dxf.sheet import content_of, new_document
from linkwright.gears.pair import GearPair
from linkwright.gears.rack import Rack
from linkwright.plot.gears import contact_line
from linkwright.whole_files import refuse_target, write_whole

#: Layers with their colours (numbers of the AutoCAD colour index), seen on white and on dark sheets.
LAYERS = {"outline": 7, "rolling": 8, "base": 150, "contact": 1}
_MM = 1e3


def save_pair(
    pair: GearPair, path: str | Path, pinion_angle: float = 0.0, *, points: int = 60, force: bool = False
) -> Path:
    """Outlines as closed polylines whose corners lie on the exact curves; circles; the path of contact.

    Raises LinkwrightError for a file that exists (without ``force``), a missing folder or package.
    """
    refuse_target(path, force=force)
    document = new_document(LAYERS)
    space = document.modelspace()
    for outline in pair.outlines(pinion_angle, points):
        space.add_lwpolyline((_MM * outline).tolist(), close=True, dxfattribs={"layer": "outline"})
    for gear, x in ((pair.pinion, 0.0), (pair.wheel, pair.centre_sign)):
        rolling = 0.5 * gear.base_diameter / math.cos(pair.working_pressure_angle)
        attributes = {"layer": "rolling", "linetype": "DASHDOT"}
        space.add_circle((_MM * x, 0.0), _MM * rolling, dxfattribs=attributes)
        space.add_circle((_MM * x, 0.0), 0.5 * _MM * gear.base_diameter, dxfattribs={"layer": "base"})
    start, end = (_MM * contact_line(pair)).tolist()
    space.add_line(start, end, dxfattribs={"layer": "contact"})
    return write_whole(path, content_of(document), force=force)


def save_rack(rack: Rack, path: str | Path, *, points: int = 12, force: bool = False) -> Path:
    """The outline as a closed polyline whose corners lie on the exact curves, and the datum line.

    Raises LinkwrightError for a file that exists (without ``force``), a missing folder or package.
    """
    refuse_target(path, force=force)
    document = new_document(LAYERS)
    space = document.modelspace()
    outline = _MM * rack.outline(points)
    space.add_lwpolyline(outline.tolist(), close=True, dxfattribs={"layer": "outline"})
    left, right = outline[:, 0].min(), outline[:, 0].max()
    space.add_line((left, 0.0), (right, 0.0), dxfattribs={"layer": "rolling", "linetype": "DASHDOT"})
    return write_whole(path, content_of(document), force=force)
